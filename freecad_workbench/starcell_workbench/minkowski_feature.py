"""Minkowski sum of two solids (T§4.1)."""
import FreeCAD

from .operation_feature import OperationFeature, Role
from .translation import QT_TRANSLATE_NOOP


class MinkowskiSum(OperationFeature):
    command = "StarCell_MinkowskiSum"
    title = QT_TRANSLATE_NOOP("StarCell", "Minkowski sum")
    help = QT_TRANSLATE_NOOP("StarCell", "Sweeps one solid by another: all sums of their points, with a proved topology and distance")
    roles = (Role("Source", QT_TRANSLATE_NOOP("App::Property", "The solid to sweep"), many=False),
             Role("Element", QT_TRANSLATE_NOOP("App::Property", "The solid to sweep it by, as it stands in the document: its distance from the origin "
                                                                "moves the result"), many=False))

    def compute(self, starcell, solids, values, options):
        return starcell.minkowski_sum(solids["Source"], solids["Element"], **options)

    def reach(self, boxes):
        a, b = boxes["Source"], boxes["Element"]
        return FreeCAD.BoundBox(a.XMin + b.XMin, a.YMin + b.YMin, a.ZMin + b.ZMin, a.XMax + b.XMax, a.YMax + b.YMax, a.ZMax + b.ZMax)
