"""How a measured penetration depth shows itself: an arrow along the way out, or a line across the clearance, and its length."""
from pivy import coin

from . import depth_feature, resources
from .stateless import Stateless

OVERLAP_COLOR, CLEARANCE_COLOR = (0.85, 0.05, 0.05), (0.0, 0.5, 0.15)
HEAD_SHARE, HEAD_RATIO = 0.3, 0.3  # of the arrow's length; of its head's
LINE_WIDTH, FONT_SIZE = 4, 18


class DepthView(Stateless):
    def __init__(self, vobj):
        vobj.Proxy = self

    def attach(self, vobj):
        self.obj = vobj.Object
        self.color, self.drawn = coin.SoBaseColor(), coin.SoSeparator()
        over, plain, aside = coin.SoAnnotation(), coin.SoLightModel(), coin.SoPickStyle()  # not hidden by what is in front
        plain.model, aside.style = coin.SoLightModel.BASE_COLOR, coin.SoPickStyle.UNPICKABLE
        for child in (aside, plain, self.color, self.drawn):
            over.addChild(child)
        vobj.addDisplayMode(over, "Arrow")
        self.draw()

    def getDisplayModes(self, vobj):
        return ["Arrow"]

    def getDefaultDisplayMode(self):
        return "Arrow"

    def setDisplayMode(self, mode):
        return mode

    def getIcon(self):
        return resources.icon(self.obj.Proxy.command)

    def claimChildren(self):
        return []  # the solids stay where they are in the tree: they are measured, not used up

    def updateData(self, obj, name):
        if name in ("Report", "PointOfFirst"):
            self.draw()

    def draw(self):
        self.drawn.removeAllChildren()
        obj = self.obj
        if not getattr(obj, "Report", ""):
            return
        overlap = obj.DepthUpper.Value > 0
        start, end = obj.PointOfSecond, obj.PointOfFirst
        if overlap:
            end = start + obj.Direction * obj.DepthUpper.Value
        self.color.rgb = OVERLAP_COLOR if overlap else CLEARANCE_COLOR
        for node in _line(start, end):
            self.drawn.addChild(node)
        if (end - start).Length > 0:
            self.drawn.addChild(_head(start, end))
            if not overlap:
                self.drawn.addChild(_head(end, start))
        self.drawn.addChild(_text(end if overlap else (start + end) / 2, depth_feature.label(obj)))


def _line(start, end):
    style, points, line = coin.SoDrawStyle(), coin.SoCoordinate3(), coin.SoLineSet()
    style.lineWidth = LINE_WIDTH
    points.point.setValues(0, 2, [tuple(start), tuple(end)])
    return style, points, line


def _head(start, end):
    """A cone whose tip is at the end."""
    along = end - start
    height = HEAD_SHARE * along.Length
    place, cone, head = coin.SoTransform(), coin.SoCone(), coin.SoSeparator()
    tip = end - along * (0.5 * HEAD_SHARE)
    place.translation = tuple(tip)
    place.rotation.setValue(coin.SbRotation(coin.SbVec3f(0, 1, 0), coin.SbVec3f(*along)))
    cone.height, cone.bottomRadius = height, HEAD_RATIO * height
    head.addChild(place)
    head.addChild(cone)
    return head


def _text(at, text):
    place, font, label, node = coin.SoTranslation(), coin.SoFont(), coin.SoText2(), coin.SoSeparator()
    place.translation = tuple(at)
    font.size = FONT_SIZE
    label.string = "  " + text
    for child in (place, font, label):
        node.addChild(child)
    return node
