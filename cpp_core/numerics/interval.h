// Intervals with directed rounding: the only arithmetic, beside exact predicates, that a certificate may rest on.
//
// Rests on Boost.Interval, rounding upward throughout: a lower bound is the negative of an upper one. Switching the mode
// at every operation instead was a third of a Boolean's time, and g++ 12 merges the two roundings of one product.
// `Interval` operations are only sound while a Rounding object is alive in the same thread; keep its scope short and call
// nothing else inside it, because it changes the rounding mode of all double arithmetic.
#pragma once

#include <boost/numeric/interval.hpp>

#include "numerics/vector.h"

namespace starcell {

namespace interval_detail {
using Safe = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<
                boost::numeric::interval_lib::save_state<boost::numeric::interval_lib::rounded_transc_opp<double>>,
                boost::numeric::interval_lib::checking_base<double>>>;
}

namespace interval_detail {

using Bare = boost::numeric::interval_lib::unprotect<Safe>::type;

// g++ does not know that Rounding changes what a sum is: it would reuse one from before. A value that passes through here
// is a new one to the compiler, and so is everything computed from it.
inline double opaque(double x) {
#if defined(__x86_64__)
  asm volatile("" : "+x"(x));
#elif defined(__aarch64__)
  asm volatile("" : "+w"(x));
#else
  asm volatile("" : "+m"(x));
#endif
  return x;
}

}  // namespace interval_detail

class Interval : public interval_detail::Bare {
 public:
  Interval(double x = 0.0) : interval_detail::Bare(interval_detail::opaque(x)) {}
  Interval(double lower, double upper) : interval_detail::Bare(lower, upper) {}
  Interval(const interval_detail::Bare& x) : interval_detail::Bare(x) {}
};

/// Alive while interval arithmetic is done; restores the previous rounding mode. Boost's sqrt() and median() set a mode
/// themselves, and leave it so: square_root() and middle() are used instead.
class Rounding {
 public:
  Rounding();
  ~Rounding();
  Rounding(const Rounding&) = delete;
  Rounding& operator=(const Rounding&) = delete;

 private:
  unsigned before_;
};

/// -1, +1, or 0 for "don't know".
inline int certain_sign(const Interval& x) { return x.lower() > 0 ? 1 : x.upper() < 0 ? -1 : 0; }

/// A point of the interval. (Boost's median() changes the rounding mode and leaves it so.)
inline double middle(const Interval& x) { return 0.5 * x.lower() + 0.5 * x.upper(); }

struct Interval3 {
  Interval x, y, z;
  Vec3 middle() const { return {starcell::middle(x), starcell::middle(y), starcell::middle(z)}; }
  const Interval& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

}  // namespace starcell
