"""The commands of menu and toolbar: each makes one operation's object from what is selected."""
import FreeCAD
import FreeCADGui

from . import operations, report, resources, runner
from .translation import translate


class OperationCommand:
    """Selection order is the order of the operands: Cut's first object is what is cut."""

    def __init__(self, operation):
        self.operation = operation
        self.least = sum(role.least for role in operation.roles)
        self.most = len(operation.roles)
        self.many = any(role.many for role in operation.roles)

    def GetResources(self):
        least = translate("StarCell", "Select {} or more solids, meshes or containers of such") if self.many else translate(
            "StarCell", "Select {} object")
        return {"Pixmap": resources.icon(self.operation.command),
                "MenuText": translate("StarCell", self.operation.title),
                "ToolTip": "{}\n{}".format(translate("StarCell", self.operation.help), least.format(self.least))}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None and not FreeCADGui.Control.activeDialog() and self.takes(len(selected()))

    def takes(self, count):
        return count >= self.least if self.many else self.least <= count <= self.most

    def Activated(self):
        objects = selected()
        if not self.takes(len(objects)):
            text = translate("StarCell", "{}: select at least {} objects first.") if self.many else translate(
                "StarCell", "{}: select {} object first.")
            FreeCAD.Console.PrintError(text.format(translate("StarCell", self.operation.title), self.least) + "\n")
            return
        names = ", ".join("FreeCAD.ActiveDocument.getObject({!r})".format(each.Name) for each in objects)
        make(translate("StarCell", self.operation.title),
             ("from starcell_workbench import macros, {}".format(_module_name(self.operation)),
              "macros.from_selection({}.{}, [{}]{})".format(_module_name(self.operation), self.operation.__name__, names, self._faces())), report.summary)

    def _faces(self):
        picked = picked_faces() if self.operation.faces else []
        return ", {}={!r}".format(self.operation.faces, picked) if picked else ""


def make(title, lines, said):
    """Runs the macro lines that make one object, as one step to undo, and selects it; said(object) goes to the status bar."""
    document = FreeCAD.ActiveDocument
    document.openTransaction(title)
    try:
        for line in lines:  # through the interpreter, so that the macro recorder writes it down
            FreeCADGui.doCommand(line)
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
        FreeCADGui.getMainWindow().statusBar().showMessage("{}: {}".format(made.Label, said(made)), 10000)


def selected():
    """The selected objects in order of selection; of something picked through a link, the link."""
    objects = []
    for picked in FreeCADGui.Selection.getSelectionEx("", 0):
        for path in picked.SubElementNames or ("",):
            each = _pick(picked.Object, path)
            if each not in objects:
                objects.append(each)
    return objects


def picked_faces():
    """Names of the picked faces, in order."""
    paths = [path for picked in FreeCADGui.Selection.getSelectionEx("", 0) for path in picked.SubElementNames]
    return [name for name in (path.rpartition(".")[2] for path in paths) if name.startswith("Face")]


def _pick(top, path):
    """The object at the end of a sub-object path, or the first link or body on the way to it.

    Beyond a link, placements are its own; inside a body are its features, and the body is what they make.
    """
    steps = path.split(".")[:-1]
    for depth in range(len(steps) + 1):
        each = top.getSubObject(".".join(steps[:depth]) + "." if depth else "", retType=1)
        if each is None:
            return top
        if each.getLinkedObject(False) is not each or each.isDerivedFrom("PartDesign::Body"):
            return each
    return each


def _module_name(operation):
    return operation.__module__.rpartition(".")[2]


def names():
    return list(_commands())


def register():
    """Makes the commands known to FreeCAD; their names in order."""
    for name, command in _commands().items():
        FreeCADGui.addCommand(name, command)
    return names()


def _commands():
    from .depth_command import PenetrationDepthCommand
    from .depth_feature import PenetrationDepth
    from .solid_command import ToSolidCommand
    from .solid_feature import ToSolid

    return {**{operation.command: OperationCommand(operation) for operation in operations.ALL},
            PenetrationDepth.command: PenetrationDepthCommand(), ToSolid.command: ToSolidCommand()}
