// Mesh files to vertices and triangles: OFF, STL, OBJ and PLY, ascii and binary; a trailing .gz is not handled.
// Polygons are fanned from their first vertex. What the file says is what comes out: nothing is repaired here.
// Guarantees: any byte sequence gives a mesh or a FileError that names file, place and reason; indices are in range.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

struct TriangleSoup {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// Chooses the format by the file's extension (any case). Throws FileError.
TriangleSoup read_mesh(const std::string& path);

/// One reader a format; `name` is used in messages only.
TriangleSoup read_off(std::string_view bytes, const std::string& name);
TriangleSoup read_stl(std::string_view bytes, const std::string& name);
TriangleSoup read_obj(std::string_view bytes, const std::string& name);
TriangleSoup read_ply(std::string_view bytes, const std::string& name);

}  // namespace starcell
