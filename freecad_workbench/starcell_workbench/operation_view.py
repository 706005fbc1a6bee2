"""How an operation's object shows itself: icon, operands as children, editing, and a colour of warning if unresolved."""
import FreeCADGui

from . import crease_lines, resources, thin_highlight
from .stateless import Stateless
from .translation import QT_TRANSLATE_NOOP

WARNING_COLOR = (1.0, 0.60, 0.0)
HIDDEN = 4


class OperationView(Stateless):
    def __init__(self, vobj):
        # The colour to return to when a result is resolved again.
        vobj.addProperty("App::PropertyColor", "PlainColor", "StarCell", "", HIDDEN)
        vobj.PlainColor = vobj.ShapeColor
        vobj.CreaseAngle = crease_lines.CREASE_DEGREES  # shades smoothly up to there
        vobj.Proxy = self
        self.add_properties(vobj)

    def attach(self, vobj):
        self.obj = vobj.Object
        self.task = None
        self.creases = crease_lines.CreaseLines()
        self.thin = thin_highlight.ThinHighlight()

    def add_properties(self, vobj):
        """Adds what is missing: to one of an older version what came later."""
        if hasattr(vobj.Object, "ThinPlaces") and not hasattr(vobj, "ShowThinPlaces"):
            vobj.addProperty("App::PropertyBool", "ShowThinPlaces", "StarCell", QT_TRANSLATE_NOOP(
                "App::Property", "Draws the walls or gaps that are too thin, over everything else"))
            vobj.ShowThinPlaces = True

    def getIcon(self):
        if self.obj.Verdict == "unresolved":
            return resources.icon("StarCell_Unresolved")
        return resources.icon(self.obj.Proxy.command)

    def claimChildren(self):
        return self.obj.Proxy.linked(self.obj)

    def updateData(self, obj, name):
        if name == "Mesh":
            self.creases.update(obj.ViewObject, obj.Mesh)
        if name in ("Mesh", "ThinSpokes", "ThinPlaces") and hasattr(obj, "ThinSpokes"):
            self.thin.update(obj)
        if name != "Verdict" or not hasattr(obj.ViewObject, "PlainColor"):
            return
        vobj = obj.ViewObject
        flagged = _same(vobj.ShapeColor, WARNING_COLOR)
        if obj.Verdict == "unresolved" and not flagged:
            vobj.PlainColor = vobj.ShapeColor
            vobj.ShapeColor = WARNING_COLOR
        elif obj.Verdict != "unresolved" and flagged:
            vobj.ShapeColor = vobj.PlainColor
        vobj.signalChangeIcon()

    def onChanged(self, vobj, name):
        if name == "ShowThinPlaces":
            self.thin.show(vobj.ShowThinPlaces)

    def doubleClicked(self, vobj):
        FreeCADGui.ActiveDocument.setEdit(vobj.Object)
        return True

    def setEdit(self, vobj, mode=0):
        from .task_operation import OperationTask

        if mode != 0 or FreeCADGui.Control.activeDialog():
            return False
        self.task = OperationTask(vobj.Object)
        FreeCADGui.Control.showDialog(self.task)
        return True

    def unsetEdit(self, vobj, mode=0):
        self.task = None
        if FreeCADGui.Control.activeDialog():
            FreeCADGui.Control.closeDialog()
        return True

    def onDelete(self, vobj, subelements):
        for each in vobj.Object.Proxy.linked(vobj.Object):
            each.Visibility = True
        return True


def _same(color, other):
    return all(abs(a - b) < 0.01 for a, b in zip(color, other))
