#include "cad/cad_export.h"

#include <BRepTools.hxx>
#include <BinTools.hxx>
#include <BinTools_LocationSet.hxx>
#include <BinTools_ShapeSet.hxx>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "cad/mesh_to_solid.h"
#include "cad/occ_boundary.h"
#include "solids/errors.h"

namespace starcell {
namespace {

constexpr double default_tolerance = 1e-9;  ///< of the longest side

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension != ".bin" && extension != ".brep" && extension != ".brp")
    throw std::invalid_argument("path: expected the extension .bin, .brep or .brp, not '" + path + "'");
  return extension;
}

/// As FreeCAD's Shape.exportBinary: the set of shapes, then which of them, at which place, how oriented.
void write_binary(const TopoDS_Shape& shape, std::ostream& stream) {
  BinTools_ShapeSet set;
  const int number = set.Add(shape);
  const int location = set.Locations().Index(shape.Location());
  set.Write(stream);
  BinTools::PutInteger(stream, number);
  BinTools::PutInteger(stream, location);
  BinTools::PutInteger(stream, shape.Orientation());
}

}  // namespace

std::size_t write_solid(const Polyhedron& mesh, const std::string& path, std::optional<double> tolerance) {
  const std::string extension = extension_of(path);
  if (tolerance && !(*tolerance >= 0 && std::isfinite(*tolerance)))
    throw std::invalid_argument("tolerance: must not be negative and must be finite");
  return cad::across_boundary<InvalidSolidError>("Cannot make a solid of the mesh", [&] {
    const cad::MeshSolid solid = cad::mesh_to_solid(mesh, tolerance.value_or(default_tolerance * longest_side(mesh.bounding_box())));
    std::ofstream file(path, std::ios::binary);
    if (!file) throw FileError("Cannot write '" + path + "': " + std::strerror(errno) + ".");
    if (extension == ".bin")
      write_binary(solid.shape, file);
    else
      BRepTools::Write(solid.shape, file);
    file.close();
    if (!file) throw FileError("Cannot write '" + path + "' completely: is the disk full?");
    return solid.faces;
  });
}

}  // namespace starcell
