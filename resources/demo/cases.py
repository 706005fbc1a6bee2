"""What the demo computes. One expression serves both engines: StarCell's solids and OpenCASCADE's have the same operators.

The expected topology is counted by hand on the drawing; `why` is the count. None: not known beforehand.
"""
from dataclasses import dataclass
from typing import Callable, List, Optional


@dataclass
class Case:
    name: str
    title: str
    expression: Callable      # of a dict of solids by name
    error: float              # mm
    genus: Optional[List[int]]
    why: str
    view: tuple               # where the camera stands, as a direction
    up: tuple = (0, 0, 1)
    context: tuple = ()       # operands to show behind the result; then the picture is a close-up


CASES = [
    Case("block_cut", "pillow block − bearing seat", lambda p: p["pillow_block"] - p["bearing_seat"], 0.1, [4],
         "one bore, two bolt holes, one grease hole", (0.9, 0.75, 1.6), up=(0, 1, 0)),
    Case("gear_on_shaft", "spur gear ∪ keyed shaft", lambda p: p["spur_gear"] | p["keyed_shaft"], 0.1, [6],
         "six holes; the shoulder closes the gap round the shaft", (1, -1, 1.3)),
    Case("gear_on_hub", "spur gear ∪ flanged hub", lambda p: p["spur_gear"] | p["flanged_hub"], 0.1, [7],
         "six screw holes and the bore", (1, -1, -1.2)),
    Case("bracket_trimmed", "bracket ∩ envelope", lambda p: p["bracket"] & p["envelope"], 0.1, [7],
         "four holes in the foot, one and two long ones in the wall", (1.3, 1, 1)),
    Case("gears_clash", "spur gear ∩ pinion, mounted too near", lambda p: p["spur_gear"] & p["pinion"], 0.02, None,
         "a piece wherever teeth run into each other", (0.3, -0.25, 1), up=(0, 1, 0), context=("spur_gear", "pinion")),
    Case("section", "((block − seat) ∪ shaft) ∩ half-space",
         lambda p: (p["pillow_block"] - p["bearing_seat"] | p["keyed_shaft"]) & p["half_space"], 0.1, [1, 0],
         "half a block with one bolt hole left; half a shaft, which nothing touches", (1.6, 0.55, 0.7), up=(0, 1, 0)),
]
