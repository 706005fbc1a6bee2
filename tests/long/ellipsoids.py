"""A comb of three plates minus 100 ellipsoids, genus 208 by construction (as many as T§3.12.1's): 92 pierce the upper two plates, 8 all
three. Right genus and verdict `exact` at every error; the thesis needed 57,286 triangles and 16 s at L/64."""
import math
import random

import starcell as sc

from table import Table

ROWS, LENGTH = 10, 21.0
DIVISORS = (16, 32, 64, 128, 256, 512)


PROFILE = [(-1, 0), (20, 0), (20, 1), (0, 1), (0, 2), (20, 2), (20, 3), (0, 3), (0, 4), (20, 4), (20, 5), (-1, 5)]
PROFILE_TRIANGLES = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7), (8, 9, 10), (8, 10, 11), (0, 3, 4), (0, 4, 7), (0, 7, 8), (0, 8, 11)]


def comb():
    """Plates of thickness 1 at heights 0, 2 and 4, joined along one side: a profile in the xz-plane, extruded along y."""
    n = len(PROFILE)
    vertices = [(x, y, z) for y in (0, 20) for x, z in PROFILE]
    triangles = PROFILE_TRIANGLES + [(n + a, n + c, n + b) for a, b, c in PROFILE_TRIANGLES]
    for a in range(n):
        b = (a + 1) % n
        triangles += [(a, n + a, n + b), (a, n + b, b)]
    return sc.Polyhedron(vertices, triangles)


def holes(rng):
    places = [(i, j) for i in range(ROWS) for j in range(ROWS)]
    through_all = set(rng.sample(places, 8))
    for i, j in places:
        everywhere = (i, j) in through_all
        turn = rng.uniform(0, math.pi)
        c, s = math.cos(turn), math.sin(turn)
        centre = (2 * i + 1.1 + rng.uniform(-0.1, 0.1), 2 * j + 1 + rng.uniform(-0.1, 0.1), 2.5 if everywhere else 3.5)
        axes = (rng.uniform(0.4, 0.6), rng.uniform(0.5, 0.8), rng.uniform(3.2, 4.0) if everywhere else rng.uniform(1.9, 2.2))
        yield sc.Ellipsoid(centre, axes, [[c, -s, 0], [s, c, 0], [0, 0, 1]])


table = Table("error", "verdict", "genus", "triangles", "leaves", "seconds")
for seed in (1, 2):
    solid = comb() - sc.union(list(holes(random.Random(seed))))
    for divisor in DIVISORS:
        c = sc.evaluate(solid, error=LENGTH / divisor).certificate
        ok = c.verdict == "exact" and list(c.genus) == [208] and c.error_bound <= LENGTH / divisor
        table.judge("L/%d, seed %d" % (divisor, seed), ok, c.verdict, list(c.genus), "%d" % c.statistics["triangles"],
                    "%d" % c.statistics["leaves"], "%.1f" % c.statistics["seconds"])
table.end()
