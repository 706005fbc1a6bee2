"""Computes the demo's rescues in FreeCAD: rescue_parts.py FOLDER. Run by `./run demo` with freecadcmd.

Each case of rescues.py becomes a document with Part's own Boolean and StarCell's Rescue of it. Writes a mesh a case, and
rescues.json: what OpenCASCADE has, what StarCell has, and whether that is what is known to be true.
"""
import json
import os
import sys

import FreeCAD
import starcell_workbench as scw

from rescues import RESCUES

ERROR = 0.02  # mm; the parts are a few mm large
COUNTED = 2e-3  # share by which the known volumes may be off


def rescue(case, folder):
    doc = FreeCAD.newDocument(case.name)
    source = case.build(doc)
    doc.recompute()
    obj = scw.make_rescue(source, error=ERROR)
    obj.Mesh.write(os.path.join(folder, "rescue_%s.ply" % case.name))
    allowed = obj.ErrorBound.Value * obj.Mesh.Area + COUNTED * case.volume
    wrong = []
    if not obj.isValid() or obj.Verdict == "unresolved":
        wrong.append("the verdict is '%s'" % obj.Verdict)
    if abs(obj.Volume.Value - case.volume) > allowed:
        wrong.append("volume %.3f, but the true one is %.3f" % (obj.Volume.Value, case.volume))
    if case.genus is not None and list(obj.Genus) != case.genus:
        wrong.append("genus %s, but the true one is %s" % (list(obj.Genus), case.genus))
    row = {"name": case.name, "title": case.title, "opencascade": case.opencascade, "why": case.why, "true": case.volume,
           "verdict": obj.Verdict, "bound": obj.ErrorBound.Value, "volume": obj.Volume.Value, "genus": list(obj.Genus),
           "agrees": obj.Agrees, "occ_volume": obj.OccVolume.Value, "triangles": obj.Triangles, "seconds": obj.Seconds, "wrong": wrong}
    FreeCAD.closeDocument(doc.Name)
    return row


def main(folder):
    rows = []
    for case in RESCUES:
        rows.append(rescue(case, folder))
        print("%s: %s, %.3f mm3, OpenCASCADE %.3f" % (case.title, rows[-1]["verdict"], rows[-1]["volume"], rows[-1]["occ_volume"]), flush=True)
    with open(os.path.join(folder, "rescues.json"), "w") as file:
        json.dump(rows, file)
    return 0


sys.exit(main(sys.argv[1]))
