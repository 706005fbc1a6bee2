#include "numerics/interval_algebra.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <random>

namespace starcell {
namespace {

/// A value that the compiler cannot compute with: constants would be folded in round-to-nearest.
double hidden(double x) {
  volatile double y = x;
  return y;
}

// The sum of the doubles 0.1 and 0.2 lies between two doubles; a long double holds it exactly.
TEST(Interval, EnclosesASumThatNoDoubleIs) {
  const Rounding rounding;
  const double a = hidden(0.1), b = hidden(0.2);
  const Interval sum = Interval(a) + Interval(b);
  const long double exact = static_cast<long double>(a) + static_cast<long double>(b);
  EXPECT_LT(sum.lower(), exact);
  EXPECT_GT(sum.upper(), exact);
}

// 10^16 + 1 is odd, and doubles near 10^16 are even.
TEST(Interval, EnclosesAnIntegerBetweenTwoDoubles) {
  const Rounding rounding;
  const double big = hidden(1e16), one = hidden(1);
  const Interval sum = Interval(big) + Interval(one);
  EXPECT_EQ(sum.lower(), 1e16);
  EXPECT_EQ(sum.upper(), 1e16 + 2);
}

// 1e16 + 1 - 1e16 is 1; rounding to nearest would give 0 and an interval that misses it.
TEST(Interval, CancellationKeepsTheTruthInside) {
  const Rounding rounding;
  const double big = hidden(1e16), one = hidden(1);
  const Interval difference = Interval(big) + Interval(one) - Interval(big);
  EXPECT_LE(difference.lower(), 1);
  EXPECT_GE(difference.upper(), 1);
  EXPECT_EQ(certain_sign(difference), 0) << "0 is in the interval, so the sign is not known";
}

// Products of 26-bit integers and sums of a few are exact in 64 bits, scaled by 2^-30 they are not integers but dyadic.
TEST(Interval, EnclosesDeterminantsOfIntegers) {
  const Rounding rounding;
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::int64_t> digit(-(1 << 30), 1 << 30);
  for (int i = 0; i < 2000; ++i) {
    const std::int64_t a = digit(random), b = digit(random), c = digit(random), d = digit(random);
    const Interval det = Interval(double(a)) * Interval(double(d)) - Interval(double(b)) * Interval(double(c));
    const long double exact = static_cast<long double>(a * d - b * c);  // |.| < 2^61 fits 64 bits
    EXPECT_LE(det.lower(), exact);
    EXPECT_GE(det.upper(), exact);
  }
}

// The compiler takes two equal sums for one value, whatever the rounding mode in between, unless something hides them from
// it: 10^16 + 1 rounded to nearest is 10^16, which is no upper bound.
TEST(Interval, ASumKnownFromBeforeIsRoundedAnew) {
  const double big = hidden(1e16), one = hidden(1);
  const double nearest = big + one;
  EXPECT_EQ(nearest, 1e16);
  {
    const Rounding rounding;
    const Interval sum = Interval(big) + Interval(one);
    EXPECT_EQ(sum.lower(), 1e16);
    EXPECT_EQ(sum.upper(), 1e16 + 2);
  }
  EXPECT_EQ(big + one, nearest);
}

// A product of two 53-bit numbers has 106 bits: both bounds equal would mean that one was taken for the other.
TEST(Interval, ProductsThatAreNotExactHaveTwoBounds) {
  const Rounding rounding;
  const Interval product = Interval(hidden(0.1)) * Interval(hidden(0.3));
  EXPECT_LT(product.lower(), product.upper());
}

TEST(Interval, DivisionAndRootEncloseWithoutBeingExact) {
  const Rounding rounding;
  const double one = hidden(1), three = hidden(3), two = hidden(2);
  const Interval third = Interval(one) / Interval(three), root = square_root(Interval(two));
  EXPECT_LT(third.lower(), third.upper());
  EXPECT_TRUE(boost::numeric::in(1.0, third * Interval(three)));
  EXPECT_TRUE(boost::numeric::in(2.0, root * root));
}

TEST(Interval, SignsAreCertainOnlyAwayFromZero) {
  EXPECT_EQ(certain_sign(Interval(1e-300, 1)), 1);
  EXPECT_EQ(certain_sign(Interval(-1, -1e-300)), -1);
  EXPECT_EQ(certain_sign(Interval(0, 1)), 0);
  EXPECT_EQ(certain_sign(Interval(-1, 1)), 0);
}

// Reading a result off is no interval operation: it must be harmless without a Rounding.
TEST(Interval, TheMiddleLeavesTheRoundingModeAlone) {
  const int before = std::fegetround();
  const Interval3 box{Interval(0, 1), Interval(1, 3), Interval(-1, 1)};
  EXPECT_EQ(box.middle(), Vec3(0.5, 2, 0));
  EXPECT_EQ(std::fegetround(), before);
  std::fesetround(before);
}

// The mode is the whole thread's: whatever runs afterwards relies on round-to-nearest.
TEST(Interval, TheRoundingModeIsPutBack) {
  const int before = std::fegetround();
  {
    const Rounding outer;
    {
      const Rounding inner;
      const Interval x = Interval(hidden(1)) / Interval(hidden(3));
      EXPECT_LT(x.lower(), x.upper());
    }
    const Interval y = Interval(hidden(1)) / Interval(hidden(3));
    EXPECT_LT(y.lower(), y.upper()) << "the inner scope must not switch the outer one off";
  }
  EXPECT_EQ(std::fegetround(), before);
  EXPECT_EQ(hidden(0.1) + hidden(0.2), 0.30000000000000004) << "what round-to-nearest gives";
}

}  // namespace
}  // namespace starcell
