"""What the long tests ask of CAD files and of meshes. Not a test by itself: run alone it says so and succeeds."""
import os
import zipfile

import numpy as np
import starcell as sc


def volume(vertices, triangles):
    if not len(triangles):
        return 0.0
    a, b, c = (vertices[triangles[:, k]] - vertices[0] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def area(vertices, triangles):
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def is_closed(triangles):
    edges = {(t[k], t[k - 2]) for t in triangles.tolist() for k in range(3)}
    return len(edges) == 3 * len(triangles) and all((b, a) in edges for a, b in edges)


def largest_shape(path, folder):
    """A FreeCAD document keeps its shapes as BREP files in a zip archive: the largest one is the part."""
    if not path.lower().endswith(".fcstd"):
        return path
    with zipfile.ZipFile(path) as archive:
        shapes = [i for i in archive.infolist() if i.filename.lower().endswith((".brp", ".brep"))]
        if not shapes:
            raise sc.FileError("The document contains no shape.")
        target = os.path.join(folder, "shape.brep")
        with open(target, "wb") as out:
            out.write(archive.read(max(shapes, key=lambda i: i.file_size)))
    return target


if __name__ == "__main__":
    print("parts.py is used by the other long tests; nothing to test here")
