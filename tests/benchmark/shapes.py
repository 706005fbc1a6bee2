"""Solids for benchmarks, as (points, facets): gears, tori, tubes, and what has the sizes of the thesis' table 4.1."""
import math

import numpy as np


def prism(outline, low, high):
    """A star-shaped outline about the origin, extruded."""
    n = len(outline)
    points = [(0, 0, low), (0, 0, high)] + [(x, y, z) for z in (low, high) for x, y in outline]
    facets = []
    for i in range(n):
        j = (i + 1) % n
        facets += [(0, 2 + j, 2 + i), (1, 2 + n + i, 2 + n + j), (2 + i, 2 + j, 2 + n + j), (2 + i, 2 + n + j, 2 + n + i)]
    return np.array(points, float), np.array(facets)


def gear(teeth, inner, outer, height):
    """4 corners a tooth, 16 triangles."""
    turns = [(k + 0.15 * ((k % 4 == 1) - (k % 4 == 2))) / (4 * teeth) for k in range(4 * teeth)]
    radii = [outer if k % 4 in (1, 2) else inner for k in range(4 * teeth)]
    return prism([(r * math.cos(2 * math.pi * t), r * math.sin(2 * math.pi * t)) for r, t in zip(radii, turns)], -height / 2, height / 2)


def torus(major, minor, n, m):
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    a, b = 2 * np.pi * i / n, 2 * np.pi * j / m
    points = np.stack([(major + minor * np.cos(b)) * np.cos(a), (major + minor * np.cos(b)) * np.sin(a), minor * np.sin(b)], axis=-1)
    at = lambda i, j: (i % n) * m + j % m
    quads = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    return points.reshape(-1, 3), np.concatenate([np.stack([quads[k] for k in t], -1).reshape(-1, 3) for t in ((0, 1, 2), (0, 2, 3))])


def tube(path, radii, sides):
    """Rings of `sides` corners along a path, ends closed: 2 sides (rings - 1) + 2 (sides - 2) triangles."""
    path = np.asarray(path, float)
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    across = np.cross(along, [0.05, 0.1, 1.0])
    across /= np.linalg.norm(across, axis=1)[:, None]
    up = np.cross(across, along)
    turns = 2 * np.pi * np.arange(sides) / sides
    points = (path[:, None] + np.asarray(radii)[:, None, None] * (np.cos(turns)[:, None] * across[:, None] + np.sin(turns)[:, None] * up[:, None])).reshape(-1, 3)
    facets = []
    for i in range(len(path) - 1):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            facets += [(a, a + sides, b), (b, a + sides, b + sides)]
    last = (len(path) - 1) * sides
    for j in range(1, sides - 1):
        facets += [(0, j, j + 1), (last, last + j + 1, last + j)]
    if np.einsum("ij,ij->", points[[f[0] for f in facets]], np.cross(points[[f[1] for f in facets]], points[[f[2] for f in facets]])) < 0:
        facets = [f[::-1] for f in facets]
    return points, np.array(facets)


def outline(count, radius):
    """A star-shaped outline: radius(turn) for turns from 0 to 1."""
    turns = np.arange(count) / count
    return [(radius(t) * math.cos(2 * math.pi * t), radius(t) * math.sin(2 * math.pi * t)) for t in turns]


def anvil():
    """144 triangles: a body with a horn and a waist."""
    return prism(outline(36, lambda t: 1 + 0.9 * math.exp(-40 * t * t) - 0.45 * math.cos(12 * math.pi * t) ** 4), -0.4, 0.4)


def spoon():
    """336 triangles: a bent handle that ends in a bowl."""
    s = np.linspace(0, 1, 34)
    return tube(np.stack([6 * s, 0.5 * np.sin(3 * s), 0.8 * s * s], axis=-1), 0.12 + 0.5 * np.exp(-40 * (s - 0.85) ** 2), 5)


def wrench():
    """772 triangles: a handle with jaws at both ends."""
    return prism(outline(193, lambda t: 0.5 + 2.5 * math.cos(2 * math.pi * t) ** 8 * (1 - 0.5 * math.exp(-6000 * min(t, 1 - t) ** 2))), -0.3, 0.3)


def spiral():
    """500 triangles: three turns of a helix."""
    s = np.linspace(0, 1, 42)
    return tube(np.stack([np.cos(6 * np.pi * s), np.sin(6 * np.pi * s), 3 * s], axis=-1), np.full(42, 0.2), 6)


def knife():
    """516 triangles: a long blade with a serrated edge."""
    return prism(outline(129, lambda t: 0.3 + 3 * math.cos(2 * math.pi * t) ** 10 + 0.03 * (round(129 * t) % 2)), -0.1, 0.1)


def scissors():
    """636 triangles: two crossed blades in one outline."""
    return prism(outline(159, lambda t: 0.3 + 2 * math.cos(2 * math.pi * t + 0.35) ** 30 + 2 * math.cos(2 * math.pi * t - 0.35) ** 30), -0.15, 0.15)
