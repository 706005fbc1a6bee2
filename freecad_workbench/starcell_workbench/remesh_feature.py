"""The same solid in well-shaped triangles (T§3.12.2)."""
from .operation_feature import OUTPUT, READ_ONLY, OperationFeature, Parameter, Role
from .translation import QT_TRANSLATE_NOOP


class Remesh(OperationFeature):
    command = "StarCell_Remesh"
    title = QT_TRANSLATE_NOOP("StarCell", "Remesh")
    help = QT_TRANSLATE_NOOP("StarCell", "Makes the triangles well shaped within the error, both ways; sharp edges and the topology stay")
    roles = (Role("Source", QT_TRANSLATE_NOOP("App::Property", "The mesh or solid to remesh"), many=False),)
    parameters = (
        Parameter("EdgeLength", "App::PropertyLength", QT_TRANSLATE_NOOP(
            "App::Property", "Length of most edges; 0: five times the error. Edges are shorter where sharp edges leave no room")),
        Parameter("FeatureAngle", "App::PropertyAngle", QT_TRANSLATE_NOOP(
            "App::Property", "Edges at which the mesh turns by more than this are sharp, and stay where they are"), default=40.0),)
    outputs = (
        ("App::PropertyInteger", "TrianglesBefore", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "Number of triangles that were remeshed")),
        ("App::PropertyFloat", "AspectRatio", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "Mean aspect ratio of the triangles; 1: all sides equal")),
        ("App::PropertyFloat", "AspectRatioBefore", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "Mean aspect ratio of the triangles that were remeshed")),
        ("App::PropertyAngle", "LeastAngle", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "Smallest angle of a triangle")))

    def compute(self, starcell, solids, values, options):
        return starcell.remesh(solids["Source"], edge_length=values["EdgeLength"] or None, feature_angle=values["FeatureAngle"], **options)

    def examine(self, starcell, solids, values, result, options):
        return dict(result.certificate.statistics)

    def published(self, obj, result, findings):
        obj.TrianglesBefore = int(findings["triangles.before"])
        obj.AspectRatio = findings["aspect_ratio.mean"]
        obj.AspectRatioBefore = findings["aspect_ratio.mean.before"]
        obj.LeastAngle = findings["angle.least"]
