// Sums of sines of angles, and planes in the space of angles, as smooth surfaces.
//
// F(q) = sum of amplitude sin(m . q / unit) + slope . q + half_turns pi unit + offset, where q / unit are the angles in radians. Guarantees: second-order
// enclosures, pi enclosed.
#pragma once

#include "solids/smooth_surface.h"

namespace starcell {

struct AngleWave {
  double amplitude;
  Vec3 multiples;      ///< m, whole numbers
  bool operator==(const AngleWave&) const = default;
};

class AngleFunction final : public SmoothSurface {
 public:
  /// `unit`: a power of two.
  AngleFunction(double unit, std::vector<AngleWave> waves, double offset) : unit_(unit), waves_(std::move(waves)), offset_(offset) {}
  AngleFunction(double unit, const Vec3& slope, int half_turns, double offset) : unit_(unit), slope_(slope), half_turns_(half_turns), offset_(offset) {}

  Expansion expand(const Vec3& center, const Vec3& reach) const override;
  SmoothSurfacePtr translated(const Vec3& by) const override;
  bool same_as(const SmoothSurface& other) const override { return constant_difference(other) == 0; }
  std::optional<double> constant_difference(const SmoothSurface& other) const override;

 private:
  double unit_;
  std::vector<AngleWave> waves_;
  Vec3 slope_ = Vec3::Zero(), shift_ = Vec3::Zero();
  int half_turns_ = 0;
  double offset_ = 0;
};

}  // namespace starcell
