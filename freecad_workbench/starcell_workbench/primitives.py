"""Part's primitives as the engine's exact solids, so that their curved faces need no tessellation.

Understands Part::Box, Sphere, Ellipsoid, Cylinder, Cone and Torus, whole or as a sector about their z axis. Everything else,
such as zones of a sphere, skewed cylinders and tori that cross themselves, has no recipe: its shape is taken as it is.
A recipe is a function of the engine alone. It holds plain numbers read from FreeCAD, and gives the solid in the object's
own coordinates, without its placement.
"""
import math

SMALLEST = 1e-7  # mm; OpenCASCADE takes what is shorter for zero


def recipe(obj):
    """A function starcell -> solid for a primitive, or None where its shape is to be used."""
    read = _READERS.get(obj.TypeId)
    return read(obj) if read else None


def _box(obj):
    sides = obj.Length.Value, obj.Width.Value, obj.Height.Value
    return _if_long(sides, lambda starcell: starcell.Box((0, 0, 0), sides))


def _sphere(obj):
    radius = obj.Radius.Value
    if _is_zone(obj, 90):
        return None
    return _if_long([radius], _sector(obj.Angle3.Value, lambda starcell: starcell.Sphere((0, 0, 0), radius)))


def _ellipsoid(obj):
    # FreeCAD stretches a ball, and its sector with it. Radius1 lies along z, Radius2 along x; Radius3, along y, may be left out.
    along_z, along_x = obj.Radius1.Value, obj.Radius2.Value
    along_y = obj.Radius3.Value if obj.Radius3.Value >= SMALLEST else along_x
    if _is_zone(obj, 90):
        return None
    if obj.Angle3.Value == 360:
        return _if_long([along_x, along_z], lambda starcell: starcell.Ellipsoid((0, 0, 0), (along_x, along_y, along_z)))
    sector = _sector(obj.Angle3.Value, lambda starcell: starcell.Sphere((0, 0, 0), 1))
    stretch = [[along_x, 0, 0, 0], [0, along_y, 0, 0], [0, 0, along_z, 0], [0, 0, 0, 1]]
    return _if_long([along_x, along_z], sector and (lambda starcell: sector(starcell).transformed(stretch)))


def _cylinder(obj):
    radius, height = obj.Radius.Value, obj.Height.Value
    if obj.FirstAngle.Value or obj.SecondAngle.Value:
        return None  # skewed
    return _if_long([radius, height], _sector(obj.Angle.Value, _round(radius, height)))


def _cone(obj):
    bottom, top, height = obj.Radius1.Value, obj.Radius2.Value, obj.Height.Value
    if abs(bottom - top) < SMALLEST:  # FreeCAD makes a cylinder of it
        return _if_long([bottom, height], _sector(obj.Angle.Value, _round(bottom, height)))
    return _if_long([height], _sector(obj.Angle.Value, lambda starcell: starcell.Cone((0, 0, 0), (0, 0, 1), bottom, top, height)))


def _torus(obj):
    major, minor = obj.Radius1.Value, obj.Radius2.Value
    if _is_zone(obj, 180) or minor >= major:
        return None
    return _if_long([minor], _sector(obj.Angle3.Value, lambda starcell: starcell.Torus((0, 0, 0), (0, 0, 1), major, minor)))


_READERS = {"Part::Box": _box, "Part::Sphere": _sphere, "Part::Ellipsoid": _ellipsoid, "Part::Cylinder": _cylinder,
            "Part::Cone": _cone, "Part::Torus": _torus}


def _round(radius, height):
    return lambda starcell: starcell.Cylinder((0, 0, 0), (0, 0, 1), radius, height)


def _is_zone(obj, whole):
    """Whether only a part of the profile is turned about the axis."""
    return (obj.Angle1.Value, obj.Angle2.Value) != (-whole, whole)


def _if_long(lengths, made):
    return made if min(lengths) >= SMALLEST else None


def _sector(degrees, whole):
    """What of a solid of revolution lies between 0 and this angle about z, counted from x; None if that is nothing, or almost all."""
    if degrees == 360:
        return whole
    if not 1e-6 < degrees < 360 - 1e-6:
        return None

    def sector(starcell):
        first = starcell.HalfSpace((0, 0, 0), (0, -1, 0))
        last = starcell.HalfSpace((0, 0, 0), (-_sine(degrees), _sine(degrees + 90), 0))
        if degrees == 180:
            return whole(starcell) & first
        return whole(starcell) & (first & last if degrees < 180 else first | last)

    return sector


def _sine(degrees):
    """Exact at right angles, where faces of other solids are likely to coincide."""
    return {0: 0, 90: 1, 180: 0, 270: -1}.get(degrees % 360, math.sin(math.radians(degrees)))
