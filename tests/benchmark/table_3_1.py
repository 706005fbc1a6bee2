"""The rows of the thesis' table 3.1 on models of the same kinds and sizes: triangles and seconds beside the thesis' (2 GHz Pentium 4).

The models come from ../shared/data where it is there; smaller ones are brought to the thesis' sizes by cutting every triangle in four,
with new points pushed off a little if there is room, as scans are rough. Arguments: --quick takes remeshing and curved solids alone; --cuts K
cuts K times at most (3)."""
import argparse
import gzip
import os
import time

import numpy as np

import boolean

THESIS = os.path.join(os.path.dirname(boolean.MESHES), "thesis")
ROUGHNESS = (1 / 4000, 1 / 40000, 0)  # of the size; the next if the mesh crosses itself


def read(name):
    """(points, triangles) of an OFF or OBJ file, repaired if it is no solid; none if it is not there."""
    import starcell as sc
    path = os.path.join(THESIS, name)
    if not os.path.exists(path):
        return None
    with (gzip.open if path.endswith(".gz") else open)(path, "rt") as lines:
        words = [line.split() for line in lines if line.strip() and not line.startswith("#")]
    if words[0][0] == "OFF":
        count = int(words[1][0])
        points, triangles = words[2:2 + count], [[int(v) for v in face[1:4]] for face in words[2 + count:]]
    else:
        points = [each[1:4] for each in words if each[0] == "v"]
        triangles = [[int(v.split("/")[0]) - 1 for v in each[1:4]] for each in words if each[0] == "f"]
    mesh = np.array(points, float), np.array(triangles)
    try:
        sc.Polyhedron(*mesh)
    except sc.InvalidSolidError:
        mended = sc.repair(*mesh, error=np.ptp(mesh[0], axis=0).max() / 1000)
        mesh = np.asarray(mended.vertices), np.asarray(mended.triangles)
    return mesh


def cut_in_four(mesh, roughness, rng):
    """At the midpoints of edges, moved at random by no more than `roughness`, and by less where edges are short."""
    points, triangles = mesh
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, at = np.unique(edges, axis=0, return_inverse=True)
    at = at.reshape(-1, 3) + len(points)
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    reach = np.minimum(roughness * np.ptp(points, axis=0).max(), 0.01 * np.linalg.norm(b - a, axis=1))
    middle = 0.5 * (a + b) + reach[:, None] * rng.uniform(-0.5, 0.5, a.shape)
    (p, q, r), (u, v, w) = triangles.T, at.T
    return np.concatenate([points, middle]), np.concatenate([np.stack(t, -1) for t in ((p, u, w), (u, q, v), (w, v, r), (u, v, w))])


def of_size(name, wanted, cuts):
    """A model of data/thesis with about so many triangles, as a solid; none if it is not there."""
    import starcell as sc
    mesh = read(name)
    if mesh is None:
        return None
    for roughness in ROUGHNESS:
        rough, rng = mesh, np.random.default_rng(1)
        for _ in range(cuts):
            if 2 * len(rough[1]) < wanted:
                rough = cut_in_four(rough, roughness, rng)
        try:
            return sc.Polyhedron(*rough)
        except sc.InvalidSolidError as problem:
            reason = problem
    print("%s: left out: %s" % (name, reason))
    return None


def size(solid):
    return max(high - low for low, high in zip(*solid.bounding_box))


def row(name, thesis, make, run):
    """thesis: (triangles in, out, seconds); make() -> solid; run(solid) -> result."""
    solid = make()
    if solid is None:
        print("%s: no model" % name)
        return
    start = time.perf_counter()
    result = run(solid)
    seconds = time.perf_counter() - start
    c = result.certificate
    before = getattr(solid, "triangles", None)
    print("%s: %s -> %d triangles, %.1f s, %s, %d components of genus %s, bound %.3f of the error; thesis: %s -> %d, %.1f s" % (
        name, "-" if before is None else len(before), len(result.triangles), seconds, c.verdict, c.components, list(c.genus[:3]),
        c.error_bound / c.requested_error, thesis[0] or "-", thesis[1], thesis[2]), flush=True)


def moved(solid, shift):
    matrix = np.eye(4)
    matrix[:3, 3] = shift
    return solid.transformed(matrix)


def turbine_less_five(turbine):
    import starcell as sc
    low, high = (np.asarray(corner) for corner in turbine.bounding_box)
    rng = np.random.default_rng(2)
    for _ in range(5):
        turbine = turbine - sc.Sphere(tuple(low + rng.uniform(0.2, 0.8, 3) * (high - low)), 0.08 * (high - low).max())
    return turbine


def pierced_block():
    """A block less a hundred ellipsoids that pierce it, as figure 3.25's."""
    import starcell as sc
    rng = np.random.default_rng(3)
    block = sc.Box((0, 0, 0), (40, 40, 4))
    for i in range(10):
        for j in range(10):
            matrix = np.diag([rng.uniform(1, 1.5), rng.uniform(1, 1.5), rng.uniform(4, 6), 1.0])
            matrix[:3, 3] = (4 * i + 2, 4 * j + 2, 2)
            block = block - sc.Sphere((0, 0, 0), 1).transformed(matrix)
    return block


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--quick", action="store_true")
    options.add_argument("--cuts", type=int, default=3)
    options = options.parse_args()
    import starcell as sc

    sized = lambda name, wanted: lambda: of_size(name, wanted, options.cuts)
    if not options.quick:
        row("Hand, simplified", (654666, 58966, 36), sized("hand_closed_oded.obj", 654666), lambda s: sc.simplify(s, error=size(s) / 128))
        row("Turbine, simplified", (1765388, 511182, 110), sized("turbine_cgal.off", 1765388), lambda s: sc.simplify(s, error=size(s) / 128))
        row("Turbine less five", (1765388, 319074, 116), sized("turbine_cgal.off", 1765388), lambda s: sc.evaluate(turbine_less_five(s), error=size(s) / 128))
        row("Two dragons", (1714920, 118214, 95), sized("dragon_20k_manifold.obj", 870000), lambda s: sc.evaluate(s | moved(s, 0.2 * size(s) * np.array([1, 0.3, 0.5])), error=size(s) / 128))
    row("Block less 100 ellipsoids", (None, 57286, 16), pierced_block, lambda s: sc.evaluate(s, error=40 / 64))
    row("Brake hub, remeshed", (14208, 7056, 1.85), sized("brakehub_sub_coupling_cgal.off", 14208), lambda s: sc.remesh(s, error=size(s) / 32))
    row("CAD model, remeshed", (41152, 16524, 2.8), sized("cad41k_sub_nist_gear_medium.obj.gz", 41152), lambda s: sc.remesh(s, error=size(s) / 32))


if __name__ == "__main__":
    main()
