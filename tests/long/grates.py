"""Interlocked grates, as the thesis' hardest sum: one lies, the other stands, and in the sum every way in which bars of either pass
through holes of the other leaves a cavity. Components, Euler characteristic and volume against a count on the grid of all
coordinates (the sum of unions of boxes is the union of the boxes' sums), and again at five rotations of both.
Further: a small grate swept through the holes of a large one, whose handles have to stay. Needs numpy alone. Argument: a seed."""
import sys
import time

import numpy as np

import starcell as sc

HOLE, BAR = 3, 2  # in half units: holes of 1.5, bars of 1


def cells(holes):
    """The plate's boxes on the grid of its own coordinates: (lines, filled) of each axis across."""
    lines = [np.cumsum([0] + [BAR, HOLE] * n + [BAR]) for n in holes]
    odd = [np.arange(2 * n + 1) % 2 == 1 for n in holes]
    return lines, ~np.outer(*odd)


def mesh(holes):
    """4 triangles a filled cell, 2 a side: 440 for 3 by 5 holes, 1136 for 5 by 9."""
    (xs, ys), filled = cells(holes)
    corners, triangles = {}, []

    def quad(*points):
        a, b, c, d = (corners.setdefault(p, len(corners)) for p in points)
        triangles.extend([(a, b, c), (a, c, d)])

    n, m = filled.shape
    full = lambda i, j: 0 <= i < n and 0 <= j < m and filled[i, j]
    for i in range(n):
        for j in range(m):
            if not full(i, j):
                continue
            x, X, y, Y = xs[i], xs[i + 1], ys[j], ys[j + 1]
            quad((x, y, BAR), (X, y, BAR), (X, Y, BAR), (x, Y, BAR))
            quad((x, y, 0), (x, Y, 0), (X, Y, 0), (X, y, 0))
            for beside, ends in (((i, j - 1), ((x, y), (X, y))), ((i + 1, j), ((X, y), (X, Y))), ((i, j + 1), ((X, Y), (x, Y))), ((i - 1, j), ((x, Y), (x, y)))):
                if not full(*beside):
                    (a, b), (c, d) = ends
                    quad((a, b, 0), (c, d, 0), (c, d, BAR), (a, b, BAR))
    return 0.5 * np.array(list(corners), float), np.array(triangles)


def boxes(holes):
    (xs, ys), filled = cells(holes)
    return [((xs[i], ys[j], 0), (xs[i + 1], ys[j + 1], BAR)) for i, j in zip(*np.nonzero(filled))]


def standing(box):
    """About x: y goes to z, z to -y."""
    (x, y, z), (X, Y, Z) = box
    return (x, -Z, y), (X, -z, Y)


STAND = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], float)


def counted(first, second):
    """(components of the boundary, Euler characteristic of the boundary, volume) of the union of all sums of two boxes."""
    sums = [(np.add(a, c), np.add(b, d)) for a, b in first for c, d in second]
    lines = [np.unique([corner[k] for s in sums for corner in s]) for k in range(3)]
    # What touches only along faces of the grid is one solid; a layer of nothing goes all round.
    full = np.zeros([len(l) + 1 for l in lines], bool)
    for low, high in {(tuple(l), tuple(h)) for l, h in sums}:
        full[tuple(slice(1 + np.searchsorted(lines[k], low[k]), 1 + np.searchsorted(lines[k], high[k])) for k in range(3))] = True
    size = np.ones(1)
    for l in lines:
        size = np.multiply.outer(size, np.concatenate([[0], np.diff(l), [0]]))
    volume = float(size[0][full].sum()) / 8
    # Of the closed cubes: each vertex, edge, face and cube once.
    euler = 0
    for dims in np.ndindex(2, 2, 2):
        present = full
        for k, across in enumerate(dims):
            if across:
                present = np.logical_or(present, np.roll(present, 1, axis=k))
        euler += (-1) ** (3 - sum(dims)) * int(present.sum())
    return pieces(full) + pieces(~full) - 1, 2 * euler, volume


def pieces(full):
    """Components by faces."""
    label = np.where(full, np.arange(1, full.size + 1).reshape(full.shape), 0)
    while True:
        before = label.copy()
        for k in range(3):
            for way in (False, True):
                moved = np.flip(label, k) if way else label
                solid = np.flip(full, k) if way else full
                a, b = [slice(None)] * 3, [slice(None)] * 3
                a[k], b[k] = slice(1, None), slice(None, -1)
                target, source = moved[tuple(a)], moved[tuple(b)]
                both = solid[tuple(a)] & solid[tuple(b)]
                target[both] = np.maximum(target[both], source[both])
        if np.array_equal(before, label):
            return len(np.unique(label[full]))


def rotation(random):
    q, r = np.linalg.qr(random.normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q * np.linalg.det(q)


def volume(result):
    v, t = np.asarray(result.vertices), np.asarray(result.triangles)
    return float(np.einsum("ij,ij->", v[t[:, 0]], np.cross(v[t[:, 1]], v[t[:, 2]])) / 6)


def check(what, a, b, expected, error):
    start = time.perf_counter()
    r = sc.minkowski_sum(sc.Polyhedron(*a), sc.Polyhedron(*b), error=error)
    c = r.certificate
    got = (c.components, c.euler_characteristic)
    area = np.linalg.norm(np.cross(*(np.asarray(r.vertices)[np.asarray(r.triangles)[:, k]] - np.asarray(r.vertices)[np.asarray(r.triangles)[:, 0]] for k in (1, 2))), axis=1).sum() / 2
    near = expected[2] is None or abs(volume(r) - expected[2]) <= c.error_bound * area + 1e-6
    ok = c.verdict != "unresolved" and got == expected[:2] and near
    print("%-4s %s: %s, %d components, Euler characteristic %d (expected %d, %d), volume %.9g (%s), %d triangles, %.1f s" % (
        "ok" if ok else "FAIL", what, c.verdict, *got, *expected[:2], volume(r), expected[2], len(r.triangles), time.perf_counter() - start), flush=True)
    return ok


def main():
    random = np.random.default_rng(int(sys.argv[1]) if len(sys.argv) > 1 else 1)
    good = []
    lying, upright = (3, 5), (5, 9)
    a, b = mesh(lying), mesh(upright)
    b = b[0] @ STAND.T, b[1]
    expected = counted(boxes(lying), [standing(box) for box in boxes(upright)])
    print("%d and %d triangles" % (len(a[1]), len(b[1])))
    good.append(check("interlocked", a, b, expected, 0.2))
    for k in range(5):
        q = rotation(random)
        good.append(check("interlocked, rotation %d" % (k + 1), (a[0] @ q.T, a[1]), (b[0] @ q.T, b[1]), expected, 0.2))
    # No longer than a hole is wide in any rotation: all 15 handles stay.
    small = mesh(upright)
    small = small[0] * (1.4 / np.linalg.norm(np.ptp(small[0], axis=0))), small[1]
    for k in range(5):
        q, s = rotation(random), rotation(random)
        good.append(check("swept, rotations %d" % (k + 1), (a[0] @ q.T, a[1]), (small[0] @ s.T, small[1]), (1, -28, None), 0.1))
    print("%d passed, %d failed" % (sum(good), len(good) - sum(good)))
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
