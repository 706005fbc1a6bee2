"""Unions of many round solids, as they are, against manifold-3d on tessellations within the same Hausdorff error: random
spheres, and a lattice of struts with jittered nodes. Ratios of seconds and of triangles, in one run on one machine.
Arguments: --quick takes a tenth of the solids; --repeat N takes the best of N (1)."""
import argparse
import itertools
import json
import math
import os
import random
import subprocess
import sys
import time

import boolean

DIVISIONS = 128


def spheres(count):
    rng = random.Random(5)
    side = 10 * (count / 1000) ** (1 / 3)
    return [{"ball": [rng.uniform(0, side) for _ in range(3)], "radius": rng.uniform(0.4, 0.8)} for _ in range(count)], side + 1


def lattice(count):
    """Three struts a node of a cubic lattice; ends reach a little, and differently far, beyond the nodes."""
    rng = random.Random(7)
    n = round((count / 3) ** (1 / 3))
    node = {c: [x + rng.uniform(-0.15, 0.15) for x in c] for c in itertools.product(range(n + 1), repeat=3)}
    struts = []
    for cell in itertools.product(range(n), repeat=3):
        for axis in range(3):
            a, b = node[cell], node[tuple(x + (k == axis) for k, x in enumerate(cell))]
            unit = [(y - x) / math.dist(a, b) for x, y in zip(a, b)]
            back, on = rng.uniform(0.04, 0.08), rng.uniform(0.04, 0.08)
            struts.append({"strut": [[x - back * u for x, u in zip(a, unit)], [y + on * u for y, u in zip(b, unit)]], "radius": 0.12})
    return struts, n


def segments(solid, error):
    """The fewest (a multiple of four) whose tessellation is within the error: an arc's sagitta; a sphere's worst facet is about an
    octant's middle one, for which twice the sagitta of an edge is enough."""
    share = error / solid["radius"] / (2 if "ball" in solid else 1)
    return max(4, 4 * math.ceil(math.pi / math.acos(max(0.0, 1 - share)) / 4))


def measure(path):
    import numpy as np
    import starcell as sc
    with open(path) as source:
        given = json.load(source)
    start = time.perf_counter()
    solids = [sc.Sphere(s["ball"], s["radius"]) if "ball" in s
              else sc.Cylinder(s["strut"][0], [b - a for a, b in zip(*s["strut"])], s["radius"], math.dist(*s["strut"])) for s in given["solids"]]
    r = sc.evaluate(sc.union(solids), error=given["error"])
    seconds = time.perf_counter() - start
    print(json.dumps({"seconds": seconds, "triangles": len(r.triangles), "volume": boolean.volume((np.asarray(r.vertices), np.asarray(r.triangles))),
                      "verdict": r.certificate.verdict, "genus": sum(r.certificate.genus), "leaves": r.certificate.statistics["leaves"]}))


def run(command, path, repeat):
    best = None
    for _ in range(repeat):
        done = subprocess.run(command + [path], capture_output=True, text=True, check=True)
        result = json.loads(done.stdout.strip().splitlines()[-1])
        if best is None or result["seconds"] < best["seconds"]:
            best = result
    return best


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--quick", action="store_true")
    options.add_argument("--repeat", type=int, default=1)
    options = options.parse_args()
    has_manifold = "manifold" in boolean.prepare()
    script = os.path.join(boolean.BUILD, "manifold_round.mjs")
    with open(os.path.join(boolean.HERE, "reference", "manifold_round.mjs")) as source, open(script, "w") as out:
        out.write(source.read())
    for name, make, count in (("spheres", spheres, 1000), ("struts", lattice, 3000)):
        solids, size = make(count // 10 if options.quick else count)
        error = size / DIVISIONS
        for solid in solids:
            solid["segments"] = segments(solid, error)
        path = os.path.join(boolean.BUILD, "round.json")
        with open(path, "w") as out:
            json.dump({"solids": solids, "error": error}, out)
        own = run([sys.executable, os.path.abspath(__file__), "--measure"], path, options.repeat)
        line = "%d %s at L/%d: %.2f s, %d triangles, %s, genus %d, %d leaves" % (
            len(solids), name, DIVISIONS, own["seconds"], own["triangles"], own["verdict"], own["genus"], own["leaves"])
        if has_manifold:
            other = run(["node", script], path, options.repeat)
            line += "; manifold %.2f s, %d triangles: %.1fx the seconds, %.1fx the triangles, volume %.6g and %.6g" % (
                other["seconds"], other["triangles"], own["seconds"] / other["seconds"], own["triangles"] / other["triangles"],
                own["volume"], other["volume"])
        print(line, flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--measure"]:
        measure(sys.argv[2])
    else:
        main()
