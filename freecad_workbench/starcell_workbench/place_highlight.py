"""Draws the places that an operation found over everything else: an orange box about each, and across thin walls red spokes from side to side."""
from pivy import coin

from .crease_lines import shaded_mode

SPOKE_COLOR, BOX_COLOR = (0.9, 0.05, 0.05), (1.0, 0.55, 0.0)
# The corners of a box, numbered by which coordinates are the upper ones, that an edge joins.
BOX_EDGES = [(corner, corner | 1 << axis) for corner in range(8) for axis in range(3) if not corner >> axis & 1]


class PlaceHighlight:
    """Lines that hide and show with the object's shaded mode; shown() turns them on or off."""

    def __init__(self):
        self.switch = coin.SoSwitch()
        over = coin.SoAnnotation()  # not hidden by what is in front
        aside = coin.SoPickStyle()
        aside.style = coin.SoPickStyle.UNPICKABLE
        plain = coin.SoLightModel()
        plain.model = coin.SoLightModel.BASE_COLOR
        over.addChild(aside)
        over.addChild(plain)
        self.spokes, self.boxes = _Lines(SPOKE_COLOR, 1), _Lines(BOX_COLOR, 2)
        over.addChild(self.spokes.node)
        over.addChild(self.boxes.node)
        self.switch.addChild(over)

    def update(self, obj, highlighted):
        """Reads the object's places, as `highlighted` (operation_feature.Highlighted) names them. FreeCAD fills the scene after the proxy's attach, so the lines join it here."""
        shaded = shaded_mode(obj.ViewObject)
        if shaded and shaded.findChild(self.switch) < 0:
            shaded.addChild(self.switch)
        self.spokes.set([tuple(end) for end in getattr(obj, highlighted.spokes)] if highlighted.spokes else [])
        places = getattr(obj, highlighted.places)
        corners = list(zip(places[::2], places[1::2]))
        self.boxes.set([tuple((lower, upper)[end >> axis & 1][axis] for axis in range(3))
                        for lower, upper in corners for edge in BOX_EDGES for end in edge])

    def show(self, wanted):
        self.switch.whichChild = coin.SO_SWITCH_ALL if wanted else coin.SO_SWITCH_NONE

    def is_shown(self):
        return self.switch.whichChild.getValue() == coin.SO_SWITCH_ALL


class _Lines:
    """Segments of one colour."""

    def __init__(self, color, width):
        self.node, self.points, self.lines = coin.SoSeparator(), coin.SoCoordinate3(), coin.SoLineSet()
        look, style = coin.SoBaseColor(), coin.SoDrawStyle()
        look.rgb = color
        style.lineWidth = width
        for child in (look, style, self.points, self.lines):
            self.node.addChild(child)

    def set(self, ends):
        """ends: points, two a segment."""
        self.points.point.setNum(0)
        self.points.point.setValues(0, len(ends), ends)
        self.lines.numVertices.setNum(0)
        self.lines.numVertices.setValues(0, len(ends) // 2, [2] * (len(ends) // 2))
