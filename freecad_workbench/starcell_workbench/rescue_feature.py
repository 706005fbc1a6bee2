"""Rescue: computes the whole history of a Part object anew, and says where OpenCASCADE's result is another one.

The mesh rests on the leaves of the history alone (history.py). The comparison proves nothing: volumes that differ by less than
the mesh may be off count as the same, and a difference of topology where parts touch may be a matter of taste. It never makes
the recompute fail.
"""
import FreeCAD

from . import history, mesh_transfer, opencascade_result
from .operation_feature import OUTPUT, READ_ONLY, OperationFeature, Role
from .translation import QT_TRANSLATE_NOOP, translate

ROUNDING = 1e-9  # share of the volume


class Rescue(OperationFeature):
    command = "StarCell_Rescue"
    title = QT_TRANSLATE_NOOP("StarCell", "Rescue")
    help = QT_TRANSLATE_NOOP("StarCell", "Computes a Boolean of Part anew from its whole history, with a proved topology and "
                                         "distance, and compares OpenCASCADE's result")
    roles = (Role("Source", QT_TRANSLATE_NOOP("App::Property", "The object whose history is computed anew"), many=False),)

    def add_properties(self, obj):
        super().add_properties(obj)
        for type_, name, help_ in (
                ("Bool", "Agrees", QT_TRANSLATE_NOOP("App::Property", "OpenCASCADE's volume, components and genus are the same")),
                ("Bool", "OccValid", QT_TRANSLATE_NOOP("App::Property", "OpenCASCADE has a closed, valid result")),
                ("Volume", "OccVolume", QT_TRANSLATE_NOOP("App::Property", "Volume of OpenCASCADE's result")),
                ("Integer", "OccComponents", QT_TRANSLATE_NOOP("App::Property", "Number of shells of OpenCASCADE's result")),
                ("IntegerList", "OccGenus", QT_TRANSLATE_NOOP("App::Property", "Handles of each of its shells, the most first"))):
            if name not in obj.PropertiesList:
                obj.addProperty("App::Property" + type_, name, "OpenCASCADE", help_, READ_ONLY | OUTPUT)

    def gather(self, each, obj, chosen, folder):
        return history.read(each, obj, folder)

    def compute(self, starcell, solids, values, options):
        return starcell.evaluate(solids["Source"], **options)

    def published(self, obj, result, findings):
        measured = opencascade_result.measure(obj.Source)
        area = mesh_transfer.area(result.vertices, result.triangles)
        tolerance = result.certificate.error_bound * area + ROUNDING * obj.Volume.Value
        differing = opencascade_result.differences(measured, result.certificate, obj.Volume.Value, tolerance)
        obj.OccValid = not measured.flaw
        obj.OccVolume = max(measured.volume, 0)  # FreeCAD's volumes are not negative, OpenCASCADE's may be
        obj.OccComponents, obj.OccGenus = measured.components, measured.genus
        obj.Agrees = obj.OccValid and not differing
        sentence = opencascade_result.in_words(measured, differing)
        if differing and not measured.flaw and obj.Verdict == "contact":
            sentence += translate("StarCell", " Parts touch: components and genus depend on what counts as touching.")
        if obj.Verdict == "unresolved":
            sentence += translate("StarCell", " Something is unresolved here, so that this proves nothing.")
        obj.Report += "\n" + sentence
        if not obj.Agrees:
            FreeCAD.Console.PrintMessage("{}: {}\n".format(obj.Label, sentence))


class _Revival:
    """FreeCAD's recompute leaves out what depends on a failed object, which is just what a rescue is for."""

    def slotRecomputedDocument(self, document):
        for obj in document.Objects:
            if isinstance(getattr(obj, "Proxy", None), Rescue) and not all(each.isValid() for each in obj.OutListRecursive):
                obj.recompute()


FreeCAD.addDocumentObserver(_Revival())
