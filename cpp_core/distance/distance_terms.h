// What the parts of DistanceSurface share: rounding, the bits of a face's mask, and small operations on intervals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "numerics/interval_algebra.h"

namespace starcell::distance {

constexpr double ulp = 2.3e-16;
constexpr double infinity = std::numeric_limits<double>::infinity();

// Bits of a face's mask: its interior, edge k, corner k.
constexpr std::uint8_t face_bit = 0;
inline std::uint8_t edge_bit(int k) { return static_cast<std::uint8_t>(1 + k); }
inline std::uint8_t corner_bit(int k) { return static_cast<std::uint8_t>(4 + k); }

// Set in a mask that has been computed.
constexpr std::uint8_t known_mask = 0x80;

inline double spread(const Vec3& u, const Vec3& reach) { return u.cwiseAbs().dot(reach); }

inline Interval common(const Interval& a, const Interval& b) {
  const double low = std::max(a.lower(), b.lower()), high = std::min(a.upper(), b.upper());
  return low <= high ? Interval(low, high) : a;
}
inline Interval around(double x, double radius) { return {-(radius - x), x + radius}; }
inline Interval3 around(const Vec3& x, double radius) { return {around(x.x(), radius), around(x.y(), radius), around(x.z(), radius)}; }
inline Interval3 any_direction() { return {Interval(-1, 1), Interval(-1, 1), Interval(-1, 1)}; }

}  // namespace starcell::distance
