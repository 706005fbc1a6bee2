"""The command of menu and toolbar that makes a Part solid of the selected mesh."""
import FreeCAD
import FreeCADGui

from . import commands, resources
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
        commands.make(translate("StarCell", ToSolid.title),
                      ("from starcell_workbench import macros",
                       "macros.make_solid(FreeCAD.ActiveDocument.getObject({!r}))".format(picked.Name)),
                      lambda made: translate("StarCell", "a solid of {} faces").format(made.Faces))

    @staticmethod
    def _picked():
        """The selected mesh or link to one, if it is the only thing selected."""
        objects = commands.selected()
        if len(objects) == 1 and objects[0].getLinkedObject(True).isDerivedFrom("Mesh::Feature"):
            return objects[0]
        return None
