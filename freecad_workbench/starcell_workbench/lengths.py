"""Lengths and angles as people write and read them."""
import decimal
import math

import FreeCAD

from .translation import translate


def parse(value, name):
    """A length in mm from a number, a quantity or a text such as "0.1 mm". Raises TypeError or ValueError that name it."""
    try:
        quantity = FreeCAD.Units.Quantity(value) if isinstance(value, str) else value
    except Exception:
        raise ValueError(_no_length(name, value)) from None
    if hasattr(quantity, "Unit"):
        if quantity.Unit not in (FreeCAD.Units.Length, FreeCAD.Units.Unit()):
            raise ValueError(_no_length(name, value))
        quantity = quantity.Value
    if isinstance(quantity, bool) or not isinstance(quantity, (int, float)):
        raise TypeError(translate("StarCell", "{}: expected a number of mm or a text with a unit, not {!r}.").format(name, value))
    if not math.isfinite(quantity):
        raise ValueError(translate("StarCell", "{}: must be finite, not {!r}.").format(name, value))
    return float(quantity)


def parse_angle(value, name):
    """An angle in degrees from a number, a quantity or a text such as "40 deg". Raises TypeError or ValueError that name it."""
    try:
        quantity = FreeCAD.Units.Quantity(value) if isinstance(value, str) else value
        degrees = float(getattr(quantity, "Value", quantity))
    except Exception:
        raise ValueError(_no_angle(name, value)) from None
    if getattr(quantity, "Unit", None) not in (None, FreeCAD.Units.Angle, FreeCAD.Units.Unit()) or not math.isfinite(degrees) or value == "":
        raise ValueError(_no_angle(name, value))
    return degrees


def parse_positive(value, name):
    length = parse(value, name)
    if length <= 0:
        raise ValueError(translate("StarCell", "{}: must be a length above 0, not {!r}; leave it out for an automatic one.").format(name, value))
    return length


def show(value, down=False):
    """A length (mm or a quantity) with four digits, rounded up, or down: a bound that is shown must hold."""
    value = getattr(value, "Value", value)
    rounded = decimal.Context(prec=4, rounding=decimal.ROUND_FLOOR if down else decimal.ROUND_CEILING).create_decimal(repr(float(value)))
    return "{:.4g} mm".format(float(rounded))


def _no_angle(name, value):
    return translate("StarCell", "{}: '{}' is no angle; write for example 40 deg.").format(name, value)


def _no_length(name, value):
    return translate("StarCell", "{}: '{}' is no length; write for example 0.1 mm.").format(name, value)
