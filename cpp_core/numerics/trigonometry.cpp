#include "numerics/trigonometry.h"

#include <algorithm>
#include <cmath>

namespace starcell {
namespace {

constexpr double loss = 1e-15;
// Of an angle counted in quarter turns.
constexpr double quarter_loss = 1e-15;

// Between two values of a function that has a maximum or minimum wherever the angle, in quarter turns, is congruent to `top` or `top` + 2 modulo 4.
Interval between(double a, double b, double low_quarter, double high_quarter, double top) {
  const auto passes = [&](double phase) { return std::ceil((low_quarter - phase) / 4) <= std::floor((high_quarter - phase) / 4); };
  return {passes(top + 2) ? -1.0 : std::max(-1.0, std::min(a, b) - loss), passes(top) ? 1.0 : std::min(1.0, std::max(a, b) + loss)};
}

}  // namespace

Turn turn_by(const Interval& angle) {
  const double low = angle.lower(), high = angle.upper();
  if (!(high - low < 6.28)) return {Interval(-1, 1), Interval(-1, 1)};
  const double margin = quarter_loss * (1 + std::max(std::abs(low), std::abs(high)));
  const double low_quarter = low / M_PI_2 - margin, high_quarter = high / M_PI_2 + margin;
  return {between(std::cos(low), std::cos(high), low_quarter, high_quarter, 0), between(std::sin(low), std::sin(high), low_quarter, high_quarter, 1)};
}

}  // namespace starcell
