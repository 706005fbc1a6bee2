"""Computes the demo's cases with StarCell: demo.py FOLDER. Run by `./run demo`, after model_parts.py and rescue_parts.py have
filled FOLDER.

Writes every result as STL and PLY, a picture of it, and report.md. Each result is held against what is known of it from
elsewhere: topology counted on the drawing, and OpenCASCADE's own volume where its result is valid. Anything that does not
agree fails the command.
"""
import json
import sys
import time
from pathlib import Path

import numpy as np
import starcell as sc

from cases import CASES
from render import Item, picture

STEEL, BRASS, GREEN, RED = (0.62, 0.70, 0.80), (0.87, 0.68, 0.42), (0.55, 0.75, 0.58), (0.85, 0.20, 0.15)
HEAD = ("case", "verdict", "bound / asked (mm)", "components", "genus", "triangles", "seconds", "volume (mm³)", "off OCC by (mm³)",
        "allowed", "picture")


def volume(mesh):
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


class Parts(dict):
    """Solids by name, read from the STEP files when first used, at a quarter of the error, which leaves the rest to the mesh."""

    def __init__(self, folder, error):
        super().__init__(half_space=sc.HalfSpace((0, 0, 0), (1, 0, 0)))
        self.folder, self.error = folder, error

    def __missing__(self, name):
        self[name] = sc.from_brep(self.folder / (name + ".step"), error=self.error)
        return self[name]


def disagreements(case, result, known):
    """What is wrong with a result, as sentences; empty if nothing is."""
    c = result.certificate
    if c.verdict == "unresolved":
        yield "%d cells are unresolved" % len(c.unresolved)
    if c.error_bound > case.error:
        yield "the bound %g exceeds the error %g" % (c.error_bound, case.error)
    if case.genus is not None and c.genus != case.genus:
        yield "genus %s, but the drawing has %s: %s" % (c.genus, case.genus, case.why)
    if case.genus is None and known["valid"] and c.components != known["solids"]:
        yield "%d components, but OpenCASCADE finds %d solids" % (c.components, known["solids"])
    if known["valid"] and abs(volume(result) - known["volume"]) > c.error_bound * known["area"]:
        yield "volume %.3f, but OpenCASCADE finds %.3f" % (volume(result), known["volume"])


def draw(case, result, parts, path):
    shown = [Item(result.vertices, result.triangles, (RED,) if case.context else (STEEL, BRASS, GREEN), lift=0.5 if case.context else 0)]
    for name, colour in zip(case.context, (STEEL, BRASS)):
        shown.append(Item(parts[name].vertices, parts[name].triangles, (colour,)))
    picture(path, shown, case.view, case.up, close_up=bool(case.context))


def row(case, result, seconds, known):
    c = result.certificate
    off, allowed = "OCC invalid", "–"
    if known["valid"]:
        off, allowed = "%+.3f" % (volume(result) - known["volume"]), "%.3f" % (c.error_bound * known["area"])
    return (case.title, c.verdict, "%.4f / %g" % (c.error_bound, case.error), str(c.components), " ".join(map(str, c.genus)) or "–",
            str(len(result.triangles)), "%.2f" % seconds, "%.1f" % volume(result), off, allowed, "![](%s.png)" % case.name)


RESCUE_HEAD = ("rescue", "OpenCASCADE gives", "StarCell (mm³)", "truth (mm³)", "verdict", "bound (mm)", "genus", "triangles", "seconds", "picture")


def rescues(folder):
    """The gallery of Booleans that OpenCASCADE gets wrong: lines of the report, and how many StarCell got wrong too."""
    lines, wrong = ["", "## Rescued from OpenCASCADE", "",
                    "Part's own Booleans of simple primitives, and StarCell's `make_rescue` of the same objects (resources/demo/rescues.py).", "",
                    "| " + " | ".join(RESCUE_HEAD) + " |", "|" + "---|" * len(RESCUE_HEAD)], 0
    for case in json.loads((folder / "rescues.json").read_text()):
        mesh = sc.read_mesh(folder / ("rescue_%s.ply" % case["name"]))
        picture(folder / ("rescue_%s.png" % case["name"]), [Item(mesh.vertices, mesh.triangles, (STEEL, BRASS, GREEN))], (1, -1.4, 0.9))
        lines.append("| " + " | ".join((case["title"], case["opencascade"], "%.3f" % case["volume"], "%.3f" % case["true"], case["verdict"],
                                        "%.4f" % case["bound"], " ".join(map(str, case["genus"])) or "–", str(case["triangles"]),
                                        "%.2f" % case["seconds"], "![](rescue_%s.png)" % case["name"])) + " |")
        for sentence in case["wrong"]:
            wrong += 1
            print("WRONG: %s: %s" % (case["title"], sentence), flush=True)
    return lines, wrong


def report(rows, notes):
    lines = ["# Union, cut and intersection of mechanical parts", "",
             "Made by `./run demo`. The parts are modelled with OpenCASCADE (resources/demo/parts.py), written as STEP, read back by "
             "`starcell.from_brep` and combined by `starcell.evaluate`. Seconds include neither reading nor pictures. "
             "*Allowed* is bound × area: how far a volume may be from OpenCASCADE's own.", "",
             "| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD)]
    lines += ["| " + " | ".join(cells) + " |" for cells in rows]
    return "\n".join(lines + [""] + notes) + "\n"


def main(folder):
    reference = json.loads((folder / "reference.json").read_text())
    rows, notes, wrong = [], [], 0
    for case in CASES:
        parts = Parts(folder, case.error / 4)
        solid = case.expression(parts)
        start = time.perf_counter()
        result = sc.evaluate(solid, error=case.error)
        seconds = time.perf_counter() - start
        rows.append(row(case, result, seconds, reference[case.name]))
        print(" | ".join(rows[-1][:-1]), flush=True)
        result.write(folder / (case.name + ".stl"))
        result.write(folder / (case.name + ".ply"))
        draw(case, result, parts, folder / (case.name + ".png"))
        deflections = ", ".join("%s %.4f mm" % pair for pair in result.certificate.tessellated)
        notes.append("* **%s**: %s. Tessellated on the way in: %s." % (case.title, case.why, deflections or "nothing"))
        for sentence in disagreements(case, result, reference[case.name]):
            wrong += 1
            notes.append("  * WRONG: " + sentence + ".")
            print("WRONG: %s: %s" % (case.name, sentence), flush=True)
    gallery, wrong_rescues = rescues(folder)
    wrong += wrong_rescues
    text = report(rows, notes) + "\n".join(gallery) + "\n"
    (folder / "report.md").write_text(text)
    print("\n" + text + "\nReport, meshes and pictures: build/demo")
    return 1 if wrong else 0


sys.exit(main(Path(sys.argv[1])))
