"""How an operation's object shows itself: icon, operands as children, editing, and a colour of warning if unresolved."""
import FreeCADGui

from . import crease_lines, place_highlight, resources
from .stateless import Stateless

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
        self.highlight = place_highlight.PlaceHighlight()

    def add_properties(self, vobj):
        """Adds what is missing: to one of an older version what came later."""
        highlighted = vobj.Object.Proxy.highlighted
        if highlighted and not hasattr(vobj, highlighted.switch):
            vobj.addProperty("App::PropertyBool", highlighted.switch, "StarCell", highlighted.help)
            setattr(vobj, highlighted.switch, True)

    def getIcon(self):
        if self.obj.Verdict == "unresolved":
            return resources.icon("StarCell_Unresolved")
        return resources.icon(self.obj.Proxy.command)

    def claimChildren(self):
        return [] if self.obj.Proxy.keeps_operands else self.obj.Proxy.linked(self.obj)

    def updateData(self, obj, name):
        if name == "Mesh":
            self.creases.update(obj.ViewObject, obj.Mesh)
        highlighted = obj.Proxy.highlighted
        if highlighted and name in ("Mesh", highlighted.places, highlighted.spokes) and hasattr(obj, highlighted.last):
            self.highlight.update(obj, highlighted)
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
        highlighted = getattr(vobj.Object.Proxy, "highlighted", None)  # while a document is read there may be no proxy yet
        if highlighted and name == highlighted.switch:
            self.highlight.show(getattr(vobj, name))

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
