"""How few triangles does simplification leave, and how fast: beside CGAL's edge collapse with its polyhedral envelope filter, at the same error, in one
run. CGAL's envelope bounds one direction only. Meshes from data/meshes and data/thesis where they are there, and two that are made here.
Arguments: --quick takes the made ones and three files; --most N leaves larger meshes out (250000: the peer takes hours beyond); --patience S ends a peer's run (120); --divisions N ... of the longest side (32 128 512)."""
import argparse
import json
import os
import subprocess
import time

import numpy as np

import boolean
from offset import THESIS, program, write_raw

FEW = ("cgal_elephant.off", "cgal_knot1.off", "trimesh_featuretype.ply")
KINDS = (".off", ".obj", ".stl", ".ply")


def models(quick, most):
    import starcell as sc
    yield "bumpy torus", sc.Polyhedron(*boolean.bumpy_torus(8000, 1))
    yield "bumpy sphere", sc.Polyhedron(*boolean.bumpy_sphere(8000, 1))
    for folder in (boolean.MESHES, THESIS):
        for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else ():
            if (quick and name not in FEW) or os.path.splitext(name)[1].lower() not in KINDS:
                continue
            try:
                solid = sc.read_mesh(os.path.join(folder, name))
            except sc.Error as problem:
                print("%s: left out: %s" % (name, str(problem)[:80]))
                continue
            if len(solid.triangles) <= most:
                yield name, solid


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--quick", action="store_true")
    options.add_argument("--most", type=int, default=250000)
    options.add_argument("--patience", type=float, default=120)
    options.add_argument("--divisions", type=int, nargs="+", default=[32, 128, 512])
    options = options.parse_args()
    import starcell as sc
    boolean.prepare()
    peer = program("edge_collapse", "-I/usr/include/eigen3", "-lgmp", "-lmpfr", "-ltbb")
    raw = os.path.join(boolean.BUILD, "simplify.raw")
    fewer = faster = both = 0
    for name, solid in models(options.quick, options.most):
        write_raw(raw, (np.asarray(solid.vertices), np.asarray(solid.triangles)))
        for division in options.divisions:
            error = max(high - low for low, high in zip(*solid.bounding_box)) / division
            start = time.perf_counter()
            result = sc.simplify(solid, error=error)
            seconds = time.perf_counter() - start
            said = "%s, %d triangles, L/%d: %d left, %.2f s, %s, bound %.3f of the error" % (
                name, len(solid.triangles), division, len(result.triangles), seconds, result.certificate.verdict, result.certificate.error_bound / error)
            try:
                done = subprocess.run([peer, raw, repr(error)], capture_output=True, text=True, check=True, timeout=options.patience)
                cgal = json.loads(done.stdout)
                said += "; CGAL: %d left, %.2f s%s: %.2fx our triangles, %.1fx our seconds" % (
                    cgal["triangles"], cgal["seconds"], "" if cgal["embedded"] else ", crosses itself", cgal["triangles"] / len(result.triangles), cgal["seconds"] / seconds)
                if cgal["embedded"]:
                    both += 1
                    fewer += len(result.triangles) <= cgal["triangles"]
                    faster += seconds <= cgal["seconds"]
            except subprocess.TimeoutExpired:
                said += "; CGAL: not done in %d s" % options.patience
            except (subprocess.CalledProcessError, ValueError) as problem:
                said += "; CGAL: %s" % str(problem)[-80:]
            print(said, flush=True)
    print("of %d with a sound mesh from both: no more triangles in %d, no more seconds in %d" % (both, fewer, faster))


if __name__ == "__main__":
    main()
