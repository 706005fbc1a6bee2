"""How fast and how lean is a Boolean: ratios, in one run on one machine, to npm's manifold-3d and to CGAL's corefinement
(EPICK), and peak memory. Pairs of bumpy spheres and tori of 15 thousand to a million triangles, and real meshes where
../shared/data is there, at error L/128. Arguments: --quick leaves the largest out; --repeat N takes the best of N (2)."""
import argparse
import json
import math
import os
import subprocess
import sys
import time

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
BUILD = os.path.join(ROOT, "build", "benchmark")
MESHES = os.path.normpath(os.path.join(ROOT, "..", "shared", "data", "meshes"))
REAL = [("cgal_elephant.off", "cgal_dino.off"), ("oded_skull_low_resolution.obj", "cinolib_soccerball.obj"), ("cgal_bear.off", "cinolib_blub_triangulated.obj")]


def bumpy_torus(triangles, seed, major=2.0, minor=0.8):
    """n x 2n quads on a torus with bumps: genus 1, no two facets coplanar."""
    n = max(4, int(math.sqrt(triangles / 4)))
    i, j = np.meshgrid(np.arange(2 * n), np.arange(n), indexing="ij")
    a, b = 2 * np.pi * i / (2 * n), 2 * np.pi * j / n
    r = minor * (1 + 0.08 * np.sin(7 * a + seed) * np.cos(5 * b + 2 * seed))
    points = np.stack([(major + r * np.cos(b)) * np.cos(a), (major + r * np.cos(b)) * np.sin(a), r * np.sin(b)], axis=-1)
    at = lambda i, j: (i % (2 * n)) * n + j % n
    quads = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    return points.reshape(-1, 3), np.concatenate([np.stack([quads[k] for k in t], -1).reshape(-1, 3) for t in ((0, 1, 2), (0, 2, 3))])


def bumpy_sphere(triangles, seed, radius=1.6):
    """An octahedron whose sides are cut n x n and blown up to a sphere with bumps: 8 n^2 triangles."""
    n = max(2, int(math.sqrt(triangles / 8)))
    index, points, facets = {}, [], []

    def vertex(p):
        if p not in index:
            index[p] = len(points)
            points.append(p)
        return index[p]
    for sx, sy, sz in ((x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)):
        at = lambda i, j: vertex((sx * i, sy * j, sz * (n - i - j)))
        turn = sx * sy * sz > 0
        for i in range(n):
            for j in range(n - i):
                corner = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                if i + j < n - 1:
                    corner.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                facets += corner if turn else [t[::-1] for t in corner]
    d = np.array(points, float)
    d /= np.linalg.norm(d, axis=1)[:, None]
    r = radius * (1 + 0.1 * np.sin(6 * d[:, 0] + seed) * np.cos(5 * d[:, 1] - seed) * np.sin(4 * d[:, 2] + 2 * seed))
    return d * r[:, None], np.array(facets)


def turned(mesh, angle, shift):
    k = np.array([[0, -0.6, 0.48], [0.6, 0, -0.64], [-0.48, 0.64, 0]])  # about the unit axis (0.64, 0.48, 0.6)
    return mesh[0] @ (np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k).T + shift, mesh[1]


def write_raw(path, mesh):
    with open(path, "wb") as out:
        np.array([len(mesh[0]), len(mesh[1])], "<u4").tofile(out)
        np.ascontiguousarray(mesh[0], "<f8").tofile(out)
        np.ascontiguousarray(mesh[1], "<u4").tofile(out)


def read_raw(path):
    with open(path, "rb") as source:
        n, m = np.fromfile(source, "<u4", 2)
        return np.fromfile(source, "<f8", 3 * n).reshape(-1, 3), np.fromfile(source, "<u4", 3 * m).reshape(-1, 3)


def volume(mesh):
    p, t = mesh
    if not len(t):
        return 0.0
    a, b, c = (p[t[:, k]] - p[0] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def peak_bytes():
    """Of this process alone: what getrusage says survives exec, and counts the parent before it."""
    with open("/proc/self/status") as status:
        return next(1024 * int(line.split()[1]) for line in status if line.startswith("VmHWM"))


def measure_starcell(operation, first, second):
    """Runs in a process of its own, so that the peak of memory is this Boolean's."""
    import starcell as sc
    a, b = (sc.Polyhedron(*read_raw(path)) for path in (first, second))
    before = peak_bytes()
    error = max(max(h - l for l, h in zip(*solid.bounding_box)) for solid in (a, b)) / 128
    expression = a | b if operation == "union" else a - b if operation == "cut" else a & b
    start = time.perf_counter()
    r = sc.evaluate(expression, error=error)
    seconds = time.perf_counter() - start
    c = r.certificate
    print(json.dumps({"seconds": seconds, "triangles": len(r.triangles), "volume": volume((np.asarray(r.vertices), np.asarray(r.triangles))),
                      "leaves": c.statistics["leaves"], "verdict": c.verdict, "bytes": peak_bytes() - before}))


def prepare():
    """Installs manifold-3d and builds the CGAL program, once; returns how to run each, or None with a message."""
    os.makedirs(BUILD, exist_ok=True)
    runs = {"starcell": [sys.executable, os.path.abspath(__file__), "--measure"]}
    try:
        if not os.path.isdir(os.path.join(BUILD, "node_modules", "manifold-3d")):
            subprocess.run(["npm", "install", "--silent", "--no-audit", "--no-fund", "--prefix", BUILD, "manifold-3d"], check=True)
        script = os.path.join(BUILD, "manifold.mjs")
        with open(os.path.join(HERE, "reference", "manifold.mjs")) as source, open(script, "w") as out:
            out.write(source.read())  # node looks for modules beside the script
        runs["manifold"] = ["node", script]
    except (OSError, subprocess.CalledProcessError) as error:
        print("no comparison with manifold-3d: %s" % error)
    program, source = os.path.join(BUILD, "corefinement"), os.path.join(HERE, "reference", "corefinement.cpp")
    try:
        if not os.path.exists(program) or os.path.getmtime(program) < os.path.getmtime(source):
            subprocess.run(["g++", "-std=c++17", "-O3", "-DNDEBUG", "-frounding-math", source, "-lgmp", "-lmpfr", "-o", program], check=True)
        runs["cgal"] = [program]
    except (OSError, subprocess.CalledProcessError) as error:
        print("no comparison with CGAL: %s" % error)
    return runs


def measured(command, operation, first, second, repeat):
    best = None
    for _ in range(repeat):
        run = subprocess.run(command + [operation, first, second], capture_output=True, text=True)
        if run.returncode:
            return {"error": (run.stderr.strip().splitlines() or ["status %d" % run.returncode])[-1][:100]}
        result = json.loads(run.stdout.strip().splitlines()[-1])
        if best is None or result["seconds"] < best["seconds"]:
            best = result
    return best


def pairs(quick):
    for size in (15_000, 100_000) if quick else (15_000, 100_000, 1_000_000):
        half = size // 2
        yield "generated %dk" % (size // 1000), bumpy_torus(half, 1), turned(bumpy_sphere(half, 2), 0.7, (1.9, 0.3, 0.2)), True
    if not os.path.isdir(MESHES):
        return
    import starcell as sc
    for names in REAL:
        try:
            a, b = ((np.asarray(s.vertices), np.asarray(s.triangles)) for s in (sc.read_mesh(os.path.join(MESHES, n)) for n in names))
        except sc.Error as error:
            print("%s: %s" % (names, error))
            continue
        size = [np.ptp(m[0], axis=0).max() for m in (a, b)]
        b = turned((b[0] * size[0] / size[1], b[1]), 1.1, 0)
        yield " + ".join(names), a, (b[0] - b[0].mean(axis=0) + a[0].mean(axis=0) + 0.13 * size[0], b[1]), False


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--quick", action="store_true")
    options.add_argument("--repeat", type=int, default=2)
    options = options.parse_args()
    runs = prepare()
    row = "%-44s %-13s %9s %9s %9s %9s %8s %8s %9s  %s"
    print(row % ("pair", "operation", "triangles", "starcell", "manifold", "cgal", "/manif.", "/cgal", "memory", "remarks"))
    growth, disagreements = {}, 0
    for name, a, b, is_generated in pairs(options.quick):
        files = [os.path.join(BUILD, "%s.raw" % side) for side in "ab"]
        for path, mesh in zip(files, (a, b)):
            write_raw(path, mesh)
        n = len(a[1]) + len(b[1])
        for operation in ("union", "cut", "intersection"):
            got = {who: measured(command, operation, *files, options.repeat) for who, command in runs.items()}
            own = got["starcell"]
            seconds = lambda who: got.get(who, {}).get("seconds")
            shown = lambda who: "%.3f" % seconds(who) if seconds(who) else "-"
            ratio = lambda who: "%.2f" % (own["seconds"] / seconds(who)) if seconds(who) and seconds("starcell") else "-"
            remarks = ["%s: %s" % (who, r["error"]) for who, r in got.items() if "error" in r]
            if "error" not in own:
                # Surfaces within L/128 of each other: volumes differ by at most that times an area of a few L^2.
                for who in ("manifold", "cgal"):
                    if seconds(who) and abs(got[who]["volume"] - own["volume"]) > 0.03 * volume(a):
                        disagreements += 1
                        remarks.append("volume %.6g, %s has %.6g" % (own["volume"], who, got[who]["volume"]))
                remarks.append("%s, %d leaves" % (own["verdict"], own["leaves"]))
                share = own["bytes"] / (600 * n + 400 * own["leaves"])
                if is_generated:
                    growth.setdefault(operation, []).append((n, own["seconds"]))
            print(row % (name, operation, n, shown("starcell"), shown("manifold"), shown("cgal"), ratio("manifold"), ratio("cgal"),
                         "%.0f%%" % (100 * share) if "error" not in own else "-", "; ".join(remarks)), flush=True)
    print("\nmemory: peak of the Boolean over (600 bytes a triangle + 400 bytes a leaf), the aim being at most 100%")
    for operation, times in growth.items():
        if len(times) > 1:
            (n0, t0), (n1, t1) = times[0], times[-1]
            print("%s: time grows like n^%.2f from %d to %d triangles" % (operation, math.log(t1 / t0) / math.log(n1 / n0), n0, n1))
    if disagreements:
        sys.exit("%d volumes disagree" % disagreements)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--measure"]:
        measure_starcell(*sys.argv[2:])
    else:
        main()
