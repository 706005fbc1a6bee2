// F(x) = s(x) - r, s the signed distance from a polyhedron's boundary (negative inside): F = 0 is the rounded offset by r.
//
// Rests on T§4.2 (the offset is the union of the solid and what is within r of its features), turned round: membership is a
// distance, and a cell keeps the features that can be nearest in it. Their normals there enclose Clarke's generalised gradient of
// s (Clarke 1983), which is all that star-shapedness along a direction asks for; creases over concave edges need no case of their own.
// To second order s is semiconcave outside and semiconvex inside with constant 1/distance, as every distance is; where the nearest
// point is proved unique it is convex, or concave, too.
// Guarantees: expansions enclose; a restricted surface is the same function in its box; parts have it as their least, or greatest.
// Does not guarantee: second derivatives where feet are not proved unique (`smooth` is false there).
#pragma once

#include "distance/mesh_features.h"
#include "solids/smooth_surface.h"

namespace starcell {

class DistanceSurface final : public SmoothSurface {
 public:
  /// The whole surface; `offset` is not 0.
  DistanceSurface(std::shared_ptr<const MeshFeatures> features, double offset);
  /// Of some faces alone, whatever solid they bound: what is equally far from them on either side. `radius` > 0; faces ascending.
  DistanceSurface(std::shared_ptr<const MeshFeatures> features, std::vector<std::uint32_t> faces, double radius);

  Expansion expand(const Vec3& center, const Vec3& reach) const override;
  double value(const Vec3& x, Vec3* gradient) const override;
  SmoothSurfacePtr translated(const Vec3& by) const override;
  SmoothSurfacePtr restricted(const Box3& box) const override;
  std::vector<SmoothSurfacePtr> parts() const override;
  bool least_of_parts() const override { return side_ >= 0; }
  std::vector<FlatPiece> planes() const override;
  std::optional<std::size_t> plane() const override { return plane_; }
  bool simple() const override { return !local_.empty(); }

 private:
  enum class Kind : std::uint8_t { vertex, edge, face };

  // A feature that can be nearest, and where its faces' masks say so.
  struct Local {
    Kind kind;
    std::uint32_t id;
    bool interior;   // all faces about it are there
    std::vector<std::pair<std::uint16_t, std::uint8_t>> bits;   // (index into faces_, bit of its mask)
  };

  // The nearest point of all faces, enclosed: its distance, and on which feature it is.
  struct Foot {
    double low = 0, high = 0;
    Vec3 place;
    std::uint32_t face = 0;
    std::uint8_t bit = 0;
  };

  // What can be nearest in a box.
  struct Sight {
    Foot foot;
    int side = 0;          // of the centre; 0: not known
    double least = 0;      // distance from anything in the box
    std::vector<const Local*> seen;
  };

  DistanceSurface(const DistanceSurface& whole, std::vector<std::uint32_t> faces, const Box3& box);
  void find_local();
  /// `lows`, if given: per face, what its distance is at least, to rounding; infinite if it is farther than the nearest by `beyond`.
  Foot foot_at(const Vec3& x, double beyond = 0, double* lows = nullptr) const;
  int side_at(const Vec3& x, const Foot& foot) const;
  std::uint8_t mask(std::uint32_t face, const Vec3& center, const Vec3& reach) const;
  Sight look(const Vec3& center, const Vec3& reach) const;
  Sight look_closer(const Sight& sight, const Vec3& center) const;
  /// Those of the features that can be nearest to something in the box. `masks`: per face, filled where `known_mask` is not set.
  void keep_in_sight(Sight& sight, const Vec3& center, const Vec3& reach, std::uint8_t* masks) const;
  Vec3 away(const Local& feature, const Vec3& x) const;
  Interval3 normals(const Local& feature, const Sight& sight, const Vec3& center, const Vec3& reach) const;
  SlopeCap cap(const Local& feature, const Sight& sight, const Vec3& center, const Vec3& reach) const;
  bool unique_feet(const Sight& sight) const;
  bool coplanar(const Sight& sight) const;
  void bend(Expansion& e, const Sight& sight, const std::vector<Interval3>& normals) const;
  bool nearly_flat(const Sight& sight, const Vec3& center, const Vec3& reach) const;
  std::optional<std::size_t> plane_on(std::uint32_t face, const Vec3& center, const Vec3& reach) const;
  SmoothSurfacePtr on_one(const Local& feature) const;
  std::vector<std::vector<std::uint32_t>> sheets() const;
  std::vector<std::vector<std::uint32_t>> convex_sheets() const;
  bool behind(std::uint32_t g, std::uint32_t f) const;
  double rounding_at(const Vec3& x) const;
  int side_of(std::uint32_t face, const Vec3& center, const Vec3& reach) const;

  std::shared_ptr<const MeshFeatures> features_;
  double offset_;
  bool sheet_ = false;                 // distance has no sign: side_ is 1
  int towards_ = 1;                    // of a sheet: on which side of its nearest face the box is, more or less
  int side_ = 0;                       // of the whole box: +1 outside the solid, -1 inside; 0: both or not known
  bool crowded_ = false;               // a smaller box saw hardly fewer faces
  bool split_ = false;                 // a part: other faces may be nearer
  std::vector<std::uint32_t> faces_;   // ascending
  std::size_t front_ = 0;              // of these, one that is near
  Box3 box_;
  std::vector<Local> local_;           // empty: too many
  std::optional<std::size_t> plane_;   // a part that is flat in its box
  bool all_behind_ = false;            // seen from its side, every face is behind all others' planes
};

}  // namespace starcell
