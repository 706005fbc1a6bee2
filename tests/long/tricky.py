"""Every tricky file gives a result or an sc.Error: read or imported in a process of its own, joined with a box, with a time
limit. A crash, a hang or any other exception is a failure. Arguments: parts of file names."""
import os
import tempfile

import starcell as sc

from table import Table, apart, files, unpacked

SECONDS = 300
CAD = (".stp", ".step", ".brep")
MESH = (".off", ".obj", ".stl", ".ply")


def run(path):
    with tempfile.TemporaryDirectory() as folder:
        plain = unpacked(path, folder)
        try:
            solid = sc.from_brep(plain, 0.01) if plain.lower().endswith(CAD) else sc.read_mesh(plain)
        except sc.Error as error:
            return "refused", "%s: %s" % (type(error).__name__, error)
    lower, upper = solid.bounding_box
    size = max(h - l for l, h in zip(lower, upper))
    corner = [(l + h) / 2 for l, h in zip(lower, upper)]
    try:
        c = sc.evaluate(solid | sc.Box(corner, [x + 0.7 * size for x in corner]), error=size / 64,
                        budget=sc.Budget(max_seconds=120)).certificate
    except sc.Error as error:
        return "refused", "%s: %s" % (type(error).__name__, error)
    return c.verdict, "%d components, %d leaves, %.2f s" % (c.components, c.statistics["leaves"], c.statistics["seconds"])


table = Table("file", "outcome", "what")
for path in files("tricky", *CAD, *MESH):
    kind, answer = apart(run, (path,), SECONDS)
    outcome, what = answer if kind == "value" else (kind, answer)
    table.judge(os.path.basename(path), kind == "value", outcome, what.replace("\n", " ")[:160])
table.end()
