"""Random trees of FreeCAD's six primitives, Fuse, Cut and Common: OpenCASCADE's result beside StarCell's Rescue, a judge between them.

Both get the same document objects, in general position, each in a process of its own with a time limit. The judge knows nothing
but the primitives' formulas: it samples every volume, and where the two differ it counts shells and handles of voxels.
Passes when StarCell is nowhere wrong and nowhere unresolved. OpenCASCADE's mistakes are counted, and do no harm. What the
voxels cannot resolve is undecided, and printed. Arguments: seed (1), number of trees (500), number of the first one (1)."""
import itertools
import math
import os
import random
import subprocess
import sys
import time
from collections import Counter, namedtuple

import numpy as np

from table import Table, apart

SECONDS = 60       # for either of the two, on one tree
DEPTH = 5
STRATA = 64        # cells a side in which volume is sampled; three times as many where that does not decide
VOXELS = (144, 216)  # on the longest side

# size: the properties of a primitive; kids: the operands; turn: axis, degrees; box: around the node before it is placed
Node = namedtuple("Node", "kind size kids box turn shift", defaults=(((0, 0, 1), 0), (0, 0, 0)))
# slack: how far the volume may be off; drawn: volume and slack of a tessellation
Answer = namedtuple("Answer", "flaw volume slack genus verdict seconds box drawn", defaults=("", 0.0, 0.0, [], "", 0.0, None, (0.0, 0.0)))


# Trees.

def rotation(axis, degrees):
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross, angle = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), math.radians(degrees)
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def any_turn(rng):
    return tuple(rng.gauss(0, 1) for _ in range(3)), rng.uniform(0, 360)


def any_shift(rng):
    return tuple(rng.uniform(-3, 3) for _ in range(3))


def outer_box(node):
    """Around the node where it is placed."""
    corners = np.array(list(itertools.product(*zip(*node.box)))) @ rotation(*node.turn).T + node.shift
    return corners.min(0), corners.max(0)


def primitive(rng):
    kind, r = rng.choice(("Box", "Cylinder", "Cone", "Sphere", "Torus", "Ellipsoid")), rng.uniform
    if kind == "Box":
        size = dict(Length=r(1, 6), Width=r(1, 6), Height=r(1, 6))
        lower, upper = (0, 0, 0), tuple(size.values())
    elif kind in ("Cylinder", "Cone"):
        size = dict(Radius=r(0.5, 3)) if kind == "Cylinder" else dict(Radius1=r(0.3, 3), Radius2=rng.choice((0, r(0.3, 3))))
        widest = max(size.values())
        size["Height"] = r(1, 6)
        lower, upper = (-widest, -widest, 0), (widest, widest, size["Height"])
    else:
        if kind == "Sphere":
            size = dict(Radius=r(1, 3))
            upper = (size["Radius"],) * 3
        elif kind == "Torus":
            size = dict(Radius1=r(1.5, 3), Radius2=r(0.3, 1.3))
            upper = sum(size.values()), sum(size.values()), size["Radius2"]
        else:
            size = dict(Radius1=r(1, 3), Radius2=r(1, 3), Radius3=r(1, 3))  # along z, x and y
            upper = size["Radius2"], size["Radius3"], size["Radius1"]
        lower = tuple(-u for u in upper)
    return Node(kind, size, (), (np.array(lower), np.array(upper)))


def tree(rng, depth):
    """A tree of this depth in which no step is trivial: a good part of one operand lies in the other, and a good part does not."""
    if not depth:
        return primitive(rng)
    while True:
        first, second = rng.sample((tree(rng, depth - 1), tree(rng, rng.randrange(depth))), 2)
        first = first._replace(turn=any_turn(rng), shift=any_shift(rng))
        kind, sampling = rng.choice(("Fuse", "Cut", "Common")), np.random.default_rng(rng.getrandbits(32))
        for _ in range(5):
            second = second._replace(turn=any_turn(rng), shift=(0, 0, 0))
            a, b = points_in(first, sampling), points_in(second, sampling)
            if min(len(a), len(b)) < 20:
                break
            shift = a[0] - b[0]  # they share a point
            second = second._replace(shift=tuple(shift.tolist()))
            share, other = inside(second, a).mean(), inside(first, b + shift).mean()
            if 0.05 < share < 0.9 and (kind == "Cut" or 0.05 < other < 0.9):
                (l, h), (m, k) = outer_box(first), outer_box(second)
                box = {"Cut": (l, h), "Fuse": (np.minimum(l, m), np.maximum(h, k)), "Common": (np.maximum(l, m), np.minimum(h, k))}
                return Node(kind, None, (first, second), box[kind])


def points_in(node, sampling):
    lower, upper = outer_box(node)
    points = lower + (upper - lower) * sampling.random((2000, 3))
    return points[inside(node, points)]


def numbered_tree(seed, number):
    rng = random.Random("%d %d" % (seed, number))
    return tree(rng, rng.randint(1, DEPTH))._replace(turn=any_turn(rng), shift=any_shift(rng))


def leaves(node):
    return sum(map(leaves, node.kids)) if node.kids else 1


def in_words(node):
    what = "%s(%s)" % (node.kind, ", ".join(map(in_words, node.kids) if node.kids else ("%.17g" % s for s in node.size.values())))
    numbers = *node.turn[0], node.turn[1], *node.shift
    return what + " @ (%s)" % ", ".join("%.17g" % x for x in numbers)


# The definition.

def inside(node, points):
    """Which of the points (n, 3) are in the solid."""
    x = (points - node.shift) @ rotation(*node.turn)
    if node.kids:
        result = inside(node.kids[0], x)
        asked = np.flatnonzero(~result if node.kind == "Fuse" else result)  # the others are settled
        second = inside(node.kids[1], x[asked])
        result[asked] = ~second if node.kind == "Cut" else second
        return result
    s = list(node.size.values())
    if node.kind == "Box":
        return ((x > 0) & (x < s)).all(1)
    if node.kind in ("Sphere", "Ellipsoid"):
        return ((x / (s[0] if len(s) == 1 else (s[1], s[2], s[0]))) ** 2).sum(1) < 1
    r, z = np.hypot(x[:, 0], x[:, 1]), x[:, 2]
    if node.kind == "Torus":
        return (r - s[0]) ** 2 + z ** 2 < s[1] ** 2
    bottom, top = (s[0], s[0]) if node.kind == "Cylinder" else s[:2]
    return (z > 0) & (z < s[-1]) & (r < bottom + (top - bottom) * z / s[-1])


# The judge.

def reach(node, claimed):
    """A box around the solid, as far as points find it, and around the boxes that are claimed."""
    lower, upper = outer_box(node)
    points = lower + (upper - lower) * np.random.default_rng(0).random((200000, 3))
    points = np.concatenate([points[inside(node, points)], *claimed])
    lower, upper = points.min(0), points.max(0)
    return lower - 0.02 * (upper - lower), upper + 0.02 * (upper - lower)


def sampled_volume(node, box, strata):
    """(volume, standard deviation): two points in each cell; how often they differ says how far the sum may be off."""
    lower, upper = box
    step, sampling = (upper - lower) / strata, np.random.default_rng(1)
    cells = np.stack(np.meshgrid(*[np.arange(strata)] * 2, indexing="ij"), -1).reshape(-1, 2)
    both, one = 0, 0
    for i in range(strata):
        corner = lower + step * np.column_stack((np.full(len(cells), i), cells))
        first, second = (inside(node, corner + step * sampling.random(corner.shape)) for _ in range(2))
        both += int((first & second).sum())
        one += int((first ^ second).sum())
    return step.prod() * (both + one / 2), step.prod() * math.sqrt(max(one, 1)) / 2


def is_volume(claimed, slack, node, box, sampled):
    """Whether the volume is right within `slack`; False only if five deviations of a finer sample say so too."""
    volume, deviation = sampled
    if abs(claimed - volume) > slack + 5 * deviation:
        volume, deviation = sampled_volume(node, box, 3 * STRATA)
    return abs(claimed - volume) <= slack + 5 * deviation


def voxel_topology(node, box):
    """(shells, handles) where two resolutions agree, else None.

    Voxels along a sharp edge are crumbs, at every resolution. So the solid is blurred over five voxels first, which rounds
    edges and loses what is thinner than two; and it must not matter whether voxels that touch in an edge or a corner are joined.
    What both resolutions lose is lost: the outcome counts only beside a claim that it confirms."""
    lower, upper = box
    outcomes = set()
    for voxels in VOXELS:
        step = max(upper - lower) / voxels
        x, y, z = (np.arange(l - 5.3 * step, h + 6 * step, step) for l, h in zip(lower, upper))
        plane = np.stack(np.meshgrid(y, z, indexing="ij"), -1).reshape(-1, 2)
        solid = np.array([inside(node, np.column_stack((np.full(len(plane), each), plane))) for each in x])
        solid = blurred(solid.reshape(len(x), len(y), len(z)))
        outcomes |= {shells_and_handles(solid), shells_and_handles(solid, by_corners=True)}
    return outcomes.pop() if len(outcomes) == 1 else None


def blurred(solid):
    density = solid.astype(np.float32)
    for axis in range(3):
        for way in (1, -1, 1, -1):  # binomial weights
            density = (density + np.roll(density, way, axis)) / 2
    return density > 0.4999


def shells_and_handles(solid, by_corners=False):
    """Of the boundary of voxels, which are joined by faces only, or by corners too; what lies outside is joined the other way.

    The boundary has components + cavities shells; its handles sum up to the first Betti number: shells - Euler characteristic."""
    shells = components(solid, by_corners) + components(~solid, not by_corners) - 1
    if not by_corners:
        return shells, shells - characteristic(solid)
    # The outside has the shells and the rim of the grid, a sphere, for its boundary, and half the boundary's characteristic.
    return shells, shells + 1 - characteristic(~solid)


def characteristic(solid):
    """Of the complex whose vertices are the voxels' centres, with every edge, square and cube whose vertices are all there."""
    total = 0
    for axes in itertools.chain.from_iterable(itertools.combinations(range(3), k) for k in range(4)):
        cells = solid
        for axis in axes:
            cells = np.take(cells, range(1, cells.shape[axis]), axis) & np.take(cells, range(cells.shape[axis] - 1), axis)
        total += (-1) ** len(axes) * int(cells.sum())
    return total


def components(solid, by_corners):
    """Runs along the last axis are numbered, and joined with those they touch."""
    padded = np.pad(solid, 1)
    starts = padded & ~np.roll(padded, 1, -1)
    runs = np.cumsum(starts, dtype=np.int32).reshape(padded.shape)
    pairs = []
    for di, dj in ((1, 0), (0, 1), (1, 1), (1, -1)) if by_corners else ((1, 0), (0, 1)):
        for dk in (-1, 0, 1) if by_corners else (0,):
            other = np.roll(padded, (di, dj, dk), (0, 1, 2))
            joined = padded & other
            pair = np.array((runs[joined], np.roll(runs, (di, dj, dk), (0, 1, 2))[joined]))
            pairs.append(pair[:, np.append(True, (pair[:, 1:] != pair[:, :-1]).any(0))])
    return len(np.unique(smallest_joined(int(starts.sum()) + 1, np.concatenate(pairs, 1)))) - 1  # run 0 is nothing


def smallest_joined(count, pairs):
    """For each of the numbers below `count` the smallest that it is joined with, by the pairs (2, n)."""
    root = np.arange(count)
    while pairs.size:
        low, high = np.sort(root[pairs], axis=0)
        order = np.argsort(-low)
        root[high[order]] = low[order]  # the last one written is the smallest
        while (root[root] != root).any():
            root = root[root]
        pairs = pairs[:, root[pairs[0]] != root[pairs[1]]]
    return root


# The two that are judged; these run in FreeCAD.

def build(document, node):
    import FreeCAD

    obj = document.addObject("Part::" + node.kind, node.kind)
    for name, value in (node.size or {}).items():
        setattr(obj, name, value)
    if node.kids:
        obj.Base, obj.Tool = (build(document, kid) for kid in node.kids)
    (axis, degrees), shift = node.turn, node.shift
    obj.Placement = FreeCAD.Placement(FreeCAD.Vector(*shift), FreeCAD.Rotation(FreeCAD.Vector(*axis), degrees))
    return obj


def quietly(work, node):
    """FreeCAD writes of every recompute."""
    import FreeCAD

    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    return work(FreeCAD.newDocument("Tree"), node)


def opencascade(document, node):
    from starcell_workbench import opencascade_result

    obj = build(document, node)
    start = time.monotonic()
    document.recompute()
    seconds = time.monotonic() - start
    measured = opencascade_result.measure(obj)
    if measured.flaw:
        return Answer(measured.flaw, measured.volume, seconds=seconds)
    if not measured.components:
        return Answer(seconds=seconds)
    # The workbench counts vertices, edges, and rims of faces, a formula with many cases; a tessellation, where FreeCAD's is
    # closed, has to give the same, and is right if it does not. Closed or not it has a volume, off by less than it differs from
    # a coarser one: FreeCAD's quadrature has low order, and misses the volume of a right shape by up to a hundredth.
    b = obj.Shape.BoundBox
    coarse, (fine, triangles) = (drawn(obj.Shape, b.DiagonalLength / parts) for parts in (300, 1000))
    genus = mesh_genus(triangles)
    remark = "workbench: genus %s; " % measured.genus if genus not in (None, measured.genus) else ""
    return Answer("", measured.volume, measured.rounding, measured.genus if genus is None else genus, remark, seconds,
                  ((b.XMin, b.YMin, b.ZMin), (b.XMax, b.YMax, b.ZMax)), (fine, abs(fine - coarse[0])))


def drawn(shape, deflection):
    """Volume and triangles of a tessellation."""
    points, triangles = (np.array(each) for each in shape.tessellate(deflection))
    return np.linalg.det(points[triangles] - points[0]).sum() / 6, triangles


def rescue(document, node):
    import starcell_workbench
    from starcell_workbench import mesh_transfer

    obj = build(document, node)
    for each in document.Objects:
        if not hasattr(each, "Tool"):
            each.recompute()
    for each in document.Objects:
        each.purgeTouched()  # OpenCASCADE's Booleans are left alone: some of them never end
    start = time.monotonic()
    made = starcell_workbench.make_rescue(obj)
    seconds = time.monotonic() - start
    if not made.isValid():
        return Answer(made.getStatusString(), verdict="failed", seconds=seconds)
    genus = mesh_genus(mesh_transfer.from_mesh(made.Mesh)[1])
    flaw = "" if genus == sorted(made.Genus, reverse=True) else "certificate: genus %s, mesh: %s" % (made.Genus, genus)
    b = made.Mesh.BoundBox
    return Answer(flaw, made.Volume.Value, made.ErrorBound.Value * made.Mesh.Area, genus, made.Verdict, seconds,
                  ((b.XMin, b.YMin, b.ZMin), (b.XMax, b.YMax, b.ZMax)))


def mesh_genus(triangles):
    """Of each component of a closed mesh, the most first; None if it is not closed or an edge has more than two sides."""
    if not len(triangles):
        return []
    triangles = np.unique(triangles, return_inverse=True)[1].reshape(-1, 3)
    edges = np.concatenate([triangles[:, [k, k - 2]] for k in range(3)])
    count = int(triangles.max()) + 1
    one_way, other_way = (np.sort(e[:, 0].astype(np.int64) * count + e[:, 1]) for e in (edges, edges[:, ::-1]))
    if (one_way[1:] == one_way[:-1]).any() or (one_way != other_way).any():
        return None
    label = smallest_joined(count, edges[edges[:, 0] < edges[:, 1]].T)
    vertices, sides = np.bincount(label, minlength=count), np.bincount(label[triangles[:, 0]], minlength=count)
    return sorted(((2 - v + f // 2) // 2 for v, f in zip(vertices, sides) if v), reverse=True)


# One tree.

def answered(work, node):
    kind, answer = apart(quietly, (work, node), SECONDS)
    return answer if kind == "value" else Answer("%s: %s" % (kind, answer), verdict="failed", seconds=SECONDS)


def compare(node):
    """(OpenCASCADE's Answer, StarCell's, finding, reason)."""
    occ, ours = answered(opencascade, node), answered(rescue, node)
    box = reach(node, [a.box for a in (occ, ours) if a.box and a.genus])
    sampled = sampled_volume(node, box, STRATA)
    if ours.verdict not in ("exact", "contact"):
        return occ, ours, "unresolved", "%s %s" % (ours.verdict, ours.flaw)
    if ours.flaw or not is_volume(ours.volume, ours.slack, node, box, sampled):
        return occ, ours, "StarCell wrong", ours.flaw or "volume %.6g is sampled" % sampled[0]

    said, found = occ.verdict, None
    our_topology, occ_topology = ((len(a.genus), sum(a.genus)) for a in (ours, occ))
    if occ.flaw or occ.genus != ours.genus:
        found = voxel_topology(node, box)
        said += "voxels: shells %d, handles %d" % found if found else "voxels do not decide"
        said += ", as StarCell" if found == our_topology else ", as OCC" if found == occ_topology else ""
    if occ.flaw:
        return occ, ours, "OCC " + _kind(occ), "%s; %s" % (occ.flaw, said)
    if not is_volume(occ.volume, occ.slack, node, box, sampled):
        if not is_volume(*occ.drawn, node, box, sampled):
            return occ, ours, "OCC wrong volume" if occ.genus else "OCC empty", "%.6g is sampled; %s" % (sampled[0], said)
        said += " quadrature is off, %.6g is sampled" % sampled[0]
    if occ.genus == ours.genus:
        return occ, ours, "agree", said
    if found == our_topology != occ_topology:
        return occ, ours, "OCC wrong topology", said
    return occ, ours, "StarCell wrong" if found == occ_topology != our_topology else "undecided", said


def _kind(occ):
    return next((word for word in ("null", "timeout", "crashed") if word in occ.flaw), "invalid")


def shown(answer):
    genus = " ".join(map(str, answer.genus)) if answer.genus else "-"
    return "%.6g" % answer.volume, "%d: %s" % (len(answer.genus or ()), genus), "%.2f" % answer.seconds


def main(seed=1, count=500, first=1):
    table, found = Table("tree", "OCC volume", "shells: genus", "seconds", "StarCell", "shells: genus", "seconds", "verdict", "finding"), Counter()
    for number in range(first, first + count):
        node = numbered_tree(seed, number)
        occ, ours, finding, reason = compare(node)
        found[finding] += 1
        table.row("%d, %d primitives" % (number, leaves(node)), *shown(occ), *shown(ours), ours.verdict, finding, reason.replace("\n", " ")[:200])
        if finding != "agree":
            print("    " + in_words(node), flush=True)
    wrong = {name[4:]: n for name, n in sorted(found.items()) if name.startswith("OCC ")}
    print("%d trees, %d agreements, OpenCASCADE wrong %d (%s), StarCell wrong %d, undecided %d, StarCell unresolved %d" % (
        count, found["agree"], sum(wrong.values()), ", ".join("%s %d" % item for item in wrong.items()) or "-",
        found["StarCell wrong"], found["undecided"], found["unresolved"]))
    bad = found["StarCell wrong"] + found["unresolved"]
    print("%d passed, %d failed" % (count - bad, bad))
    sys.exit(1 if bad else 0)


if "FreeCAD" in sys.modules:
    main(*map(int, sys.argv[1:]))
else:
    runner = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "run")
    sys.exit(subprocess.call([runner, "freecadcmd", os.path.abspath(__file__), *sys.argv[1:]]))
