"""Does the subdivision end? Every mesh alone, with no error asked for and with L/128: leaves and unresolved cells of the
trace criterion and of the thesis's own (complex-cell, depth at most 12, 5 s). A trace cell left unresolved is a failure;
complex-cell stands beside it for comparison (DESIGN §3 explains why it does not end). Arguments: parts of file names."""
import math
import tempfile

import starcell as sc

from table import Table, apart, files, unpacked

TRACE_SECONDS, THESIS_SECONDS = 900, 5


def run(path, part, criterion):
    with tempfile.TemporaryDirectory() as folder:
        solid = sc.read_mesh(unpacked(path, folder))
    lower, upper = solid.bounding_box
    error = max(h - l for l, h in zip(lower, upper)) * part
    budget = sc.Budget(max_depth=12, max_seconds=THESIS_SECONDS) if criterion == "complex-cell" else sc.Budget()
    c = sc.evaluate(solid, error=error, criterion=criterion, budget=budget).certificate
    return int(c.statistics["leaves"]), len(c.unresolved), c.verdict, c.statistics["seconds"], c.error_bound <= error


def shown(kind, answer):
    return "%d / %d" % answer[:2] if kind == "value" else kind


table = Table("mesh", "error", "trace", "seconds", "complex-cell", "seconds")
for path in files("meshes", ".off", ".obj", ".stl", ".ply"):
    name = path.replace("\\", "/").rsplit("/", 1)[-1]
    for label, part in (("none", math.inf), ("L/128", 1 / 128)):
        kind, answer = apart(run, (path, part, "trace"), TRACE_SECONDS)
        if kind == "raised" and answer.startswith("InvalidSolidError"):
            table.row(name, "refused: " + answer[:100])
            break
        other_kind, other = apart(run, (path, part, "complex-cell"), 12 * THESIS_SECONDS)
        ok = kind == "value" and answer[1] == 0 and answer[2] != "unresolved" and answer[4]
        table.judge("%s, error %s" % (name, label), ok, label, shown(kind, answer), "%.2f" % answer[3] if kind == "value" else answer[:80],
                    shown(other_kind, other), "%.2f" % other[3] if other_kind == "value" else other[:40])
table.end()
