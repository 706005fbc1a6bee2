"""The demo's mechanical parts, modelled with OpenCASCADE through FreeCAD's Part. Millimetres; every part stands where it
is mounted: the shaft's axis is z, the gear's lower face z = 0.

Each function returns a solid that OpenCASCADE itself calls valid. The parts fit as in a real drawing: flat faces touch
(gear on shoulder, key in keyway, gear on flange), round ones have clearance.
"""
import math

import Part
from FreeCAD import Rotation, Vector

Z = Vector(0, 0, 1)
GEAR_WIDTH = 16.0


def _cylinder(radius, start, end, x=0.0, y=0.0):
    return Part.makeCylinder(radius, end - start, Vector(x, y, start), Z)


def _holes(radius, start, end, circle, count):
    angles = [2 * math.pi * k / count for k in range(count)]
    return [_cylinder(radius, start, end, circle * math.cos(a), circle * math.sin(a)) for a in angles]


def _prism(points, start, height):
    """A polygon of (x, y) at z = start, extruded upwards."""
    corners = [Vector(x, y, start) for x, y in points]
    return Part.Face(Part.makePolygon(corners + corners[:1])).extrude(Z * height)


def _revolved(points):
    """A closed polygon of (radius, z), turned about the z axis."""
    corners = [Vector(r, 0, z) for r, z in points]
    return Part.Face(Part.makePolygon(corners + corners[:1])).revolve(Vector(), Z, 360)


def _edges(shape, wanted):
    return [edge for edge in shape.Edges if wanted(edge.BoundBox)]


def pillow_block():
    """Foot with two counterbored bolt holes, web and round housing; still without its bore."""
    foot = Part.makeBox(140, 14, 44, Vector(-70, -60, -60))
    foot = foot.makeFillet(10, _edges(foot, lambda b: b.XLength < 1e-6 and b.ZLength < 1e-6))
    web = _prism([(-48, -46.5), (48, -46.5), (34, 0), (-34, 0)], -53, 30)
    housing = _cylinder(36, -53, -23)
    block = foot.fuse([web, housing]).removeSplitter()
    rims = _edges(block, lambda b: b.ZLength < 1e-6 and b.YMax > 30)
    block = block.makeChamfer(1.5, rims)
    drills = [Part.makeCylinder(3, 20, Vector(0, 20, -36), Vector(0, 1, 0))]  # for grease, from the top into the seat
    for x in (-57, 57):
        drills.append(Part.makeCylinder(5.5, 30, Vector(x, -70, -38), Vector(0, 1, 0)))
        drills.append(Part.makeCylinder(8, 30, Vector(x, -51, -38), Vector(0, 1, 0)))
    return block.cut(drills)


def bearing_seat():
    """What the lathe takes out of the block: clearance for the shaft, the seat, a ring's groove, a chamfer at the mouth."""
    return _revolved([(0, -70), (15.6, -70), (15.6, -46), (26, -46), (26, -28), (27.3, -28), (27.3, -26.3), (26, -26.3),
                      (26, -24.2), (28.2, -22), (28.2, -10), (0, -10)])


def keyed_shaft():
    """Two journals, a shoulder under the gear, and a square-ended key as wide as the gear's keyway."""
    shaft = _revolved([(0, -62), (14, -62), (15, -61), (15, -25), (22, -25), (22, 0), (16.85, 0), (16.85, 59), (15.85, 60), (0, 60)])
    key = Part.makeBox(20, 10, GEAR_WIDTH + 6, Vector(0, -5, 0))
    return shaft.fuse(key).removeSplitter()


def _involute(base, radius, turn):
    """The point of the involute of the circle `base` at a radius, its start turned by an angle."""
    t = math.sqrt(max(0.0, (radius / base) ** 2 - 1))
    angle = turn + t - math.atan(t)
    return Vector(radius * math.cos(angle), radius * math.sin(angle), 0)


def _gear_outline(teeth, module, pressure=math.radians(20)):
    """Involute flanks as splines, between arcs on the root circle and on the tip circle."""
    pitch = module * teeth / 2
    base, root, tip = pitch * math.cos(pressure), pitch - 1.25 * module, pitch + module
    start = max(base, root)
    # Half a tooth measures pi/2/teeth at the pitch circle; the involute has turned by inv(pressure) there.
    half = math.pi / 2 / teeth + math.tan(pressure) - pressure
    flank = [_involute(base, start + (tip - start) * (k / 8) ** 1.5, -half) for k in range(9)]
    if root < base:
        flank.insert(0, flank[0] * (root / base))
    edges = []
    for k in range(teeth):
        turn = Rotation(Z, math.degrees(2 * math.pi * k / teeth))
        right = [turn.multVec(p) for p in flank]
        left = [turn.multVec(Vector(p.x, -p.y, 0)) for p in flank]
        following = Rotation(Z, math.degrees(2 * math.pi * (k + 1) / teeth)).multVec(flank[0])
        gap = turn.multVec(Rotation(Z, math.degrees(math.pi / teeth)).multVec(Vector(root, 0, 0)))
        for side in (right, left):
            radial = len(side) - 9
            if radial:
                edges.append(Part.makeLine(side[0], side[1]))
            spline = Part.BSplineCurve()
            spline.interpolate(side[radial:])
            edges.append(spline.toShape())
        edges.append(Part.Arc(right[-1], turn.multVec(Vector(tip, 0, 0)), left[-1]).toShape())
        edges.append(Part.Arc(left[0], gap, following).toShape())
    return Part.Wire(Part.__sortEdges__(edges))


def _gear_blank(teeth, module):
    return Part.Face(_gear_outline(teeth, module)).extrude(Z * GEAR_WIDTH)


def spur_gear():
    """24 teeth of module 3; bore with keyway, six holes to save weight."""
    keyway = Part.makeBox(20.3, 10, GEAR_WIDTH + 2, Vector(0, -5, -1))
    bore = _cylinder(17, -1, GEAR_WIDTH + 1)
    return _gear_blank(24, 3).cut([bore.fuse(keyway)] + _holes(3.5, -1, GEAR_WIDTH + 1, 26, 6))


def pinion():
    """16 teeth of module 3, at 59.2 mm from the gear: 0.8 mm too near."""
    gear = _gear_blank(16, 3).cut(_cylinder(10, -1, GEAR_WIDTH + 1))
    gear.rotate(Vector(), Z, 180 + 180 / 16)  # a gap towards the gear, which has a tooth at angle 0
    gear.translate(Vector(59.2, 0, 0))
    return gear


def flanged_hub():
    """A flange under the gear with six screw holes on its circle; a boss with a fillet at its root."""
    corner, middle = 2 * math.sqrt(0.5), 2 - 2 * math.sqrt(0.5)
    outline = [Part.makeLine(Vector(*a), Vector(*b)) for a, b in (
        ((15, 0, 0), (31, 0, 0)), ((31, 0, 0), (32, 0, -1)), ((32, 0, -1), (32, 0, -8)), ((32, 0, -8), (22, 0, -8)),
        ((20, 0, -10), (20, 0, -32)), ((20, 0, -32), (19, 0, -33)), ((19, 0, -33), (15, 0, -33)), ((15, 0, -33), (15, 0, 0)))]
    fillet = Part.Arc(Vector(22, 0, -8), Vector(22 - corner, 0, -8 - middle), Vector(20, 0, -10))
    hub = Part.Face(Part.Wire(Part.__sortEdges__(outline + [fillet.toShape()]))).revolve(Vector(), Z, 360)
    return hub.cut(_holes(2.75, -20, 1, 26, 6))


def bracket():
    """An angle with a rounded inner edge, a gusset, four holes in the foot, one round and two long ones in the wall."""
    angle = _prism([(0, 0), (80, 0), (80, 8), (8, 8), (8, 75), (0, 75)], 0, 60)
    angle = angle.makeFillet(6, _edges(angle, lambda b: abs(b.XMin - 8) < 1e-6 > abs(b.XMax - 8) and abs(b.YMax - 8) < 1e-6))
    gusset = _prism([(4, 4), (64, 4), (64, 8), (8, 62), (4, 62)], 26, 8)
    body = angle.fuse(gusset).removeSplitter()
    drills = [Part.makeCylinder(4, 20, Vector(x, -5, z), Vector(0, 1, 0)) for x in (30, 62) for z in (12, 48)]
    drills.append(Part.makeCylinder(5, 20, Vector(-5, 68 - 20, 13), Vector(1, 0, 0)))
    for z in (44, 52):
        drills.append(_slot(z))
    return body.cut(drills)


def _slot(z):
    """A long hole through the bracket's wall, 4 mm wide."""
    ends = [Part.makeCylinder(2, 20, Vector(-5, y, z), Vector(1, 0, 0)) for y in (30, 50)]
    return ends[0].fuse([ends[1], Part.makeBox(20, 20, 4, Vector(-5, 30, z - 2))]).removeSplitter()


def envelope():
    """The room that the bracket may take: a block with edges rounded by 14 mm."""
    block = Part.makeBox(82, 76, 56, Vector(-3, -3, 2))
    return block.makeFillet(14, block.Edges)


PARTS = {make.__name__: make for make in (pillow_block, bearing_seat, keyed_shaft, spur_gear, pinion, flanged_hub, bracket, envelope)}
