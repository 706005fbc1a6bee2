"""Hand-made meshes and independent measurements for the tests: numpy only, nothing of the code under test."""
import numpy as np

BOX_CORNERS = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
BOX_TRIANGLES = np.array([(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
                          (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)])


def box_mesh(lower=(0, 0, 0), upper=(1, 1, 1)):
    lower, upper = np.asarray(lower, float), np.asarray(upper, float)
    return lower + BOX_CORNERS * (upper - lower), BOX_TRIANGLES


def volume(mesh):
    """Signed volume by the divergence theorem, about the first vertex to keep the sum small."""
    vertices, triangles = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    if not len(triangles):
        return 0.0
    a, b, c = (vertices[triangles[:, k]] - vertices[0] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def is_closed_oriented(mesh):
    """Every directed edge occurs once, and its reverse once."""
    triangles = np.asarray(mesh.triangles)
    edges = {(t[k], t[(k + 1) % 3]) for t in triangles.tolist() for k in range(3)}
    return len(edges) == 3 * len(triangles) and all((b, a) in edges for a, b in edges)


def euler_characteristic(mesh):
    triangles = np.asarray(mesh.triangles)
    return len(np.unique(triangles)) - 3 * len(triangles) // 2 + len(triangles)


def rotation(axis, angle):
    """4x4 rotation about an axis through the origin (Rodrigues)."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    matrix = np.eye(4)
    matrix[:3, :3] += np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
    return matrix


def translation(shift):
    matrix = np.eye(4)
    matrix[:3, 3] = shift
    return matrix


def sphere_mesh(subdivisions, radius=1.0):
    """A subdivided octahedron, vertices on the sphere: 8 * 4**subdivisions triangles, closed and convex."""
    vertices = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    vertices = [np.array(v, float) for v in vertices]
    for _ in range(subdivisions):
        middle = {}

        def mid(i, j):
            key = (min(i, j), max(i, j))
            if key not in middle:
                point = vertices[i] + vertices[j]
                vertices.append(point / np.linalg.norm(point))
                middle[key] = len(vertices) - 1
            return middle[key]

        finer = []
        for a, b, c in triangles:
            ab, bc, ca = mid(a, b), mid(b, c), mid(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    return radius * np.array(vertices), np.array(triangles)
