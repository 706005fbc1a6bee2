"""The same solid in fewer triangles (T§3.12.2)."""
from .operation_feature import OUTPUT, READ_ONLY, OperationFeature, Role
from .translation import QT_TRANSLATE_NOOP


class Simplify(OperationFeature):
    command = "StarCell_Simplify"
    title = QT_TRANSLATE_NOOP("StarCell", "Simplify")
    help = QT_TRANSLATE_NOOP("StarCell", "Takes triangles away as long as the mesh stays within the error, both ways, and keeps its topology")
    roles = (Role("Source", QT_TRANSLATE_NOOP("App::Property", "The mesh or solid to simplify"), many=False),)
    outputs = (("App::PropertyInteger", "TrianglesBefore", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "Number of triangles that were simplified")),)

    def compute(self, starcell, solids, values, options):
        return starcell.simplify(solids["Source"], **options)

    def examine(self, starcell, solids, values, result, options):
        return int(result.certificate.statistics["triangles.before"])

    def published(self, obj, result, findings):
        obj.TrianglesBefore = findings
