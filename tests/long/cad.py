"""Every CAD file: converted, or refused with a reason; then cut by a copy of itself moved by a quarter of its size.

Passes when the import gives a solid or an sc.Error, and the cut ends with a verdict other than unresolved, a closed mesh,
a volume between 0 and the part's own (a part minus anything is inside it), and, where OpenCASCADE's own cut is valid, within
bound x area of its volume. Arguments: parts of file names."""
import json
import os
import subprocess
import tempfile

import numpy as np
import starcell as sc

from parts import area, is_closed, largest_shape, volume
from table import Table, apart, files

SECONDS = 120


def occ_cut(shape, folder, move):
    """The volume of OpenCASCADE's own cut, or None where it is not valid, fails or takes too long."""
    here = os.path.dirname(os.path.abspath(__file__))
    answer = os.path.join(folder, "occ.json")
    command = [os.path.join(here, "..", "..", "run"), "freecadcmd", os.path.join(here, "occ_cut.py"), shape, answer, *map(repr, move)]
    try:
        subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=SECONDS, check=False)
        with open(answer) as file:
            found = json.load(file)
    except (subprocess.TimeoutExpired, OSError, ValueError):
        return None
    return found["volume"] if found["valid"] else None


def run(path):
    with tempfile.TemporaryDirectory() as folder:
        shape = largest_shape(path, folder)
        try:
            rough = sc.from_brep(shape, 1.0)
            size = max(h - l for l, h in zip(*rough.bounding_box))
            part = sc.from_brep(shape, size / 1000)
        except sc.Error as error:
            return "refused", "%s: %s" % (type(error).__name__, error)
        move = np.eye(4)
        move[:3, 3] = 0.25 * (np.asarray(part.bounding_box[1]) - np.asarray(part.bounding_box[0])) * (1, 0.6, 0.3)
        occ = occ_cut(shape, folder, [float(x) for x in move[:3, 3]])
    whole, cut = (sc.evaluate(e, error=size / 128) for e in (part, part - part.transformed(move)))
    c = cut.certificate
    v, left = (volume(np.asarray(r.vertices), np.asarray(r.triangles)) for r in (whole, cut))
    allowed = c.error_bound * area(np.asarray(cut.vertices), np.asarray(cut.triangles))
    slack = 2 * (allowed + whole.certificate.error_bound * area(np.asarray(whole.vertices), np.asarray(whole.triangles)))
    good = c.verdict != "unresolved" and is_closed(np.asarray(cut.triangles)) and -slack <= left <= v + slack
    good = good and (occ is None or abs(left - occ) <= allowed)
    deflection = max((d for _, d in c.tessellated), default=0.0)
    off = "-" if occ is None else "%.3g of %.3g" % (abs(left - occ), allowed)
    return "cut", (good, c.verdict, off, v, left, deflection / size, len(cut.triangles), c.statistics["seconds"])


table = Table("file", "verdict", "off OCC, of allowed", "volume", "after the cut", "deflection / L", "triangles", "seconds")
for path in files("cad", ".step", ".stp", ".brep", ".fcstd"):
    name = os.path.basename(path)
    kind, answer = apart(run, (path,), 2 * SECONDS)   # OpenCASCADE has its own part of it
    if kind != "value":
        table.judge(name, False, kind, answer[:160])
    elif answer[0] == "refused":
        table.judge(name, True, "refused", answer[1][:200])
    else:
        good, verdict, off, *numbers = answer[1]
        table.judge(name, good, verdict, off, *("%.6g" % x for x in numbers))
table.end()
