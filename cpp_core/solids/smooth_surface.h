// Smooth surfaces F = 0, and their second-order enclosures: all that subdivision and contouring ever ask of a curved solid.
//
// Rests on interval arithmetic (T§3.5.1, Moore 1966), taken to second order: near a point c, F(c + d) lies in
// value + gradient . d + d . hessian d / 2 for every d of the box. Sums of such enclosures enclose sums of functions, which is
// what tells two surfaces apart that nearly touch. F is scaled so that its gradient is about 1 near the surface.
// Guarantees: enclosures, for the surface as it was defined; its coefficients are intervals where they had to be rounded.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "numerics/interval_algebra.h"

namespace starcell {

/// All unit vectors within an angle of the axis.
struct SlopeCap {
  Vec3 axis;           ///< of unit length, to rounding
  Interval cosine;     ///< of the angle; not positive: any direction
  Interval sine;
  /// v . u for all v of the cap. Needs a Rounding object.
  Interval along(const Vec3& u) const;
};

/// An enclosure of F over the box c + [-reach, reach]; reach may be 0 along any axis (a face, an edge, a point).
struct Expansion {
  Vec3 reach = Vec3::Zero();
  Interval value;              ///< F(c)
  Interval3 gradient;          ///< of F at c
  IntervalSymmetric hessian;   ///< over the box; of no meaning unless `smooth`
  Interval3 slope;             ///< the gradient over the box; at a kink Clarke's
  std::vector<Interval3> slopes;   ///< if any: it is in the convex hull of these, which `slope` encloses
  std::vector<SlopeCap> caps;      ///< if any: one for each of `slopes`, which lies in it too
  bool smooth = true;          ///< false where F has a kink in the box (the tip of a cone): only `slope` holds
  /// Slope and second derivatives once more, in a frame where they are narrower than along the model's axes: the derivative along
  /// u is framed_slope . frame u, the second one frame u . framed_hessian frame u.
  bool framed = false;
  IntervalMatrix frame;
  Interval3 framed_slope;
  IntervalSymmetric framed_hessian;
  Interval curvature;   ///< encloses framed_hessian's eigenvalues
  /// F - m |x|^2 / 2 is concave in the box for m its upper end, convex for its lower end, smooth or not; infinite: not known.
  Interval bend{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

  Interval bounds{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};   ///< of F over the box, besides what else says it
  double steepest = std::numeric_limits<double>::infinity();   ///< no slope is longer
  /// If not 0: |F + source| is the distance from something, and F bends by its inverse at most, upwards if source > 0, else downwards.
  double source = 0;

  /// F over the box.
  Interval range() const;
  /// The derivative along u over the box.
  Interval along(const Vec3& u) const;
  /// Linear interpolation minus F, on the triangle or segment between points of the box.
  Interval excess(const Vec3& p, const Vec3& q, const Vec3& r) const;
  Interval excess(const Vec3& p, const Vec3& q) const;
  /// The same where F at the corners is known to lie in `values`: distances bend less, the farther off.
  Interval excess(const Vec3& p, const Vec3& q, const Vec3& r, const Interval& values) const;
  Interval excess(const Vec3& p, const Vec3& q, const Interval& values) const;

 private:
  Interval excess(const std::array<Vec3, 3>& edges, double pairs) const;
  Interval excess(const std::array<Vec3, 3>& edges, double pairs, const Interval& values) const;
};

/// An expansion of a F + b G from those of F and G over the same box.
Expansion combine(double a, const Expansion& f, double b, const Expansion& g);

/// What identifies a surface of revolution: two of them coincide if these do.
struct RoundShape {
  enum class Kind { sphere, cylinder, cone, torus } kind;
  Vec3 point;          ///< centre; of a cylinder any point of the axis; of a cone its tip
  Vec3 axis;           ///< of unit length; of a sphere of no meaning; a cone opens against it
  double a = 0;        ///< radius; of a cone the slope d radius / d height
  double b = 0;        ///< of a torus the minor radius
};

/// A plane normal . x = offset, as nearly as doubles have it, and how far what lies on it may be from it.
struct FlatPiece {
  Vec3 normal;
  double offset;
  double thickness;
};

class SmoothSurface {
 public:
  virtual ~SmoothSurface() = default;

  /// Needs a Rounding object.
  virtual Expansion expand(const Vec3& center, const Vec3& reach) const = 0;
  /// The derivative along u over the box, as the expansion has it or narrower. Needs a Rounding object.
  virtual Interval slope_along(const Vec3& center, const Vec3& reach, const Vec3& u) const { return expand(center, reach).along(u); }
  virtual std::shared_ptr<const SmoothSurface> translated(const Vec3& by) const = 0;
  /// The same function in the box, as seen from what is near: a surface made of many pieces drops those that cannot matter there.
  /// Null: this one serves.
  virtual std::shared_ptr<const SmoothSurface> restricted(const Box3&) const { return nullptr; }
  /// In the box it was restricted to: functions the least of which it is (`least_of_parts`) or the greatest; none: it is one piece,
  /// or too many.
  virtual std::vector<std::shared_ptr<const SmoothSurface>> parts() const { return {}; }
  virtual bool least_of_parts() const { return true; }
  /// Have parts themselves parts, and may two of them be one?
  virtual bool nested_parts() const { return false; }
  /// Certainly the same function?
  virtual bool same_as(const SmoothSurface&) const { return false; }
  /// Certainly the same function with the other sign?
  virtual bool opposite_of(const SmoothSurface&) const { return false; }
  /// This one less the other one, if that is certainly the same everywhere: its sign is right, its size to rounding.
  virtual std::optional<double> constant_difference(const SmoothSurface&) const { return std::nullopt; }
  /// The planes on which flat pieces of the surface lie, where it has such pieces.
  virtual std::vector<FlatPiece> planes() const { return {}; }
  /// In the box it was restricted to: which of the whole surface's planes it is, if it is one.
  virtual std::optional<std::size_t> plane() const { return std::nullopt; }
  /// May it be looked at as a patch of a cell? Otherwise the cell has to be smaller.
  virtual bool simple() const { return true; }
  virtual std::optional<RoundShape> round_shape() const { return std::nullopt; }
  /// A lower bound of |grad F| on the surface, certified; 0: not known.
  virtual double least_slope() const { return 0; }

  /// The sign of F at a point, or 0 for "don't know".
  int sign(const Vec3& x) const;
  /// F and its gradient to rounding: proposals, no proof.
  virtual double value(const Vec3& x, Vec3* gradient = nullptr) const;
};

using SmoothSurfacePtr = std::shared_ptr<const SmoothSurface>;

/// A bound of how far apart the two surfaces are inside the box (each from the other), if they can be one at all.
std::optional<double> surface_distance(const SmoothSurface& f, const SmoothSurface& g, const Box3& box);

}  // namespace starcell
