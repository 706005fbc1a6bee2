"""Draws the creases of a mesh as lines, as CAD shows edges: shading alone does not tell equally lit sides apart."""
import numpy
from pivy import coin

from . import mesh_transfer

CREASE_DEGREES = 30.0


class CreaseLines:
    """Lines in the view provider's shaded mode; they hide and show with it."""

    def __init__(self):
        self.points = coin.SoCoordinate3()
        self.lines = coin.SoLineSet()
        look = coin.SoBaseColor()
        look.rgb = (0.05, 0.05, 0.05)
        style = coin.SoDrawStyle()
        style.lineWidth = 2
        aside = coin.SoPickStyle()
        aside.style = coin.SoPickStyle.UNPICKABLE
        plain = coin.SoLightModel()
        plain.model = coin.SoLightModel.BASE_COLOR
        self.node = coin.SoSeparator()
        for child in (aside, plain, look, style, self.points, self.lines):
            self.node.addChild(child)

    def update(self, vobj, mesh):
        # FreeCAD fills the scene after it has asked the proxy to attach, so the lines join it here.
        shaded = shaded_mode(vobj)
        if shaded and shaded.findChild(self.node) < 0:
            shaded.insertChild(coin.SoPolygonOffset(), 0)  # the faces give way to the lines on them
            shaded.addChild(self.node)
        points, triangles = mesh_transfer.from_mesh(mesh)
        ends = points[creases(points, triangles, CREASE_DEGREES)].reshape(-1, 3)
        self.points.point.setNum(0)
        self.points.point.setValues(0, len(ends), ends.tolist())
        self.lines.numVertices.setNum(0)
        self.lines.numVertices.setValues(0, len(ends) // 2, [2] * (len(ends) // 2))

    def segments(self):
        """The lines' end points, two by two."""
        return [point.getValue() for point in self.points.point.getValues()]


def creases(points, triangles, degrees):
    """(k, 2) vertex pairs: the edges of a closed mesh whose two triangles meet at more than this angle from flat."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    normals = numpy.cross(b - a, c - a)
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    sides = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    order = numpy.argsort(sides[:, 0] * numpy.int64(len(points)) + sides[:, 1])
    first, second = order[0::2], order[1::2]  # closed: every side comes twice
    count = len(triangles)
    cosine = numpy.einsum("ij,ij->i", normals[first % count], normals[second % count])
    return sides[first][cosine < numpy.cos(numpy.radians(degrees))]


def shaded_mode(vobj):
    """The scene of the display mode 'Shaded': first below the switch, and the only one in it with neither points nor edges."""
    for child in vobj.RootNode.getChildren():
        if child.isOfType(coin.SoSwitch.getClassTypeId()) and child.getNumChildren():
            return child.getChild(0)
    return None
