// The predicates against determinants of integers, which __int128 holds without rounding.
#include "numerics/predicates.h"

#include <gtest/gtest.h>

#include <random>

namespace starcell {
namespace {

using Wide = __int128;
using Int3 = std::array<std::int64_t, 3>;

int sign(Wide x) { return (x > 0) - (x < 0); }
Vec3 point(const Int3& p, double scale = 1.0) { return Vec3(double(p[0]), double(p[1]), double(p[2])) * scale; }
Vec2 flat(const Int3& p) { return {double(p[0]), double(p[1])}; }

Wide turn_of(const Int3& p, const Int3& q, const Int3& r, int x = 0, int y = 1) {
  return Wide(q[x] - p[x]) * (r[y] - p[y]) - Wide(q[y] - p[y]) * (r[x] - p[x]);
}

Wide side_of(const Int3& p, const Int3& q, const Int3& r, const Int3& s) {
  Wide sum = 0;
  for (int k = 0; k < 3; ++k) sum += turn_of(p, q, r, (k + 1) % 3, (k + 2) % 3) * (s[k] - p[k]);
  return sum;
}

struct Integers {
  std::mt19937_64 random{7};
  std::int64_t upto(std::int64_t n) { return std::uniform_int_distribution<std::int64_t>(-n, n)(random); }
  Int3 near(const Int3& c, std::int64_t n) { return {c[0] + upto(n), c[1] + upto(n), c[2] + upto(n)}; }
};

// Points of a small lattice far from the origin are collinear and coplanar every so often, and nearly so all the time.
// Below 2^36 a side determinant stays below 2^113.
TEST(Predicates, SignsAreThoseOfIntegerDeterminants) {
  Integers in;
  int zeros = 0;
  for (const std::int64_t spread : {std::int64_t{2}, std::int64_t{50}, std::int64_t{1} << 20, std::int64_t{1} << 35})
    for (int i = 0; i < 2000; ++i) {
      const Int3 centre = in.near({}, std::int64_t{1} << 34);
      const Int3 p = in.near(centre, spread), q = in.near(centre, spread), r = in.near(centre, spread),
                 s = in.near(centre, spread);
      EXPECT_EQ(turn(flat(p), flat(q), flat(r)), sign(turn_of(p, q, r)));
      EXPECT_EQ(side(point(p), point(q), point(r), point(s)), sign(side_of(p, q, r, s)));
      zeros += side_of(p, q, r, s) == 0;
    }
  EXPECT_GT(zeros, 100) << "the lattice of spread 2 was to give coplanar points";
}

// p, q, r span a plane with large integers and s lies on it or one unit off: what doubles alone decide wrongly.
TEST(Predicates, OneUnitOffALargePlaneIsSeen) {
  Integers in;
  for (int i = 0; i < 5000; ++i) {
    const std::int64_t big = std::int64_t{1} << 32;
    const Int3 p = in.near({}, big), u = in.near({}, big), v = in.near({}, big);
    Int3 q, r, s;
    const std::int64_t a = in.upto(3), b = in.upto(3);
    for (int k = 0; k < 3; ++k) q[k] = p[k] + u[k], r[k] = p[k] + v[k], s[k] = p[k] + a * u[k] + b * v[k];
    s[i % 3] += in.upto(1);
    EXPECT_EQ(side(point(p), point(q), point(r), point(s)), sign(side_of(p, q, r, s)));
    EXPECT_EQ(turn(flat(p), flat(q), flat(s)), sign(turn_of(p, q, s)));
  }
}

// Multiplying by a power of two is exact, so signs survive where products would underflow or overflow.
TEST(Predicates, SignsSurviveTinyAndHugeUnits) {
  Integers in;
  for (const int exponent : {-300, -200, 200, 300})
    for (int i = 0; i < 200; ++i) {
      const double unit = std::ldexp(1.0, exponent);
      const Int3 p = in.near({}, 3), q = in.near({}, 3), r = in.near({}, 3), s = in.near({}, 3);
      EXPECT_EQ(side(point(p, unit), point(q, unit), point(r, unit), point(s, unit)), sign(side_of(p, q, r, s)))
          << "unit 2^" << exponent;
    }
}

TEST(Predicates, SwappingTwoPointsFlipsTheSign) {
  Integers in;
  for (int i = 0; i < 1000; ++i) {
    const Int3 p = in.near({}, 4), q = in.near({}, 4), r = in.near({}, 4), s = in.near({}, 4);
    EXPECT_EQ(turn(flat(p), flat(q), flat(r)), -turn(flat(q), flat(p), flat(r)));
    EXPECT_EQ(side(point(p), point(q), point(r), point(s)), -side(point(p), point(q), point(s), point(r)));
  }
}

// The determinants are linear in the grid point, so moving it by e1 >> e2 >> e3 > 0 adds exactly e . gradient. On
// coordinates below 8 every determinant and gradient is below 10^4, and (10^-6, 10^-12, 10^-18) is such a shift.
TEST(Predicates, GridPointsActAsIfMovedByInfinitesimals) {
  Integers in;
  const auto shifted = [](Wide value, Wide x, Wide y, Wide z) {
    const Wide million = 1'000'000;
    return sign(((value * million + x) * million + y) * million + z);
  };
  for (int i = 0; i < 5000; ++i) {
    const Int3 p = in.near({}, 3), q = in.near({}, 3), r = in.near({}, 3), s = in.near({}, 3);
    EXPECT_EQ(side_grid(point(p), point(q), point(r), point(s)),
              shifted(side_of(p, q, r, s), turn_of(p, q, r, 1, 2), turn_of(p, q, r, 2, 0), turn_of(p, q, r, 0, 1)));
    for (int axis = 0; axis < 3; ++axis) {
      const int x = (axis + 1) % 3, y = (axis + 2) % 3;
      std::array<Wide, 3> gradient{};
      gradient[x] = p[y] - q[y], gradient[y] = q[x] - p[x];
      EXPECT_EQ(turn_grid(project(point(p), axis), project(point(q), axis), project(point(r), axis), x, y),
                shifted(turn_of(p, q, r, x, y), gradient[0], gradient[1], gradient[2]))
          << "axis " << axis;
    }
  }
}

// What makes neighbouring facets agree about their common edge: no zero, and the other way round for the other facet.
TEST(Predicates, GridPointsAreNeverOnAnEdgeOrAPlane) {
  Integers in;
  for (int i = 0; i < 5000; ++i) {
    const Int3 p = in.near({}, 2), q = in.near({}, 2), r = in.near({}, 2), s = in.near({}, 2);
    if (p[0] != q[0] || p[1] != q[1]) {
      const int t = turn_grid(flat(p), flat(q), flat(r), 0, 1);
      EXPECT_NE(t, 0);
      EXPECT_EQ(t, -turn_grid(flat(q), flat(p), flat(r), 0, 1));
    }
    const bool spans = turn_of(p, q, r, 0, 1) != 0 || turn_of(p, q, r, 1, 2) != 0 || turn_of(p, q, r, 2, 0) != 0;
    const int n = side_grid(point(p), point(q), point(r), point(s));
    EXPECT_EQ(n != 0, spans);
    EXPECT_EQ(n, -side_grid(point(q), point(p), point(r), point(s)));
  }
}

}  // namespace
}  // namespace starcell
