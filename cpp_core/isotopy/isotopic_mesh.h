// A closed mesh that changes a disc at a time, and what is proved of it: isotopic to what it was at first, embedded, and how near, both ways.
//
// A change replaces a disc of triangles by a fan with the same rim: an edge's collapse, flip or split, a vertex's move. It is made if
//   - seen along one direction the fan is a graph over what the disc covers (star_map.h), it meets no other triangle (exact), and no
//     vertex lies between the two: then the disc moves to the fan without passing through anything, an isotopy;
//   - every triangle of the fan is within `most` of the first mesh, and every triangle of that which was near the disc is within it of the
//     new mesh (triangle_cover.h): the bound is that of the mesh as it is from the first one, not a sum over changes.
// Of each triangle of the first mesh it is kept which of the mesh prove it near, so that a change asks only those that relied on its disc.
// Guarantees: isotopic to the first mesh, embedded (if asked for, in float32 too) if that is; bound(), both ways. That disc and fan are discs is the caller's to know: the
// link condition for a collapse (Dey et al. 1999), that no edge joins the corners yet for a flip.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isotopy/triangle_cover.h"
#include "isotopy/triangle_grid.h"
#include "solids/polyhedron.h"

namespace starcell {

/// Triangles about one corner, the apex; the others go around it, or part of the way.
struct Fan {
  std::uint32_t apex;
  Vec3 place;   ///< where the apex is to be
  std::vector<std::array<std::uint32_t, 2>> rim;
};

class IsotopicMesh {
 public:
  static constexpr std::uint32_t none = UINT32_MAX;

  /// A closed, embedded manifold. `in_float32`: changes have to leave it embedded once rounded, too (contouring/embedding.h).
  IsotopicMesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles, bool in_float32 = false);

  /// Triangles have numbers below this; some are gone.
  std::uint32_t slots() const { return static_cast<std::uint32_t>(triangles_.size()); }
  bool has(std::uint32_t t) const { return triangles_[t][0] != none; }
  std::size_t size() const { return left_; }
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  Corners corners(std::uint32_t t) const { return corners_of(triangles_[t]); }

  std::uint32_t vertices() const { return static_cast<std::uint32_t>(points_.size()); }
  const Vec3& place(std::uint32_t v) const { return points_[v]; }
  const std::vector<Vec3>& places() const { return points_; }
  /// The vertex's triangles; none if it is gone.
  const std::vector<std::uint32_t>& about(std::uint32_t v) const { return about_[v]; }
  std::vector<std::uint32_t> neighbours(std::uint32_t v) const;
  /// The triangle on the other side of the edge from corner k.
  std::uint32_t across(std::uint32_t t, int k) const;

  /// The link condition: may the edge shrink to a point, and the topology stay?
  bool may_collapse(std::uint32_t a, std::uint32_t b) const;

  /// Replaces the disc by the fan, if it is proved as above. Vertices that no triangle is left about are gone. The apex may be a new vertex,
  /// of number vertices().
  bool replace(const std::vector<std::uint32_t>& disc, const Fan& fan, double most);

  /// The nearest to x of those points of the first mesh that are near the triangles.
  Vec3 on_first(const Vec3& x, const std::vector<std::uint32_t>& triangles) const;

  /// Of the Hausdorff distance from the first mesh, both ways.
  double bound() const;

  /// How many triangles proofs looked at, of changes that were made or not: what they cost, the same in every run.
  std::size_t work() const { return work_; }

  /// From now on the first mesh is this one, as it is: bounds begin at 0 again.
  void begin_anew();

  /// Without the numbers that are gone. `numbers`: of each vertex its new number, or none.
  void compact(std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, std::vector<std::uint32_t>& numbers) const;

 private:
  // How near the fan's triangles are to the first mesh, and the dependents to this one: to which of its triangles.
  struct Proof {
    std::vector<std::uint32_t> dependents;   // those of the first mesh that the disc was near to
    std::vector<double> far, first_far;
    std::vector<std::vector<std::uint32_t>> relies_on;
  };
  struct Undo {
    std::vector<Triangle> triangles;
    Vec3 place;
    std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> about;
  };

  Corners corners_of(const Triangle& t) const { return {points_[t[0]], points_[t[1]], points_[t[2]]}; }
  Corners first_corners(std::uint32_t t) const { return {first_points_[first_[t][0]], first_points_[first_[t][1]], first_points_[first_[t][2]]}; }
  std::vector<std::uint32_t> dependents_of(const std::vector<std::uint32_t>& disc) const;
  bool stays_near(const std::vector<std::uint32_t>& disc, const std::vector<std::uint32_t>& fan, double most, Proof& proof);
  bool meets_others(const std::vector<std::uint32_t>& disc, const std::vector<std::uint32_t>& fan, const std::vector<Corners>& old, const std::vector<Corners>& fresh) const;
  void keep(const std::vector<std::uint32_t>& disc, const std::vector<std::uint32_t>& fan, const std::vector<Corners>& old, Proof& proof);

  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<std::uint32_t>> about_;
  std::size_t left_;
  TriangleGrid grid_;
  std::vector<Vec3> first_points_;
  std::vector<Triangle> first_, across_first_;
  std::vector<std::vector<std::uint32_t>> relies_on_;    // per triangle of the first mesh: those of this one that prove it near
  std::vector<std::vector<std::uint32_t>> dependents_;   // the other way round
  std::vector<double> far_, first_far_;                  // bounds of this mesh's triangles' distance from the first, and the other way round
  std::vector<std::uint64_t> seen_, first_seen_;         // when a triangle was last looked at, in questions asked
  std::uint64_t stamp_ = 0;
  std::size_t work_ = 0;
  double slack_ = 0;
  bool in_float32_;
};

}  // namespace starcell
