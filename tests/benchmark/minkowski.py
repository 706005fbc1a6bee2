"""How fast is a Minkowski sum: ratios of seconds, in one run on one machine, to CGAL's minkowski_sum_3 and to npm's manifold-3d, at
error L/128 of the sum; pairs of the sizes in table 4.1 of the thesis; a pair of 10,000 triangles each;
and how seconds grow with m·n. Arguments: --quick leaves the thesis' pairs, the large one and the largest of the growth out; --repeat N
takes the best of N (2); --patience S ends a peer's run (120); --patience-large S lets the peers try the large pair (0: not)."""
import argparse
import json
import math
import os
import subprocess
import sys
import time

import numpy as np

import boolean
import shapes
from offset import program

THESIS = os.path.join(os.path.dirname(boolean.MESHES), "thesis")
DIVISIONS = 128
# Of the thesis' pairs models of the same sizes, from data/thesis or shapes.py, and its seconds (2 GHz Pentium 4).
TABLE = (("Brake Hub + Rod", "brakehub_sub_coupling_cgal.off", "syn_rod_44.off", 140), ("Anvil + Spoon", shapes.anvil, shapes.spoon, 63),
         ("Wrench + Spiral", shapes.wrench, shapes.spiral, 316), ("Knife + Scissors", shapes.knife, shapes.scissors, 778),
         ("Grates 1 + 2", "syn_grate1_440.off", "syn_grate2_1136.off", 3162))


def model(source):
    """(points, facets) of a file in data/thesis, or of a function; none if the file is not there."""
    if callable(source):
        return source()
    import starcell as sc
    path = os.path.join(THESIS, source)
    if not os.path.exists(path):
        return None
    solid = sc.read_mesh(path)
    return np.asarray(solid.vertices), np.asarray(solid.triangles)


def ball(radius):
    """128 triangles."""
    points, facets = boolean.bumpy_sphere(128, 0)
    return radius * points / np.linalg.norm(points, axis=1)[:, None], facets


def summed(a, b, repeat):
    """(best seconds, result, facets made) of our sum."""
    import starcell as sc
    solids = [sc.Polyhedron(*mesh) for mesh in (a, b)]
    length = sum(max(h - l for l, h in zip(*solid.bounding_box)) for solid in solids)
    seconds, result = float("inf"), None
    for _ in range(repeat):
        start = time.perf_counter()
        result = sc.minkowski_sum(*solids, error=length / DIVISIONS)
        seconds = min(seconds, time.perf_counter() - start)
    return seconds, result


def say(name, a, b, seconds, result, remark=""):
    m, n = len(a[1]), len(b[1])
    made = int(result.certificate.statistics["candidates"])
    print("%s, %d and %d triangles: %.2f s, %d candidates of %d pairs (%.2f%%), %d triangles, %s, genus %s%s" % (
        name, m, n, seconds, made, m * n, 100 * made / (m * n), len(result.triangles), result.certificate.verdict, result.certificate.genus, remark), flush=True)


def peers(runs, a, b, patience, own):
    files = [os.path.join(boolean.BUILD, "%s.raw" % side) for side in "ab"]
    for path, mesh in zip(files, (a, b)):
        boolean.write_raw(path, mesh)
    volume = boolean.volume((np.asarray(own[1].vertices), np.asarray(own[1].triangles)))
    for name, command in runs.items():
        try:
            done = subprocess.run([*command, *files], capture_output=True, text=True, check=True, timeout=patience)
            peer = json.loads(done.stdout.strip().splitlines()[-1])
            print("  %s: %.2f s, %d triangles: %.1fx our seconds; volume %.6g, ours %.6g%s" % (
                name, peer["seconds"], peer["triangles"], peer["seconds"] / own[0], peer["volume"], volume,
                "; genus %s" % peer["genus"] if "genus" in peer else ""), flush=True)
        except subprocess.TimeoutExpired:
            print("  %s: not done in %d s, %.0fx our seconds" % (name, patience, patience / own[0]), flush=True)
        except (subprocess.CalledProcessError, ValueError, IndexError) as problem:
            print("  %s: %s" % (name, str(problem)[-200:]), flush=True)


def prepared():
    runs = {}
    if "manifold" in boolean.prepare():
        script = os.path.join(boolean.BUILD, "manifold_minkowski.mjs")
        with open(os.path.join(boolean.HERE, "reference", "manifold_minkowski.mjs")) as source, open(script, "w") as out:
            out.write(source.read())
        runs["manifold-3d"] = ["node", script]
    try:
        runs["CGAL"] = [program("minkowski_sum_3", "-frounding-math", "-lgmp", "-lmpfr")]
    except (OSError, subprocess.CalledProcessError) as problem:
        print("no comparison with CGAL: %s" % problem)
    return runs


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--quick", action="store_true")
    options.add_argument("--repeat", type=int, default=2)
    options.add_argument("--patience", type=float, default=120)
    options.add_argument("--patience-large", type=float, default=0)
    options = options.parse_args()
    runs = prepared()
    small = boolean.turned(shapes.torus(1.1, 0.35, 12, 8), 1.3, (0, 0, 0))
    for name, a, b in (("gear + gear", shapes.gear(12, 8, 10, 3), shapes.gear(6, 1, 1.6, 0.8)), ("torus + torus", shapes.torus(2, 0.7, 12, 8), small),
                       ("torus + ball", shapes.torus(2, 0.7, 48, 24), ball(0.5))):
        own = summed(a, b, options.repeat)
        say(name, a, b, *own)
        peers(runs, a, b, options.patience, own)
    if not options.quick:
        print("\nthe sizes of the thesis' table 4.1")
        for name, first, second, theirs in TABLE:
            a, b = model(first), model(second)
            if a and b:
                say(name, a, b, *summed(a, b, 1), "; the thesis took %d s" % theirs)
    if not options.quick:
        print()
        a, b = boolean.bumpy_torus(10000, 1), boolean.turned(boolean.bumpy_torus(10000, 2, 0.5, 0.2), 0.7, (0.3, 0.2, 0.1))
        own = summed(a, b, 1)
        say("bumpy torus + bumpy torus", a, b, *own)
        if options.patience_large > 0:
            peers(runs, a, b, options.patience_large, own)
    print("\ngrowth, bumpy tori")
    known = []
    for size in (300, 600, 1200, 2400) if options.quick else (300, 600, 1200, 2400, 4800):
        a, b = boolean.bumpy_torus(size, 1), boolean.turned(boolean.bumpy_torus(size, 2, 0.5, 0.2), 0.7, (0.3, 0.2, 0.1))
        own = summed(a, b, 1)
        say("  %d" % size, a, b, *own)
        known.append((len(a[1]) * len(b[1]), own[0]))
    print("seconds grow like (m n)^%.2f" % (math.log(known[-1][1] / known[0][1]) / math.log(known[-1][0] / known[0][0])))


if __name__ == "__main__":
    sys.exit(main())
