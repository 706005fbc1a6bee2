"""Every mesh and every CAD part, 1 % and 5 % of its size outward and inward, at error size / 256, with 60 s and 4 GiB each.

Passes when the file is refused with a reason, or the offset is certified (`exact` or `contact`), closed, and larger or smaller than
the part as it should be, within bound x area. Arguments: parts of file names."""
import os
import resource
import tempfile
import time

import numpy as np
import starcell as sc

from parts import area, is_closed, largest_shape, volume
from table import Table, apart, files, unpacked

SHARES = (0.01, -0.01, 0.05, -0.05)
SECONDS, BYTES = 60, 4 << 30
CAD = (".stp", ".step", ".brep", ".fcstd")
MESH = (".off", ".obj", ".stl", ".ply")


def read(path, folder):
    plain = unpacked(path, folder)
    if not plain.lower().endswith(CAD):
        return sc.read_mesh(plain)
    shape = largest_shape(plain, folder)
    lower, upper = sc.from_brep(shape, 1.0).bounding_box
    return sc.from_brep(shape, max(h - l for l, h in zip(lower, upper)) / 2048)   # an eighth of the error


def run(path, share):
    with tempfile.TemporaryDirectory() as folder:
        try:
            part = read(path, folder)
        except sc.Error as problem:
            return "refused", "%s: %s" % (type(problem).__name__, problem)
    size = max(h - l for l, h in zip(*part.bounding_box))
    begun = time.monotonic()
    try:
        result = sc.offset(part, share * size, error=size / 256, budget=sc.Budget(max_seconds=SECONDS, max_bytes=BYTES))
    except sc.Error as problem:
        return "refused", "%s: %s" % (type(problem).__name__, problem)
    seconds, c = time.monotonic() - begun, result.certificate
    vertices, triangles = np.asarray(result.vertices), np.asarray(result.triangles)
    whole = part if isinstance(part, sc.Polyhedron) else sc.evaluate(part, error=size / 256)
    before = volume(np.asarray(whole.vertices), np.asarray(whole.triangles))
    grown = (volume(vertices, triangles) - before) * np.sign(share)
    sound = is_closed(triangles) and grown > -c.error_bound * area(vertices, triangles)
    megabytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    genus = "%d: %s" % (c.components, ",".join(map(str, c.genus[:6])))
    return c.verdict, (sound and c.verdict != "unresolved", genus, seconds, len(triangles), megabytes, len(c.unresolved))


table = Table("file and share", "verdict", "components: genus", "seconds", "triangles", "MB", "unresolved cells")
for path in files("meshes", *MESH) + files("cad", *CAD):
    for share in SHARES:
        name = os.path.basename(path)
        kind, answer = apart(run, (path, share), 4 * SECONDS)
        if kind != "value":
            table.judge("%s %+g" % (name, share), False, kind, answer[:160])
        elif answer[0] == "refused":
            table.judge("%s %+g" % (name, share), True, "refused", answer[1][:160])
            break
        else:
            good, genus, seconds, count, megabytes, cells = answer[1]
            table.judge("%s %+g" % (name, share), good, answer[0], genus, "%.1f" % seconds, count, "%.0f" % megabytes, cells)
table.end()
