"""Finds and loads the C++ engine, the Python module `starcell`.

Searched in build/lib (a checkout), then lib (an installed copy), then wherever Python looks. Loaded by the first
operation, never while FreeCAD starts: a missing or broken engine costs a message, not the start.
"""
import importlib
import os
import sys

from . import resources
from .translation import translate


class EngineMissing(RuntimeError):
    """The engine is not built, or cannot be loaded."""


def folders():
    return [os.path.join(resources.ROOT, "build", "lib"), os.path.join(resources.ROOT, "lib")]


def load():
    """The module `starcell`. Raises EngineMissing with what to do about it."""
    if "starcell" in sys.modules:
        return sys.modules["starcell"]
    present = [folder for folder in folders() if _holds_engine(folder)]
    sys.path[:0] = [folder for folder in present if folder not in sys.path]
    try:
        return importlib.import_module("starcell")
    except ImportError as error:
        if present:
            text = translate("StarCell", "StarCell's engine in {} cannot be loaded: {}. Build it anew.").format(present[0], error)
        else:
            text = translate("StarCell", "StarCell's engine is not built: there is no module 'starcell' in {}. Build it with './run build' in {}.")
            text = text.format(translate("StarCell", " or ").join(folders()), resources.ROOT)
        raise EngineMissing(text) from None


def _holds_engine(folder):
    return os.path.isdir(folder) and any(name.startswith("starcell.") for name in os.listdir(folder))
