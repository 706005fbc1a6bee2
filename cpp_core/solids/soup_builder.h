// Collects what a mesh file says: vertices, and polygons that are fanned from their first corner.
#pragma once

#include <cstdint>
#include <string>

#include "solids/mesh_reader.h"

namespace starcell {

class SoupBuilder {
 public:
  /// Room is made for the counts that the file announces, but never for more than its bytes can hold.
  void expect(std::uint64_t vertices, std::uint64_t triangles, std::size_t bytes, std::size_t bytes_a_vertex);

  void vertex(const Vec3& p) { soup_.vertices.push_back(p); }
  std::size_t vertex_count() const { return soup_.vertices.size(); }

  void begin_polygon() { corners_ = 0; }
  /// False if no mesh can have this index.
  [[nodiscard]] bool corner(std::int64_t index);
  /// False if it had fewer than three corners.
  [[nodiscard]] bool end_polygon() const { return corners_ >= 3; }

  /// Throws FileError, naming the file, if a triangle uses a vertex that the file does not have.
  TriangleSoup finish(const std::string& name);

 private:
  TriangleSoup soup_;
  std::uint64_t corners_ = 0;
  std::uint32_t first_ = 0, last_ = 0;
};

}  // namespace starcell
