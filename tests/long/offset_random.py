"""Offsets of random solids against the definition, computed here: distance by brute force over triangles, its sign by winding numbers.

    offset_random.py [SEED [CASES]]

Each solid is a union or difference of turned boxes. Of its offset: points of the mesh are at the distance within the bound, points off
the surface on the right side, a moved and turned copy has the same topology. offset(offset(A, r), s) with r, s > 0 is offset(A, r + s)
within both bounds; an opening lies in A, and A in its closing, within the bounds.
"""
import math
import random
import sys

import numpy as np

import starcell as sc

SEED, CASES = (int(sys.argv[1]) if len(sys.argv) > 1 else 1), (int(sys.argv[2]) if len(sys.argv) > 2 else 30)
rng, numbers = random.Random(SEED), np.random.default_rng(SEED)


class Measured:
    """A closed mesh: signed distances of points, negative inside."""

    def __init__(self, vertices, triangles):
        corners = np.asarray(vertices)[np.asarray(triangles)]
        self.a, self.b, self.c = corners[:, 0], corners[:, 1], corners[:, 2]

    def distance(self, points):
        best = np.full(len(points), np.inf)
        for a, b, c in zip(self.a, self.b, self.c):
            normal = np.cross(b - a, c - a)
            over = np.ones(len(points), bool)
            for p, q in ((a, b), (b, c), (c, a)):
                along = q - p
                over &= (points - p) @ np.cross(normal, along) >= 0
                t = np.clip((points - p) @ along / (along @ along), 0, 1)
                best = np.minimum(best, np.linalg.norm(points - p - t[:, None] * along, axis=1))
            best = np.where(over, np.minimum(best, np.abs((points - a) @ normal) / np.linalg.norm(normal)), best)
        return best

    def inside(self, points):
        """The solid angle of all triangles (van Oosterom & Strackee 1983)."""
        angle = np.zeros(len(points))
        for corner in zip(self.a, self.b, self.c):
            x, y, z = (p - points for p in corner)
            lx, ly, lz = (np.linalg.norm(p, axis=1) for p in (x, y, z))
            angle += np.arctan2((x * np.cross(y, z)).sum(1), lx * ly * lz + (x * y).sum(1) * lz + (y * z).sum(1) * lx + (z * x).sum(1) * ly)
        return angle > math.pi

    def signed(self, points):
        return self.distance(points) * np.where(self.inside(points), -1, 1)

    def sample(self, count):
        chosen, weights = numbers.integers(0, len(self.a), count), numbers.dirichlet((1, 1, 1), count)
        return self.a[chosen] * weights[:, :1] + self.b[chosen] * weights[:, 1:2] + self.c[chosen] * weights[:, 2:]


def motion():
    q = numbers.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    matrix = np.eye(4)
    matrix[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    matrix[:3, 3] = numbers.uniform(-0.6, 0.6, 3)
    return matrix


def random_solid():
    def box():
        half = np.array([rng.uniform(0.15, 0.8) for _ in range(3)])
        return sc.Box(-half, half).transformed(motion())

    while True:
        e = box()
        for _ in range(rng.randint(1, 2)):
            e = e | box() if rng.random() < 0.5 else e - box()
        result = sc.evaluate(e, error=0.02)
        if result.certificate.verdict == "exact" and len(result.triangles):
            return result.as_solid()


def topology(result):
    return result.certificate.components, sorted(result.certificate.genus)


def against_definition(solid, measured, r, error):
    result = sc.offset(solid, r, error=error)
    certificate = result.certificate
    if certificate.verdict == "unresolved":
        return "unresolved", []
    wrong, bound = [], certificate.error_bound * 1.001 + 1e-6   # files and views hold float32
    low, high = np.asarray(solid.vertices).min(0) - abs(r) - 0.2, np.asarray(solid.vertices).max(0) + abs(r) + 0.2
    places = numbers.uniform(low, high, size=(2000, 3))
    heights = measured.signed(places) - r
    if len(result.triangles):
        mesh = Measured(result.vertices, result.triangles)
        off = np.abs(measured.signed(mesh.sample(1000)) - r).max()
        if off > bound:
            wrong.append("mesh off by {:.4g}, bound {:.4g}".format(off, bound))
        clear = np.nonzero(np.abs(heights) > bound)[0][:200]
        sides = (mesh.inside(places[clear]) != (heights[clear] < 0)).sum()
        if sides:
            wrong.append("{} points on the wrong side".format(sides))
    elif (heights < -bound).any():
        wrong.append("empty, though points are inside")
    turned = sc.offset(solid.transformed(motion()), r, error=0.6 * error)
    if turned.certificate.verdict != "unresolved" and topology(turned) != topology(result):
        wrong.append("topology {} and, turned, {}".format(topology(result), topology(turned)))
    return certificate.verdict, wrong


def algebra(solid, measured, error):
    wrong = []
    first = sc.offset(solid, 0.1, error=error)
    second = sc.offset(first.as_solid(), 0.15, error=error)
    bounds = first.certificate.error_bound + second.certificate.error_bound
    off = np.abs(measured.signed(Measured(second.vertices, second.triangles).sample(300)) - 0.25).max()
    if off > bounds * 1.001 + 1e-6:
        wrong.append("twice: off by {:.4g}, bounds {:.4g}".format(off, bounds))
    opened, closed = sc.opening(solid, 0.1, error=error), sc.closing(solid, 0.1, error=error)
    for name, result, sign in (("opening", opened, 1), ("closing", closed, -1)):
        if not len(result.triangles):
            continue
        given = sum(deflection for _, deflection in result.certificate.tessellated)
        out = (sign * measured.signed(Measured(result.vertices, result.triangles).sample(300))).max()
        if out > result.certificate.error_bound + given + 1e-6:
            wrong.append("{}: {:.4g} on the wrong side of A, bound {:.4g}".format(name, out, result.certificate.error_bound))
    return wrong


failed = 0
for case in range(CASES):
    solid = random_solid()
    measured = Measured(solid.vertices, solid.triangles)
    r, error = rng.choice((-0.3, -0.1, -0.03, 0.03, 0.1, 0.3, 0.8)), rng.choice((0.05, 0.1))
    verdict, wrong = against_definition(solid, measured, r, error)
    if case % 5 == 0:
        wrong += algebra(solid, measured, 0.1)
    failed += bool(wrong) or verdict == "unresolved"
    print("{} {} by {} error {}: {} {}".format(SEED, case, r, error, verdict, "; ".join(wrong)), flush=True)
print("{} cases, {} failed".format(CASES, failed))
sys.exit(1 if failed else 0)
