# FreeCAD runs this text (it is not imported) when the GUI starts: it makes the workbench known.
# Names of this file are not visible inside the methods, so each method imports what it needs.
import FreeCADGui


class StarCellWorkbench(FreeCADGui.Workbench):
    def __init__(self):
        from starcell_workbench import resources
        from starcell_workbench.translation import translate

        self.__class__.MenuText = translate("StarCell", "StarCell")
        self.__class__.ToolTip = translate("StarCell", "Booleans of solids with a proved topology and a proved distance")
        self.__class__.Icon = resources.icon("StarCell")

    def Initialize(self):
        from starcell_workbench import commands
        from starcell_workbench.translation import QT_TRANSLATE_NOOP

        names = commands.register()
        self.appendToolbar(QT_TRANSLATE_NOOP("Workbench", "StarCell"), names)
        self.appendMenu(QT_TRANSLATE_NOOP("Workbench", "StarCell"), names)

    def ContextMenu(self, recipient):
        from starcell_workbench import commands

        self.appendContextMenu("StarCell", commands.names())

    def GetClassName(self):
        return "Gui::PythonWorkbench"


from starcell_workbench import resources
from starcell_workbench.translation import QT_TRANSLATE_NOOP

FreeCADGui.addLanguagePath(resources.path("translations"))
FreeCADGui.addIcon("preferences-starcell", resources.icon("StarCell"))
FreeCADGui.addPreferencePage(resources.ui("preferences"), QT_TRANSLATE_NOOP("QObject", "StarCell"))
FreeCADGui.addWorkbench(StarCellWorkbench())
