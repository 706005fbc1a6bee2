"""The command of menu and toolbar that measures two selected solids."""
import FreeCAD
import FreeCADGui

from . import commands, resources
from .depth_feature import PenetrationDepth
from .translation import translate


class PenetrationDepthCommand:
    def GetResources(self):
        return {"Pixmap": resources.icon(PenetrationDepth.command),
                "MenuText": translate("StarCell", PenetrationDepth.title),
                "ToolTip": "{}\n{}".format(translate("StarCell", PenetrationDepth.help), translate("StarCell", "Select two solids, meshes or containers of such"))}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None and not FreeCADGui.Control.activeDialog() and len(commands.selected()) == 2

    def Activated(self):
        picked = commands.selected()
        title = translate("StarCell", PenetrationDepth.title)
        if len(picked) != 2:
            FreeCAD.Console.PrintError(translate("StarCell", "{}: select two objects first.").format(title) + "\n")
            return
        commands.make(title, ("from starcell_workbench import macros",
                              "macros.make_penetration_depth({})".format(", ".join("FreeCAD.ActiveDocument.getObject({!r})".format(each.Name) for each in picked))),
                      lambda made: made.Report)
