"""Models the demo's parts in FreeCAD: model_parts.py FOLDER. Run by `./run demo` with freecadcmd.

Writes a STEP file a part, and reference.json: what OpenCASCADE's own Booleans give for the demo's cases.
"""
import json
import os
import sys
import time
from contextlib import contextmanager

import Part
from FreeCAD import Vector

from cases import CASES
from parts import PARTS


class Shape:
    """OpenCASCADE's Booleans behind the operators that cases.py uses."""

    def __init__(self, shape):
        self.shape = shape

    def __or__(self, other):
        return Shape(self.shape.fuse(other.shape))

    def __and__(self, other):
        return Shape(self.shape.common(other.shape))

    def __sub__(self, other):
        return Shape(self.shape.cut(other.shape))


def reference(case, shapes):
    start = time.perf_counter()
    try:
        shape = case.expression(shapes).shape
    except Part.OCCError as error:
        return {"valid": False, "reason": str(error)}
    return {"valid": shape.isValid() and shape.Volume > 0, "volume": shape.Volume, "area": shape.Area,
            "solids": len(shape.Solids), "seconds": time.perf_counter() - start}


@contextmanager
def quiet():
    """OpenCASCADE's STEP writer reports every transfer on the process's standard output."""
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


folder = sys.argv[1]
shapes = {}
for name, make in PARTS.items():
    shape = make()
    if not shape.isValid() or shape.Volume <= 0 or len(shape.Solids) != 1:
        sys.exit("%s: OpenCASCADE calls this part invalid" % name)
    with quiet():
        shape.Solids[0].exportStep(os.path.join(folder, name + ".step"))
    shapes[name] = Shape(shape.Solids[0])
    print("%-14s %3d faces, %8.0f mm³" % (name, len(shape.Faces), shape.Volume))
# OpenCASCADE has no unbounded solids: a box that is large enough stands for the half-space x < 0.
shapes["half_space"] = Shape(Part.makeBox(500, 1000, 1000, Vector(-500, -500, -500)))

with open(os.path.join(folder, "reference.json"), "w") as file:
    json.dump({case.name: reference(case, shapes) for case in CASES}, file, indent=1)
