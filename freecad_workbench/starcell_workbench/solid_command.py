"""The command of menu and toolbar that makes a Part solid of the selected mesh."""
import FreeCAD
import FreeCADGui

from . import commands, resources, runner
from .solid_feature import ToSolid
from .translation import translate


class ToSolidCommand:
    def GetResources(self):
        return {"Pixmap": resources.icon(ToSolid.command),
                "MenuText": translate("StarCell", ToSolid.title),
                "ToolTip": "{}\n{}".format(translate("StarCell", ToSolid.help), translate("StarCell", "Select one mesh"))}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None and not FreeCADGui.Control.activeDialog() and self._picked() is not None

    def Activated(self):
        picked = self._picked()
        if picked is None:
            title = translate("StarCell", ToSolid.title)
            FreeCAD.Console.PrintError(translate("StarCell", "{}: select one mesh first.").format(title) + "\n")
            return
        document = FreeCAD.ActiveDocument
        document.openTransaction(translate("StarCell", ToSolid.title))
        try:
            # Through the interpreter, so that the macro recorder writes it down.
            FreeCADGui.doCommand("from starcell_workbench import macros")
            FreeCADGui.doCommand("macros.make_solid(FreeCAD.ActiveDocument.getObject({!r}))".format(picked.Name))
        except Exception as problem:
            document.abortTransaction()
            FreeCAD.Console.PrintError("{}\n".format(problem))
            return
        made = document.ActiveObject
        if not made.isValid() and runner.last_was_cancelled:
            document.abortTransaction()
            return
        document.commitTransaction()
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(made)
        if made.isValid():
            text = translate("StarCell", "{}: a solid of {} faces").format(made.Label, made.Faces)
            FreeCADGui.getMainWindow().statusBar().showMessage(text, 10000)

    @staticmethod
    def _picked():
        """The selected mesh or link to one, if it is the only thing selected."""
        objects = commands.selected()
        if len(objects) == 1 and objects[0].getLinkedObject(True).isDerivedFrom("Mesh::Feature"):
            return objects[0]
        return None
