"""Where icons, panels, translations and the engine lie: relative to the folder above `freecad_workbench`."""
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def path(*parts):
    return os.path.join(ROOT, "resources", *parts)


def icon(name):
    return path("icons", name + ".svg")


def ui(name):
    return path("ui", name + ".ui")
