"""Sixty damaged copies of good meshes, repaired: holes, turned triangles, doubled parts, jitter that makes a mesh cross itself, two solids in one file.

    repair_damaged.py [SEED [CASES]]

Each is a closed, embedded mesh with the topology its certificate says, or a refusal with a reason. Random points off the surface are inside exactly
if the damaged triangles wind about them (solid angles, van Oosterom & Strackee 1983), holes apart; doubling changes nothing, and
two solids have components and genus of their union by the Boolean. Meshes are those of data/meshes where they are there, or bumpy shapes.
"""
import math
import os
import random
import sys
import tempfile

import numpy as np

import starcell as sc
from table import DATA, Table, unpacked

SEED, CASES = (int(sys.argv[1]) if len(sys.argv) > 1 else 1), (int(sys.argv[2]) if len(sys.argv) > 2 else 60)
MOST_TRIANGLES, POINTS = 15000, 300
rng, numbers = random.Random(SEED), np.random.default_rng(SEED)


def bumpy(n, m, bumps):
    """A torus with bumps, 2 n m triangles."""
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    a, b = 2 * np.pi * i / n, 2 * np.pi * j / m
    minor = 0.4 + 0.05 * np.sin(bumps * a) * np.cos((bumps - 1) * b)
    points = np.stack([(1 + minor * np.cos(b)) * np.cos(a), (1 + minor * np.cos(b)) * np.sin(a), minor * np.sin(b)], -1).reshape(-1, 3)
    at = lambda i, j: (i % n) * m + j % m
    quads = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    return points, np.concatenate([np.stack([quads[k] for k in t], -1).reshape(-1, 3) for t in ((0, 1, 2), (0, 2, 3))])


def models():
    found = [("bumpy torus %d" % k, bumpy(20 + 10 * k, 12 + 6 * k, k + 2)) for k in range(4)]
    folder = os.path.join(DATA, "meshes")
    with tempfile.TemporaryDirectory() as scratch:
        for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else ():
            try:
                solid = sc.read_mesh(unpacked(os.path.join(folder, name), scratch))
            except sc.Error:
                continue
            if len(solid.triangles) <= MOST_TRIANGLES:
                found.append((name, (np.array(solid.vertices), np.array(solid.triangles))))
    return found


def length(mesh):
    return np.ptp(mesh[0], axis=0).max()


def turned(mesh, shift):
    w, x, y, z = (lambda q: q / np.linalg.norm(q))(numbers.normal(size=4))
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return mesh[0] @ turn.T + shift, mesh[1]


def patch(triangles, count):
    """Some triangles about a random one, as numbers."""
    chosen, about = {rng.randrange(len(triangles))}, set()
    while len(chosen) < count:
        about |= {v for t in chosen for v in triangles[t]}
        beside = [t for t, corners in enumerate(triangles) if t not in chosen and any(v in about for v in corners)]
        if not beside:
            break
        chosen |= set(rng.sample(beside, min(len(beside), count - len(chosen))))
    return sorted(chosen)


def windings(mesh, points):
    sums = np.zeros(len(points))
    for part in np.array_split(mesh[1], max(1, len(mesh[1]) // 500)):
        x, y, z = (mesh[0][part[:, k]][None] - points[:, None] for k in range(3))
        lx, ly, lz = (np.linalg.norm(p, axis=-1) for p in (x, y, z))
        volume = (x * np.cross(y, z)).sum(-1)
        sums += np.arctan2(volume, lx * ly * lz + (x * y).sum(-1) * lz + (y * z).sum(-1) * lx + (z * x).sum(-1) * ly).sum(1)
    return sums / (2 * math.pi)


def counted(result):
    """(components, sorted genus), by the edges."""
    triangles = np.asarray(result.triangles)
    parent = list(range(len(result.vertices)))

    def root(v):
        while parent[v] != v:
            parent[v] = v = parent[parent[v]]
        return v

    for a, b, c in triangles:
        parent[root(a)] = root(b)
        parent[root(b)] = root(c)
    faces, used = {}, {}
    for t in triangles:
        faces[root(t[0])] = faces.get(root(t[0]), 0) + 1
        used.setdefault(root(t[0]), set()).update(t)
    return len(faces), sorted((2 - (len(used[r]) - faces[r] // 2)) // 2 for r in faces)


def distance(point, mesh):
    """To the nearest triangle."""
    a, b, c = (mesh[0][mesh[1][:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    over, best = np.linalg.norm(normal, axis=1) > 0, np.inf
    for p, q in ((a, b), (b, c), (c, a)):
        along = q - p
        over &= ((point - p) * np.cross(normal, along)).sum(1) >= 0
        t = np.clip(((point - p) * along).sum(1) / np.maximum((along * along).sum(1), 1e-300), 0, 1)
        best = min(best, np.linalg.norm(point - p - t[:, None] * along, axis=1).min())
    heights = np.abs(((point - a) * normal).sum(1))[over] / np.linalg.norm(normal[over], axis=1)
    return min([best, *heights])


def agree(result, mesh, points):
    """Is every point that is inside or outside of the damaged mesh so of the result, if it is farther off than the result's bound?"""
    wound = windings(mesh, points)
    differ = (windings((np.asarray(result.vertices), np.asarray(result.triangles)), points) > 0.5) != (wound > 0.5)
    return all(distance(point, mesh) <= result.certificate.error_bound for point in points[differ])


def with_holes(mesh):
    keep = np.ones(len(mesh[1]), bool)
    for _ in range(rng.randint(1, 3)):
        keep[patch(mesh[1], rng.randint(1, 4))] = False
    return mesh[0], mesh[1][keep]


def with_turned(mesh):
    triangles = mesh[1].copy()
    for t in rng.sample(range(len(triangles)), min(len(triangles) // 5, rng.randint(1, 30))):
        triangles[t] = triangles[t][::-1]
    return mesh[0], triangles


def with_doubles(mesh):
    """Closed parts doubled as a whole: triangles that wind twice."""
    return np.concatenate([mesh[0], mesh[0]]), np.concatenate([mesh[1], mesh[1] + len(mesh[0])])


def with_jitter(mesh):
    edges = np.linalg.norm(mesh[0][mesh[1][:, 0]] - mesh[0][mesh[1][:, 1]], axis=1)
    return mesh[0] + 0.3 * np.median(edges) * numbers.uniform(-1, 1, mesh[0].shape), mesh[1]


table = Table("damage, mesh", "verdict", "components", "triangles", "found")
pool = models()
for case in range(CASES):
    name, mesh = rng.choice(pool)
    error = length(mesh) / 50
    damage = ("holes", "turned", "doubled", "jitter", "two in one file")[case % 5]
    union = None
    if damage == "two in one file":
        other_name, other = rng.choice(pool)
        name += " + " + other_name
        other = turned((other[0] * (0.8 * length(mesh) / length(other)), other[1]), 0)
        other = other[0] - other[0].mean(axis=0) + mesh[0].mean(axis=0) + numbers.uniform(-0.3, 0.3, 3) * length(mesh), other[1]
        union = sc.evaluate(sc.Polyhedron(*mesh) | sc.Polyhedron(*other), error=length(mesh) / 200)
        hurt = np.concatenate([mesh[0], other[0]]), np.concatenate([mesh[1], other[1] + len(mesh[0])])
    else:
        hurt = {"holes": with_holes, "turned": with_turned, "doubled": with_doubles, "jitter": with_jitter}[damage](mesh)
    title = "%s: %s" % (damage, name[:36])
    try:
        result = sc.repair(*hurt, error=error, budget=sc.Budget(max_seconds=120))
    except sc.InvalidSolidError as refusal:
        table.judge(title, damage in ("holes", "jitter") and len(str(refusal)) > 20, "refused", "", "", str(refusal)[:60])
        continue
    c = result.certificate
    kinds = {}
    for what, _ in result.findings:
        kinds[what] = kinds.get(what, 0) + 1
    try:
        sc.Polyhedron(np.asarray(result.vertices), np.asarray(result.triangles))
        # What jitter leaves may be too thin for float32; it is a sound mesh all the same.
        ok = (c.verdict != "unresolved" or damage == "jitter") and counted(result) == (c.components, sorted(c.genus))
    except sc.InvalidSolidError:
        ok = False
    low, high = mesh[0].min(axis=0), mesh[0].max(axis=0)
    points = numbers.uniform(low - 0.1 * (high - low), high + 0.1 * (high - low), (POINTS, 3))
    whole = mesh if damage in ("holes", "turned", "doubled") else hurt
    same = damage == "holes" or agree(result, whole, points)
    ok = ok and same
    if damage in ("turned", "doubled"):
        original = sc.evaluate(sc.Polyhedron(*mesh), error=error / 4).certificate
        ok = ok and (c.components, sorted(c.genus)) == (original.components, sorted(original.genus))
    if union is not None and union.certificate.verdict == "exact":
        ok = ok and (c.components, sorted(c.genus)) == (union.certificate.components, sorted(union.certificate.genus))
    table.judge(title, ok, c.verdict, c.components, len(result.triangles), str(kinds)[:60] + ("" if same else " POINTS DIFFER"))
table.end()
