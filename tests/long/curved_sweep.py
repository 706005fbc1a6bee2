"""Curved solids moved through every topological change of simple pairs: at random positions, and 1e-6 of the size on either side of
each change, the result has to have the components and genus that the position says. Argument: number of random positions a pair."""
import math
import random
import sys

import numpy
import starcell as sc

from table import Table

POSITIONS = int(sys.argv[1]) if len(sys.argv) > 1 else 40
rng = random.Random(7)


def rotation():
    q = numpy.array([rng.gauss(0, 1) for _ in range(4)])
    w, x, y, z = q / numpy.linalg.norm(q)
    m = numpy.eye(4)
    m[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    m[:3, 3] = [rng.uniform(-2, 2) for _ in range(3)]
    return m


def ball(x, r):
    return sc.Sphere((x, 0, 0), r)


def bore(x):
    return sc.Cylinder((x, 0, -3), (0, 0, 1), 0.4, 6)


def ring():
    return sc.Torus((0, 0, 0), (0, 0, 1), 2, 0.6)


# Each: name, changes of t in order, the genera between them (one entry more than changes), and the expression at t.
# A unit ball and one of radius 0.6, centres t apart: nested, crossing, apart.
# A bore of radius 0.4, its axis t from the centre of a unit ball: through it, a notch in its side, beside it.
# A ring of radii 2 and 0.6 and the half-space x < t: nothing, a bent rod, the ring minus a bite of its far side (still one rod, but
# from t = 1.4 on the hole is whole), all of it; the half-space z < t: nothing, half a ring, all of it.
# A cone of radius 1 and height 2 without a ball of radius 0.3 at height t on its axis: a dent in its base, a cavity, and from where
# the ball touches the side, (2 - t) / sqrt 5 = 0.3, the tip is cut off.
TIP = 2 - 0.3 * math.sqrt(5)
PAIRS = [
    ("balls joined", [0.4, 1.6], [[0], [0], [0, 0]], lambda t: ball(0, 1) | ball(t, 0.6), (0, 2)),
    ("ball without ball", [0.4, 1.6], [[0, 0], [0], [0]], lambda t: ball(0, 1) - ball(t, 0.6), (0, 2)),
    ("balls in common", [0.4, 1.6], [[0], [0], []], lambda t: ball(0, 1) & ball(t, 0.6), (0, 2)),
    ("bored ball", [0.6, 1.4], [[1], [0], [0]], lambda t: ball(0, 1) - bore(t), (0, 1.7)),
    ("ring cut across", [-2.6, -1.4, 1.4, 2.6], [[], [0], [0], [1], [1]], lambda t: ring() & sc.HalfSpace((t, 0, 0), (1, 0, 0)), (-3, 3)),
    ("ring cut flat", [-0.6, 0.6], [[], [1], [1]], lambda t: ring() & sc.HalfSpace((0, 0, t), (0, 0, 1)), (-0.8, 0.8)),
    ("cone without ball", [0.3, TIP], [[0], [0, 0], [0, 0]], lambda t: sc.Cone((0, 0, 0), (0, 0, 1), 1, 0, 2) - sc.Sphere((0, 0, t), 0.3), (0, 1.6)),
]


def wanted(changes, genera, t):
    return genera[sum(t > change for change in changes)]


def positions(changes, span):
    low, high = span
    size = high - low
    yield from (rng.uniform(low, high) for _ in range(POSITIONS))
    for change in changes:
        for side in (-1, 1):
            yield change + side * 1e-6 * size


table = Table("position", "verdict", "genus", "expected", "seconds")
for name, changes, genera, expression, span in PAIRS:
    for t in positions(changes, span):
        expected = wanted(changes, genera, t)
        r = sc.evaluate(expression(t).transformed(rotation()), error=2.0 / 64, contact=1e-9)
        c = r.certificate
        ok = sorted(c.genus) == expected and c.verdict == "exact"
        table.judge("%s at %.8f" % (name, t), ok, c.verdict, list(c.genus), expected, "%.2f" % c.statistics["seconds"])
table.end()
