"""Booleans of Part's primitives that OpenCASCADE gets wrong, for the demo of Rescue.

All dimensions are small whole numbers. What OpenCASCADE gives was seen with 7.6 in FreeCAD 0.20.2, without a warning unless
stated; other versions may do better. `volume` is true to 0.1 %: a closed form where `why` gives one, else counted from 17 million
points against the primitives' formulas. `genus` was counted on a grid of voxels in the same way; None where parts only touch, so
that the count depends on what touching is taken for.
"""
import math
from dataclasses import dataclass
from typing import Callable, List, Optional

from FreeCAD import Placement, Rotation, Vector

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


@dataclass(frozen=True)
class RescueCase:
    name: str
    title: str
    build: Callable          # of a document: adds the objects, and returns the last Boolean
    opencascade: str         # what it gives
    volume: float            # true, mm^3
    genus: Optional[List[int]]
    why: str


def _add(doc, kind, at=(0, 0, 0), axis=Z, degrees=0, **values):
    obj = doc.addObject("Part::" + kind, kind)
    for name, value in values.items():
        setattr(obj, name, value)
    obj.Placement = Placement(Vector(*at), Rotation(Vector(*axis), degrees))
    return obj


def _ball(doc, at, radius, axis=Z, degrees=0):
    return _add(doc, "Sphere", at, axis, degrees, Radius=radius)


def _cylinder(doc, at, radius, height, axis=Z, degrees=0):
    return _add(doc, "Cylinder", at, axis, degrees, Radius=radius, Height=height)


def _cone(doc, at, radius1, radius2, height, axis=Z, degrees=0):
    return _add(doc, "Cone", at, axis, degrees, Radius1=radius1, Radius2=radius2, Height=height)


def _ring(doc, at, major, minor, axis=Z, degrees=0):
    return _add(doc, "Torus", at, axis, degrees, Radius1=major, Radius2=minor)


def _egg(doc, at, along_z, along_x, along_y):
    return _add(doc, "Ellipsoid", at, Radius1=along_z, Radius2=along_x, Radius3=along_y)


def _fuse(doc, base, tool, **where):
    return _add(doc, "Fuse", Base=base, Tool=tool, **where)


def _cut(doc, base, tool, **where):
    return _add(doc, "Cut", Base=base, Tool=tool, **where)


def _common(doc, base, tool, **where):
    return _add(doc, "Common", Base=base, Tool=tool, **where)


def _lens(a, b, distance):
    """Volume that two balls of radii a, b have in common."""
    return math.pi * (a + b - distance) ** 2 * (distance ** 2 + 2 * distance * (a + b) - 3 * (a - b) ** 2) / (12 * distance)


def two_balls(doc):
    return _fuse(doc, _ball(doc, (0, 1, 0), 3, Y, 180), _ball(doc, (0, 2, -3), 1, X, 270))


def drilled_ball(doc):
    return _cut(doc, _ball(doc, (0, 1, -2), 2, Z, 180), _cylinder(doc, (0, 0, 0), 3, 3, Y, 45))


def hollowed_pin(doc):
    return _cut(doc, _cylinder(doc, (1, 1, 0), 1, 3), _ball(doc, (1, -2, 0), 3, Y, 180))


def drum_in_ball(doc):
    return _common(doc, _cylinder(doc, (0, 0, 2), 3, 3, Y, 90), _ball(doc, (0, -1, 0), 2))


def pin_in_ball(doc):
    return _common(doc, _cylinder(doc, (3, -3, 0), 3, 3), _ball(doc, (2, 0, 0), 3, Y, 180))


def two_rings(doc):
    return _fuse(doc, _ring(doc, (2, 0, 0), 4, 2, Z, 180), _ring(doc, (0, 0, -2), 3, 2))


def rings_in_common(doc):
    return _common(doc, _ring(doc, (0, 1, 0), 4, 2, X, 180), _ring(doc, (0, 3, 0), 4, 2, X, 180))


def grooved_ring(doc):
    return _cut(doc, _ring(doc, (1, 1, 0), 2, 1, Z, 270), _ring(doc, (0, 1, 0), 2, 1, X, 45))


def egg_less_ring(doc):
    return _cut(doc, _egg(doc, (0, 1, -2), 2, 2, 3), _ring(doc, (0, 0, 0), 3, 2, Y, 270))


def cones_in_common(doc):
    return _common(doc, _cone(doc, (1, 0, 2), 1, 0, 5, X, 270), _cone(doc, (-2, 0, 1), 0, 1, 3, Y, 90))


def cone_on_cylinder(doc):
    return _fuse(doc, _cone(doc, (-3, 0, -1), 1, 2, 1), _cylinder(doc, (-3, 0, -3), 2, 6, Y, 90))


def ball_with_a_bite_on_a_ring(doc):
    bitten = _cut(doc, _ball(doc, (-3, -1, 2), 2, Z, 90), _cone(doc, (-2, 3, 0), 0, 3, 5))
    return _fuse(doc, bitten, _ring(doc, (-1, 0, 0), 4, 2, Y, 90))


def ball_cut_twice(doc):
    once = _cut(doc, _ball(doc, (0, 1, 2), 3), _cylinder(doc, (3, -2, 2), 2, 6), at=(0, -1, 2), degrees=90)
    return _cut(doc, once, _cylinder(doc, (0, -1, 3), 1, 5))


def ball_ring_and_egg(doc):
    ring = _fuse(doc, _ring(doc, (-1, 1, 0), 3, 1), _egg(doc, (3, -1, 0), 3, 2, 3))
    return _fuse(doc, _ball(doc, (-1, 0, 0), 3, X, 90), ring)


RESCUES = [
    RescueCase("two_balls", "ball ∪ ball", two_balls, "both balls whole, as two solids: 117.286 mm³",
               4 / 3 * math.pi * (27 + 1) - _lens(3, 1, math.sqrt(10)), [0],
               "radii 3 and 1, centres √10 apart: they overlap in a lens of closed form"),
    RescueCase("drilled_ball", "ball − cylinder", drilled_ball, "the whole ball: 33.510 mm³", 31.574, [0], "the cylinder takes a bite"),
    RescueCase("hollowed_pin", "cylinder − ball", hollowed_pin, "the whole cylinder: 9.425 mm³", 7.378, [0],
               "the ball touches the cylinder's axis where its foot is"),
    RescueCase("drum_in_ball", "cylinder ∩ ball", drum_in_ball, "nothing", 11.984, [0], "more than a third of the ball is in the drum"),
    RescueCase("pin_in_ball", "cylinder ∩ ball", pin_in_ball, "nothing", 20.810, [0], "nearly a fifth of the ball is in the cylinder"),
    RescueCase("two_rings", "torus ∪ torus", two_rings, "nothing", 482.71, [1],
               "parallel rings, 2 apart along the axis and across: their holes make one"),
    RescueCase("rings_in_common", "torus ∩ torus", rings_in_common, "366.776 mm³, nearly twice too much", 193.08, [1],
               "equal rings, 2 apart in their plane: a ring of changing width"),
    RescueCase("grooved_ring", "torus − torus", grooved_ring, "the whole first ring: 39.478 mm³", 28.857, [1],
               "what is taken away does not cut it through"),
    RescueCase("egg_less_ring", "ellipsoid − torus", egg_less_ring, "nothing", 5.295, [0], "what is left is one piece"),
    RescueCase("cones_in_common", "cone ∩ cone", cones_in_common, "nothing", 0.3426, [0], "two convex solids: one convex piece"),
    RescueCase("cone_on_cylinder", "cone ∪ cylinder", cone_on_cylinder,
               "an invalid shape of −68.068 mm³, the cone's volume less the cylinder's: the fuse turned into a cut", (24 + 7 / 3) * math.pi,
               None, "the cone stands on the cylinder's topmost line, and they have no volume in common"),
    RescueCase("ball_with_a_bite", "(ball − cone) ∪ torus", ball_with_a_bite_on_a_ring, "349.338 mm³ with a second shell", 341.48, [1],
               "the ball closes nothing of the ring's hole"),
    RescueCase("ball_cut_twice", "(ball − cylinder) − cylinder", ball_cut_twice, "the whole ball, 113.097 mm³, with an open shell",
               99.77, [0], "two bites from the side, neither goes through"),
    RescueCase("ball_ring_and_egg", "ball ∪ (torus ∪ ellipsoid)", ball_ring_and_egg, "a null shape", 214.00, None,
               "the ball fills the ring's hole, but for where it touches the ring"),
]
