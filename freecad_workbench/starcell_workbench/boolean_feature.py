"""Union, cut and intersection (T§3): what each asks of its operands, and its expression."""
import FreeCAD

from .operation_feature import OperationFeature, Role
from .translation import QT_TRANSLATE_NOOP


class _Boolean(OperationFeature):
    def expression(self, starcell, solids):
        raise NotImplementedError

    def compute(self, starcell, solids, values, options):
        return starcell.evaluate(self.expression(starcell, solids), **options)


class Union(_Boolean):
    command = "StarCell_Union"
    title = QT_TRANSLATE_NOOP("StarCell", "Union")
    help = QT_TRANSLATE_NOOP("StarCell", "Joins two or more solids into one, with a proved topology and distance")
    roles = (Role("Operands", QT_TRANSLATE_NOOP("App::Property", "The solids to join"), least=2),)

    def expression(self, starcell, solids):
        return starcell.union(solids["Operands"])


class Intersection(_Boolean):
    command = "StarCell_Intersection"
    title = QT_TRANSLATE_NOOP("StarCell", "Intersection")
    help = QT_TRANSLATE_NOOP("StarCell", "Keeps what two or more solids have in common, with a proved topology and distance")
    roles = (Role("Operands", QT_TRANSLATE_NOOP("App::Property", "The solids to intersect"), least=2),)

    def expression(self, starcell, solids):
        return starcell.intersection(solids["Operands"])

    def reach(self, boxes):
        common = FreeCAD.BoundBox(boxes["Operands"][0])
        for box in boxes["Operands"][1:]:
            common = common.intersected(box)
        return common if common.isValid() else super().reach(boxes)


class Cut(_Boolean):
    command = "StarCell_Cut"
    title = QT_TRANSLATE_NOOP("StarCell", "Cut")
    help = QT_TRANSLATE_NOOP("StarCell", "Takes the other selected solids away from the first one, with a proved topology and distance")
    roles = (Role("Base", QT_TRANSLATE_NOOP("App::Property", "The solid to cut"), many=False),
             Role("Tools", QT_TRANSLATE_NOOP("App::Property", "The solids to take away")))

    def expression(self, starcell, solids):
        return solids["Base"] - starcell.union(solids["Tools"])

    def reach(self, boxes):
        return boxes["Base"]
