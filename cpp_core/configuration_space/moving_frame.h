// Where a rigid body of the plane is, as functions of a configuration: all that contact of its corners and sides with fixed ones depends on.
//
// With the frame's origin t and angle a, a corner p of the body is at t + R p. The six functions are t, (cos a, sin a) and R^T t, the origin as the body
// sees the world's: distances of corners from lines are linear in them, whichever of the two moves (contact_function.h; T, Appendix B, has each kind written out).
// Guarantees: second-order enclosures over boxes of configurations, in the scaled coordinates of the configuration space.
#pragma once

#include <array>
#include <memory>

#include "numerics/interval_algebra.h"
#include "numerics/vector.h"

namespace starcell {

/// A function of the configuration over the box center + [-reach, reach].
struct FrameFunction {
  Interval value;              ///< at the centre
  Interval3 gradient;          ///< there
  Interval3 slope;             ///< the gradient over the box
  IntervalSymmetric hessian;   ///< over the box
};

struct FrameFunctions {
  enum Name { x, y, cosine, sine, seen_x, seen_y };
  std::array<FrameFunction, 6> of;
  Interval angle;              ///< over the box
};

class MovingFrame {
 public:
  virtual ~MovingFrame() = default;
  /// Needs a Rounding object.
  virtual FrameFunctions expand(const Interval3& center, const Vec3& reach) const = 0;
};

using MovingFramePtr = std::shared_ptr<const MovingFrame>;

/// A body that translates and turns: the configuration is (x, y, `unit` theta). `unit`: a power of two, so that scaling loses nothing.
MovingFramePtr free_frame(double unit);

/// A link of a planar arm, whose configuration is `unit` (theta_1, theta_2, theta_3), each angle relative to the link before: the frame of joint `link`
/// as seen from that of joint `from`, an earlier one, or from the world (-1), where the first joint is at `base`. Joints count from 0.
MovingFramePtr link_frame(const std::array<double, 3>& lengths, const std::array<double, 2>& base, double unit, int link, int from);

}  // namespace starcell
