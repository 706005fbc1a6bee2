"""The parametric object of every operation: its properties, its recompute, and what a new operation has to say of itself.

An operation is a subclass that names its operands (roles), its own parameters, and the engine's call. The class is the
proxy of a Mesh::FeaturePython, and its path is stored in documents: rename or move one only with a migration.
All state is in properties. A recompute that fails raises, so that FreeCAD marks the object, and changes none of them.
"""
import tempfile
import time
from dataclasses import dataclass

import FreeCAD

from . import engine, mesh_transfer, operands, report, runner, settings
from .stateless import Stateless
from .translation import QT_TRANSLATE_NOOP, translate

READ_ONLY, HIDDEN, OUTPUT = 1, 4, 8  # FreeCAD's property attributes

# Tessellating curved CAD faces may take this share of the error; the rest is left to the engine.
TESSELLATION_SHARE = 0.25


@dataclass(frozen=True)
class Role:
    """A property that links operands: one object (or, if `least` is 0, none), or a list of at least `least`."""
    name: str
    help: str
    many: bool = True
    least: int = 1


@dataclass(frozen=True)
class Parameter:
    """A property that the user sets, with the engine's meaning in `help`."""
    name: str
    type: str
    help: str
    default: object = None


@dataclass(frozen=True)
class Highlighted:
    """Places to draw over everything else: boxes, and segments if there are any."""
    places: str     # property with two corners a box
    switch: str     # property of the view that turns them on and off
    title: str      # of the switch in the panel
    help: str
    spokes: str = ""  # property with two ends a segment

    @property
    def last(self):
        """The property that is added last: once it is there, all are."""
        return self.spokes or self.places


class OperationFeature(Stateless):
    # What a subclass says of itself.
    command = ""    # name of the command, of its icon, and start of the objects' names after "StarCell_"
    title = ""      # menu text and first label
    help = ""       # tooltip
    roles = ()
    parameters = ()
    faces = None    # the parameter that takes the names of faces picked with the operand, if there is one
    highlighted = None  # a Highlighted, if there are places to draw
    keeps_operands = False  # stay visible, and where they are in the tree
    outputs = ()    # (type, name, attributes, help) of what published() sets

    def compute(self, starcell, solids, values, options):
        """The engine's call. solids: {role: solid or list of solids}; values: {parameter: value}; options: error, contact, ..."""
        raise NotImplementedError

    def gather(self, each, obj, chosen, folder):
        """What the linked object `each` is for `obj`: label, box, and solid() for the worker. Shapes are written to files in `folder`."""
        return operands.gather(each, obj, folder)

    def examine(self, starcell, solids, values, result, options):
        """More to know of the result than its certificate, for published(); called in the worker, like compute()."""

    def published(self, obj, result, findings):
        """Called when the output properties are set: an operation with more to say adds it here. findings: what examine() returned."""

    def reach(self, boxes):
        """A box that the result will not leave, from {role: box or list of boxes}: it sets the automatic error."""
        whole = FreeCAD.BoundBox()
        for role in self.roles:
            for box in boxes[role.name] if role.many else filter(None, [boxes[role.name]]):
                whole.add(box)
        return whole

    # The document object.

    def __init__(self, obj):
        obj.Proxy = self
        self.add_properties(obj)

    def add_properties(self, obj):
        """Adds what is missing: to a new object all, to one of an older version what came later."""
        def add(type_, name, group, help_, attributes=0, default=None):
            if name not in obj.PropertiesList:
                obj.addProperty(type_, name, group, help_, attributes)
                if default is not None:
                    setattr(obj, name, default)

        # "Global" links may cross containers; placements are taken into account.
        for role in self.roles:
            add("App::PropertyLinkListGlobal" if role.many else "App::PropertyLinkGlobal", role.name, "Operation", role.help)
        for parameter in self.parameters:
            add(parameter.type, parameter.name, "Operation", parameter.help, default=parameter.default)
        add("App::PropertyLength", "Error", "Precision", QT_TRANSLATE_NOOP(
            "App::Property", "Largest distance between the mesh and the true surface, both ways; 0: automatic"))
        add("App::PropertyLength", "Contact", "Precision", QT_TRANSLATE_NOOP(
            "App::Property", "What is closer than this counts as touching; 0: a hundredth of the error"))
        add("App::PropertyInteger", "ErrorDivisor", "Precision", QT_TRANSLATE_NOOP(
            "App::Property", "The automatic error is the longest side divided by this"), default=settings.automatic_error_divisor())
        add("App::PropertyLinkListGlobal", "Frames", "Operation", QT_TRANSLATE_NOOP(
            "App::Property", "Containers whose placement moves an operand against the result"), HIDDEN | OUTPUT)
        for type_, name, help_ in (
                ("App::PropertyString", "Verdict", QT_TRANSLATE_NOOP("App::Property", "exact, contact or unresolved: what is proved of the mesh")),
                ("App::PropertyLength", "ErrorBound", QT_TRANSLATE_NOOP("App::Property", "Proved distance between the mesh and the true surface")),
                ("App::PropertyInteger", "Components", QT_TRANSLATE_NOOP("App::Property", "Number of connected components of the surface")),
                ("App::PropertyIntegerList", "Genus", QT_TRANSLATE_NOOP("App::Property", "Handles of each component, the largest first")),
                ("App::PropertyInteger", "Triangles", QT_TRANSLATE_NOOP("App::Property", "Number of triangles")),
                ("App::PropertyVolume", "Volume", QT_TRANSLATE_NOOP("App::Property", "Volume of the mesh")),
                ("App::PropertyFloat", "Seconds", QT_TRANSLATE_NOOP("App::Property", "Duration of the last run")),
                ("App::PropertyString", "Report", QT_TRANSLATE_NOOP("App::Property", "The certificate in words")),
                ("App::PropertyString", "Certificate", QT_TRANSLATE_NOOP("App::Property", "The certificate as JSON"))):
            add(type_, name, "Certificate", help_, READ_ONLY | OUTPUT)
        for type_, name, attributes, help_ in self.outputs:
            add(type_, name, "Findings", help_, attributes)

    def linked(self, obj):
        """The operands, role after role."""
        return [each for role in self.roles for each in self.linked_by(obj, role)]

    def linked_by(self, obj, role):
        value = getattr(obj, role.name)
        return list(value) if role.many else [value] if value else []

    def execute(self, obj):
        start = time.monotonic()
        try:
            starcell = engine.load()
            links = {role.name: self.linked_by(obj, role) for role in self.roles}
            with tempfile.TemporaryDirectory(prefix="starcell-") as folder:
                self._keep_frames(obj)
                work, asked = self.prepare(obj, starcell, links, self.chosen(obj), folder)
                result, findings = runner.run(lambda progress: work(progress, examines=True), obj.Label)
            mesh = mesh_transfer.to_mesh(result.vertices, result.triangles)
        except Exception as problem:
            raise RuntimeError("{}: {}".format(obj.Label, problem)) from None
        mesh.Placement = obj.Placement  # assigning a mesh overwrites the object's placement
        obj.Mesh = mesh
        report.publish(obj, result, asked, self.linked(obj), time.monotonic() - start)
        self.published(obj, result, findings)

    def chosen(self, obj):
        """{property: plain value} of all that the user chooses beside the links."""
        names = [parameter.name for parameter in self.parameters] + ["Error", "Contact"]
        return {name: _plain(getattr(obj, name)) for name in names}

    def prepare(self, obj, starcell, links, chosen, folder):
        """(work, error): the call for a worker, free of FreeCAD, and the error asked for. Shapes are written to `folder`.

        links: {role: objects}; chosen: as chosen() returns. work(progress, coarser=1, examines=False, **options) returns the result at
        `coarser` times the error, or (result, findings) if it examines.
        """
        given = self._gather(obj, links, chosen, folder)
        error = chosen["Error"] or self._automatic_error(obj, given, chosen)
        options = {"threads": settings.threads()}
        if chosen["Contact"]:
            options["contact"] = chosen["Contact"]

        reading = translate("StarCell", "reading the operands")

        def work(progress, coarser=1, examines=False, **more):
            progress(0.0, reading)
            solids = _over(given, lambda operand: operand.solid(starcell, TESSELLATION_SHARE * coarser * error))
            everything = dict(options, error=coarser * error, progress=progress, **more)
            result = self.compute(starcell, solids, chosen, everything)
            return (result, self.examine(starcell, solids, chosen, result, everything)) if examines else result

        return work, error

    def _gather(self, obj, links, chosen, folder):
        """{role: Operand or list of Operands}."""
        given = {}
        for role in self.roles:
            objects = links[role.name]
            if len(objects) < role.least:
                raise operands.OperandError(translate("StarCell", "{} needs at least {} object(s), and has {}.").format(
                    role.name, role.least, len(objects)))
            gathered = [self.gather(each, obj, chosen, folder) for each in objects]
            given[role.name] = gathered if role.many else next(iter(gathered), None)
        return given

    def _keep_frames(self, obj):
        """Links to the containers whose placement matters, so that moving one recomputes the object."""
        frames = operands.frames_between(obj, self.linked(obj))
        if sorted(each.Name for each in frames) != sorted(each.Name for each in obj.Frames):
            obj.Frames = frames

    def _automatic_error(self, obj, given, chosen):
        if obj.ErrorDivisor < 1:
            raise ValueError(translate("StarCell", "ErrorDivisor must be at least 1, and is {}.").format(obj.ErrorDivisor))
        box = self.reach(_over(given, lambda operand: operand.box))
        return max(box.XLength, box.YLength, box.ZLength) / obj.ErrorDivisor

    def onDocumentRestored(self, obj):
        self.add_properties(obj)
        if FreeCAD.GuiUp and obj.ViewObject:
            if obj.ViewObject.Proxy:
                obj.ViewObject.Proxy.add_properties(obj.ViewObject)
            else:  # saved by a session without a GUI
                from .operation_view import OperationView

                OperationView(obj.ViewObject)


def recompute(obj):
    """Recomputes the document. FreeCAD leaves out what depends on a failed object; `obj` is tried nonetheless, to say why it fails."""
    obj.Document.recompute()
    if "Touched" in obj.State and obj.isValid():
        obj.recompute()


def _over(given, function):
    """`function` of every Operand in {role: Operand or list of Operands}."""
    def of(value):
        return [function(each) for each in value] if isinstance(value, list) else None if value is None else function(value)

    return {name: of(value) for name, value in given.items()}


def _plain(value):
    return value.Value if hasattr(value, "Value") else value
