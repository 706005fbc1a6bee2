#include "numerics/trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace starcell {
namespace {

TEST(Trigonometry, EnclosesWhatLongDoublesSay) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-20, 20);
  std::exponential_distribution<double> width(1);
  for (int k = 0; k < 20000; ++k) {
    const double low = any(random), high = low + (k % 3 == 0 ? 0 : width(random) * (k % 3));
    Turn t;
    {
      const Rounding rounding;
      t = turn_by(Interval(low, high));
    }
    for (int i = 0; i <= 8; ++i) {
      const long double a = low + (static_cast<long double>(high) - low) * i / 8;
      EXPECT_LE(t.cosine.lower(), std::cos(a));
      EXPECT_GE(t.cosine.upper(), std::cos(a));
      EXPECT_LE(t.sine.lower(), std::sin(a));
      EXPECT_GE(t.sine.upper(), std::sin(a));
    }
    if (low == high) {
      EXPECT_LT(t.cosine.upper() - t.cosine.lower(), 1e-14);
    }
  }
}

}  // namespace
}  // namespace starcell
