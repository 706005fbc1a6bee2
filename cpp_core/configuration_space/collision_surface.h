// F(q) < 0 where some body's inside meets a fixed polygon's: of all pairs of convex pieces the least of how far apart they are.
//
// Two convex polygons are apart if a side of one has all corners of the other beyond its line (separating axes: Gottschalk, Lin & Manocha
// 1996), so a pair's function is the greatest over sides of the least over corners of contact functions (contact_function.h): crossing and containment are one
// case. A cell has two polygons as few pairs of pieces as it can: their hulls where nothing comes near the pockets (convex_pieces.h), else pieces; and of these the
// sides that may part them, and the corners that may be the nearest there: T§5.4's applicability and a child's features from its parent's.
// What is certain of one sign in the cell does not change F's sign, and goes.
// Guarantees: in its box F has the sign of the whole function everywhere, and is one function: where all pairs are known, what expansions
// say of different boxes fits together, as measuring asks for. Slopes hold those of every contact function that F can be there, so Clarke's
// gradients. Does not guarantee that values far from F = 0 are distances; nor, while pairs are not known, more than signs.
#pragma once

#include <compare>
#include <optional>

#include "configuration_space/contact_function.h"

namespace starcell {

/// A moving body, and what it must not meet.
struct Body {
  MovingFramePtr frame;
  std::shared_ptr<const PieceTree> moving, fixed;
};

class CollisionSurface final : public SmoothSurface {
 public:
  explicit CollisionSurface(std::vector<Body> bodies);

  CollisionSurface(const CollisionSurface&) = delete;
  CollisionSurface& operator=(const CollisionSurface&) = delete;

  Expansion expand(const Vec3& center, const Vec3& reach) const override;
  double value(const Vec3& x, Vec3* gradient) const override;
  SmoothSurfacePtr translated(const Vec3& by) const override;
  SmoothSurfacePtr restricted(const Box3& box) const override;
  std::vector<SmoothSurfacePtr> parts() const override;
  bool least_of_parts() const override { return pairs_.size() != 1; }
  bool nested_parts() const override { return true; }
  bool same_as(const SmoothSurface& other) const override { return compares(other, &ContactFunction::same); }
  bool opposite_of(const SmoothSurface& other) const override;
  bool simple() const override;

 private:
  using Corners = std::vector<ContactFunction>;
  struct Side {
    std::shared_ptr<const Corners> all;
    std::vector<std::uint16_t> kept;
  };
  /// A body's piece and a fixed one. Far from each other by their circles alone, until `sides` are there; known without sides: they meet throughout.
  struct Pair {
    std::uint32_t body, moving, fixed;   ///< nodes of the trees
    bool known = false;
    std::vector<Side> sides;
  };
  /// Two nodes, and the pairs of pieces that stand for them in the box.
  struct Entry {
    std::uint32_t body, moving, fixed;
    std::vector<Pair> pairs;
  };
  bool compares(const SmoothSurface& other, bool (ContactFunction::*as)(const ContactFunction&) const) const;
  struct Place;   // a box, and the frames' functions there

  CollisionSurface(const CollisionSurface& of, const Vec3& shift, std::vector<Entry> entries);
  explicit CollisionSurface(const CollisionSurface& of, Pair alone);
  const PieceNode& moving(const Pair& p) const { return (*bodies_)[p.body].moving->nodes[p.moving]; }
  const PieceNode& fixed(const Pair& p) const { return (*bodies_)[p.body].fixed->nodes[p.fixed]; }
  /// Of which two pieces: `moving_pocket` and `fixed_pocket`, if not `hull`, of that number.
  struct Contenders {
    std::uint32_t body, moving, fixed, moving_pocket = hull, fixed_pocket = hull;
    static constexpr std::uint32_t hull = UINT32_MAX;
    auto operator<=>(const Contenders&) const = default;
  };
  class Sides;   // of any two pieces, all of them; made when they are asked for first
  const ConvexPiece& moving(const Contenders& c) const;
  const ConvexPiece& fixed(const Contenders& c) const;
  static Interval circles(const ConvexPiece& moving, const ConvexPiece& fixed, const Place& at, std::uint32_t body);
  const std::vector<Side>& sides_of(const Contenders& c) const;
  std::vector<Side> make_sides(const Contenders& c) const;
  /// The sides that may part them in the box, each with the corners that may be the nearest; none: they are apart throughout.
  static std::optional<std::vector<Side>> kept_of(const std::vector<Side>& sides, const Place& at, std::uint32_t body);
  bool apart(const Place& at, const Contenders& c) const;
  /// The pairs of pieces that two nodes are in the box.
  void resolve(const Place& at, std::uint32_t body, std::uint32_t moving, std::uint32_t fixed, std::vector<Pair>& found) const;
  void to_leaves(const Place& at, std::uint32_t body, std::uint32_t moving, std::uint32_t fixed, std::vector<Pair>& found) const;
  /// Two pieces beside a seam as one, where nothing comes near what their hull has too much.
  void join_seams(const Place& at, std::uint32_t body, std::vector<Pair>& found) const;
  bool pockets_apart(const Place& at, std::uint32_t body, std::uint32_t moving, std::uint32_t fixed, bool of_moving) const;
  /// `anew`: in a cell, which may do with fewer pairs than the one about it; else the pairs that are known serve.
  std::vector<Entry> resolved(const Place& at, bool anew) const;
  Expansion expand_known(const Place& at) const;
  Expansion expand_circles(const Place& at) const;

  std::shared_ptr<const std::vector<Body>> bodies_;
  std::shared_ptr<Sides> sides_;
  Vec3 shift_;
  std::vector<Entry> entries_;
  std::vector<const Pair*> pairs_;   ///< of all entries
};

}  // namespace starcell
