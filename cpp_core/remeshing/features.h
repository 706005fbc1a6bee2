// The sharp edges of a mesh, kept as the mesh changes: as point sets they stay what they are.
//
// An edge is sharp if the surface turns by more than an angle there, measured once, on the mesh as it was given. A sliver has no say in which
// way the surface faces: it counts as a part of what is beside its longest edge. A vertex where sharp edges
// end, meet or bend is a corner and stays where it is; one where two go straight on may slide along them, or go; all others are free.
#pragma once

#include <cstdint>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

class Features {
 public:
  /// Of a closed manifold; `angle` in radians. Triangles that are no wider than `sliver` are slivers.
  Features(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double angle, double sliver);

  bool has(std::uint32_t a, std::uint32_t b) const;
  bool is_free(std::uint32_t v) const { return along(v).empty(); }
  /// Two sharp edges and no bend, up to the rounding of a point on a line.
  bool is_straight(std::uint32_t v, const std::vector<Vec3>& places) const;
  /// What the vertex is joined to by sharp edges.
  const std::vector<std::uint32_t>& along(std::uint32_t v) const { return v < along_.size() ? along_[v] : nothing_; }
  /// Sharp edges, each once.
  std::size_t size() const;

  /// The edge becomes two, joined at a vertex; nothing if it is not sharp.
  void split(std::uint32_t a, std::uint32_t b, std::uint32_t between);
  /// A straight vertex goes: what it joined is joined by one edge.
  void straighten(std::uint32_t v);

 private:
  std::vector<std::vector<std::uint32_t>> along_;
  std::vector<std::uint32_t> nothing_;
};

/// A part of the sharp edges without a bend, from corner to corner.
struct Run {
  std::uint32_t from, to;
  std::vector<std::uint32_t> between;   ///< the straight vertices on the way
};
std::vector<Run> runs(const Features& features, const std::vector<Vec3>& places);

}  // namespace starcell
