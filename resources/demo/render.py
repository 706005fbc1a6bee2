"""Pictures of triangle meshes in numpy alone: no graphics card, no display, the same bytes everywhere.

A z-buffer at three times the picture's width; smooth shading except across creases, two lights, sharp edges and outlines
drawn dark, then averaged down. Meant for up to some 200,000 triangles.
"""
import struct
import zlib
from dataclasses import dataclass

import numpy as np

CREASE = np.cos(np.radians(28))
OVERSAMPLING = 3
KEY_LIGHT, FILL_LIGHT = (0.35, 0.75, 0.9), (-0.8, 0.1, 0.45)  # in the camera's frame: right, up, towards the viewer
BACKGROUND = np.array((0.965, 0.97, 0.98))
LINE = np.array((0.10, 0.12, 0.15))
FAR = -np.inf


def write_png(path, pixels):
    """pixels: (height, width, 3) uint8."""
    height, width = pixels.shape[:2]
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], axis=1).tobytes()

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def _unit(vectors):
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


def _camera(direction, up):
    """Rows: right, up, towards the viewer."""
    towards = _unit(np.asarray(direction, float))
    right = _unit(np.cross(up, towards))
    return np.array((right, np.cross(towards, right), towards))


class _Mesh:
    """A mesh in the camera's frame with what the picture needs: facet normals, corner normals, crease edges, parts."""

    def __init__(self, vertices, triangles):
        self.vertices, self.triangles = vertices, triangles
        a, b, c = (vertices[triangles[:, k]] for k in range(3))
        cross = np.cross(b - a, c - a)
        self.normals = _unit(cross)
        self._pair_edges()
        self.parts = self._find_parts()
        self.corner_normals = self._smooth(a, b, c)

    def _pair_edges(self):
        """Half edges 3 t + k, from corner k of triangle t; mate[h] runs the other way. The mesh is closed and oriented."""
        t = self.triangles.astype(np.int64)
        start, end = t.ravel(), np.roll(t, -1, axis=1).ravel()
        n = len(self.vertices)
        forward, backward = np.argsort(start * n + end), np.argsort(end * n + start)
        self.mate = np.empty(len(start), np.int64)
        self.mate[forward] = backward
        cosine = np.einsum("ij,ij->i", self.normals[np.arange(len(start)) // 3], self.normals[self.mate // 3])
        self.sharp = cosine < CREASE
        self.creases = np.stack([start, end], axis=1)[self.sharp & (start < end)]

    def _find_parts(self):
        label = np.arange(len(self.vertices))
        while True:
            low = label[self.triangles].min(axis=1)
            new = label.copy()
            for k in range(3):
                np.minimum.at(new, self.triangles[:, k], low)
            new = new[new]
            if (new == label).all():
                return np.unique(label[self.triangles[:, 0]], return_inverse=True)[1]
            label = new

    def _smooth(self, a, b, c):
        """Corner normals: angle-weighted means over the fan of triangles between two sharp edges."""
        def angle(u, v):
            return np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v))
        weight = np.stack([angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)], axis=1)
        own = (weight[:, :, None] * self.normals[:, None, :]).reshape(-1, 3)
        # Corner h walks to the next corner round the same vertex: across its own edge, whose mate's successor starts there.
        following = 3 * (self.mate // 3) + (self.mate + 1) % 3
        following = np.where(self.sharp, -1, following)
        total, step, inverse = own.copy(), following.copy(), np.full(len(own), -1)
        inverse[following[following >= 0]] = np.flatnonzero(following >= 0)
        for walk in (step, inverse):
            at, active = walk.copy(), np.flatnonzero(walk >= 0)
            for _ in range(64):
                active = active[(at[active] >= 0) & (at[active] != active)]
                if not len(active):
                    break
                total[active] += own[at[active]]
                at[active] = walk[at[active]]
        return _unit(total).reshape(-1, 3, 3)


def _fragments(points, width, height):
    """Batches (triangle, pixel, barycentric) of all samples that triangles cover; points: (m, 3, 2 or 3) in pixels."""
    low = np.maximum(np.floor(points[:, :, :2].min(axis=1)).astype(int), 0)
    high = np.minimum(np.ceil(points[:, :, :2].max(axis=1)).astype(int), (width - 1, height - 1))
    size = high - low + 1
    edge1, edge2 = points[:, 1, :2] - points[:, 0, :2], points[:, 2, :2] - points[:, 0, :2]
    area = edge1[:, 0] * edge2[:, 1] - edge1[:, 1] * edge2[:, 0]
    seen = np.flatnonzero((area > 1e-9) & (size > 0).all(axis=1))  # facing the viewer and inside the picture
    # Triangles whose boxes are about equally large share one rectangular grid of samples.
    kind = np.ceil(np.log2(size[seen])).astype(int)
    for w, h in np.unique(kind, axis=0):
        members = seen[(kind == (w, h)).all(axis=1)]
        dx, dy = (g.ravel() for g in np.meshgrid(np.arange(2 ** w), np.arange(2 ** h)))
        for batch in np.array_split(members, max(1, len(members) * len(dx) // 2_000_000)):
            x, y = low[batch, 0, None] + dx, low[batch, 1, None] + dy
            px, py = x + 0.5 - points[batch, 0, 0, None], y + 0.5 - points[batch, 0, 1, None]
            v = (px * edge2[batch, 1, None] - py * edge2[batch, 0, None]) / area[batch, None]
            w2 = (py * edge1[batch, 0, None] - px * edge1[batch, 1, None]) / area[batch, None]
            inside = (v >= 0) & (w2 >= 0) & (v + w2 <= 1) & (x < width) & (y < height)
            row, column = np.nonzero(inside)
            v, w2 = v[inside], w2[inside]
            yield batch[row], y[inside] * width + x[inside], np.stack([1 - v - w2, v, w2], axis=1)


def _rasterise(mesh, points, palette, depth, colour):
    """Draws into depth (height, width) and colour (height, width, 3) what lies before what they hold."""
    height, width = depth.shape
    depth, colour = depth.reshape(-1), colour.reshape(-1, 3)
    corners = points[mesh.triangles]
    key, fill = _unit(np.array(KEY_LIGHT)), _unit(np.array(FILL_LIGHT))
    halfway = _unit(key + (0, 0, 1))
    for triangle, pixel, weight in _fragments(corners, width, height):
        z = np.einsum("ij,ij->i", weight, corners[triangle, :, 2])
        order = np.argsort(z, kind="stable")  # the nearest is written last
        order = order[z[order] > depth[pixel[order]]]
        triangle, pixel, weight = triangle[order], pixel[order], weight[order]
        depth[pixel] = z[order]
        normal = _unit(np.einsum("ij,ijk->ik", weight, mesh.corner_normals[triangle]))
        light = 0.45 + 0.08 * normal[:, 1] + 0.48 * np.clip(normal @ key, 0, 1) + 0.22 * np.clip(normal @ fill, 0, 1)
        shine = 0.18 * np.clip(normal @ halfway, 0, 1) ** 40
        colour[pixel] = np.clip(palette[mesh.parts[triangle]] * light[:, None] + shine[:, None], 0, 1)


def _draw_creases(mesh, points, depth, colour, tolerance):
    height, width = depth.shape
    a, b = points[mesh.creases[:, 0]], points[mesh.creases[:, 1]]
    count = np.ceil(np.linalg.norm((b - a)[:, :2], axis=1) * 1.5).astype(int) + 1
    which = np.repeat(np.arange(len(count)), count)
    t = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)) / np.maximum(count[which] - 1, 1)
    at = a[which] + t[:, None] * (b - a)[which]
    x, y = (np.floor(at[:, k]).astype(int) for k in (0, 1))
    inside = (x >= 2) & (y >= 2) & (x < width - 2) & (y < height - 2)
    x, y, z = x[inside], y[inside], at[inside, 2]
    # Visible if some sample beside the line is not in front of it: the line itself lies on the outline of what it bounds.
    near = np.min([depth[y + j, x + i] for i in (-2, 0, 2) for j in (-2, 0, 2)], axis=0)
    x, y = x[z > near - tolerance], y[z > near - tolerance]
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            colour[y + j, x + i] = LINE


def _draw_outlines(depth, colour, step):
    """Where the depth jumps, the nearer side gets a dark rim."""
    rim = np.zeros(depth.shape, bool)
    for shift, axis in ((1, 0), (-1, 0), (1, 1), (-1, 1)):
        other = np.roll(depth, shift, axis)
        with np.errstate(invalid="ignore"):
            rim |= (depth > FAR) & (depth - other > step)
    for shift, axis in ((1, 0), (1, 1)):
        rim |= np.roll(rim, shift, axis) & (depth > FAR)
    rim[:2], rim[-2:], rim[:, :2], rim[:, -2:] = False, False, False, False  # np.roll brings in the opposite border
    colour[rim] = LINE


@dataclass
class Item:
    """A closed, oriented mesh and the colours of its components, in turn; lift moves it towards the viewer."""
    vertices: np.ndarray
    triangles: np.ndarray
    colours: tuple
    lift: float = 0.0


def picture(path, items, direction, up=(0, 0, 1), close_up=False, size=(1000, 750)):
    """Writes a PNG of the items seen from `direction` in parallel projection, or a close-up of the first one. Empty meshes are
    left out."""
    width, height = size[0] * OVERSAMPLING, size[1] * OVERSAMPLING
    frame = _camera(direction, up)
    items = [item for item in items if len(item.triangles)]
    meshes = [_Mesh(np.asarray(item.vertices, float) @ frame.T + (0, 0, item.lift), np.asarray(item.triangles)) for item in items]
    framed = [mesh.vertices for mesh in meshes[:1 if close_up else None]]
    everything = np.concatenate(framed or [np.zeros((1, 3))])
    low, high = everything.min(axis=0), everything.max(axis=0)
    extent = np.maximum(high - low, 1e-12)
    scale = 0.90 * min(width / extent[0], height / extent[1])

    depth = np.full((height, width), FAR)
    colour = np.tile(BACKGROUND, (height, width, 1))
    projected = []
    for item, mesh in zip(items, meshes):
        points = (mesh.vertices - (low + high) / 2) * scale
        points[:, :2] += (width / 2, height / 2)
        palette = np.asarray(item.colours, float)[np.arange(mesh.parts.max() + 1) % len(item.colours)]
        _rasterise(mesh, points, palette, depth, colour)
        projected.append(points)
    _draw_outlines(depth, colour, step=0.012 * width)
    for mesh, points in zip(meshes, projected):
        _draw_creases(mesh, points, depth, colour, tolerance=0.002 * width)
    small = colour.reshape(size[1], OVERSAMPLING, size[0], OVERSAMPLING, 3).mean(axis=(1, 3))
    # Rows count upwards here, as the camera's y does; the file counts downwards.
    write_png(path, (small[::-1] * 255 + 0.5).astype(np.uint8))
