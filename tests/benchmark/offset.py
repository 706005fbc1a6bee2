"""How fast is an offset: ratios of seconds, in one run on one machine, to manifold-3d's Minkowski sum with a ball of 128 triangles,
and to OpenVDB at the same measured deviation. Cups and gears where ../shared/data is there, and a bumpy torus; outward by L/20, at
error L/64. Arguments: --quick takes the torus alone; --repeat N takes the best of N (2); --patience S ends a peer's run (600)."""
import argparse
import json
import os
import subprocess
import sys
import time

import numpy as np

import boolean

THESIS = os.path.join(os.path.dirname(boolean.MESHES), "thesis")
MODELS = ("cup_sub_srimug_klampt.off", "cup_sub_vhacd.obj", "gear_sub_cyclone_rodXY.stl", "gear_sub_pinion_cgal.off")
DIVISIONS, SHARE = 64, 0.05
SEGMENTS = 16   # of Manifold's sphere: 128 triangles
MOST_TRIES = 12


def write_raw(path, mesh):
    with open(path, "wb") as out:
        for array in (np.array([len(mesh[0]), len(mesh[1])], np.uint32), np.ascontiguousarray(mesh[0], np.float64), np.ascontiguousarray(mesh[1], np.uint32)):
            out.write(array.tobytes())


def models(quick):
    import starcell as sc
    yield "bumpy torus", sc.Polyhedron(*boolean.bumpy_torus(1000, 1))
    for name in () if quick else MODELS:
        path = os.path.join(THESIS, name)
        if os.path.exists(path):
            try:
                yield name, sc.read_mesh(path)
            except sc.Error as problem:
                print("%s: left out: %s" % (name, problem))


def program(name, *flags):
    binary, source = os.path.join(boolean.BUILD, name), os.path.join(boolean.HERE, "reference", name + ".cpp")
    if not os.path.exists(binary) or os.path.getmtime(binary) < os.path.getmtime(source):
        subprocess.run(["g++", "-std=c++20", "-O3", "-DNDEBUG", source, *flags, "-o", binary], check=True)
    return binary


def run(command, patience):
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=patience)
    return json.loads(done.stdout.strip().splitlines()[-1])


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--quick", action="store_true")
    options.add_argument("--repeat", type=int, default=2)
    options.add_argument("--patience", type=float, default=600)
    options = options.parse_args()
    import starcell as sc
    manifold = None
    if "manifold" in boolean.prepare():
        manifold = os.path.join(boolean.BUILD, "manifold_offset.mjs")
        with open(os.path.join(boolean.HERE, "reference", "manifold_offset.mjs")) as source, open(manifold, "w") as out:
            out.write(source.read())
    deviation = program("offset_deviation", "-frounding-math", "-lgmp", "-lmpfr")
    try:
        openvdb = program("openvdb_offset", "-lopenvdb", "-ltbb", "-lImath")
    except (OSError, subprocess.CalledProcessError) as problem:
        openvdb = print("no comparison with OpenVDB (Debian: libopenvdb-dev): %s" % problem)
    solid, result = os.path.join(boolean.BUILD, "solid.raw"), os.path.join(boolean.BUILD, "offset.raw")

    def deviates(radius):
        return float(subprocess.run([deviation, solid, repr(radius), result], capture_output=True, text=True, check=True).stdout)

    for name, model in models(options.quick):
        write_raw(solid, (model.vertices, model.triangles))
        lower, upper = model.bounding_box
        length = max(upper - lower)
        radius, error = SHARE * length, length / DIVISIONS
        seconds = float("inf")
        for _ in range(options.repeat):
            start = time.perf_counter()
            own = sc.offset(sc.Polyhedron(model.vertices, model.triangles), radius, error=error)
            seconds = min(seconds, time.perf_counter() - start)
        write_raw(result, (own.vertices, own.triangles))
        ours = deviates(radius)
        print("%s, %d triangles, +L/%d at L/%d: %.2f s, %d triangles, %s, genus %s, measured L/%.0f" % (
            name, len(model.triangles), 1 / SHARE, DIVISIONS, seconds, len(own.triangles), own.certificate.verdict, own.certificate.genus, length / ours), flush=True)
        if manifold:
            try:
                best = min((run(["node", manifold, solid, repr(radius), str(SEGMENTS), result], options.patience) for _ in range(options.repeat)),
                           key=lambda each: each["seconds"])
                print("  manifold-3d, ball of %d triangles: %.2f s, %d triangles, measured L/%.0f: %.1fx our seconds" % (
                    best["ball"], best["seconds"], best["triangles"], length / deviates(radius), best["seconds"] / seconds), flush=True)
            except (subprocess.CalledProcessError, subprocess.TimeoutExpired, ValueError) as problem:
                print("  manifold-3d: %s" % str(problem)[-200:], flush=True)
        if openvdb:
            voxel = 2 * error
            for _ in range(MOST_TRIES):   # the coarsest grid whose result is as near as ours
                best = min((run([openvdb, solid, repr(radius), repr(voxel), result], options.patience) for _ in range(options.repeat)), key=lambda each: each["seconds"])
                theirs = deviates(radius)
                if theirs <= ours:
                    break
                voxel *= 0.8
            print("  OpenVDB, voxels of L/%.0f: %.2f s, %d triangles, measured L/%.0f: %.1fx our seconds" % (
                length / voxel, best["seconds"], best["triangles"], length / theirs, best["seconds"] / seconds), flush=True)


if __name__ == "__main__":
    main()
