#include "subdivision/grid_line.h"

#include <gtest/gtest.h>

#include "subdivision/scene.h"
#include "subdivision/voxel_link.h"

namespace starcell {
namespace {

using namespace sample;

/// Parity of the facets below p on the grid line through it.
bool inside_by_parity(const FacetTable& table, int axis, const Vec3& p) {
  bool inside = false;
  for (std::uint32_t f = 0; f < table.size(); ++f)
    if (const int sign = line_meets(table, f, axis, p)) inside ^= crossing_below(table, f, sign, p);
  return inside;
}

TEST(GridLine, ParityIsTheWindingNumberAlongEveryAxis) {
  std::mt19937 random(1);
  for (int i = 0; i < 5; ++i) {
    const Mesh mesh = stone(random);
    const FacetTable table = gather_facets({make(mesh)}, 1e-9);
    std::uniform_real_distribution<double> x(0, 32);
    for (int k = 0; k < 150; ++k) {
      const Vec3 p(x(random), x(random), x(random));
      const double turns = winding(mesh, p);
      ASSERT_LT(std::abs(turns - std::round(turns)), 1e-6) << "a random point is not on the surface";
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(inside_by_parity(table, axis, p), turns > 0.5) << p.transpose();
    }
  }
}

// Grid points on the box's corners, edges and sides act as if moved up infinitesimally: lower sides inside, upper outside.
// The box's diagonals run through grid lines as well.
TEST(GridLine, ParityIsRightWhereEveryLineGrazes) {
  const FacetTable table = gather_facets({make(box({1, 1, 1}, {4, 4, 4}))}, 1e-9);
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y)
      for (int z = 0; z < 6; ++z) {
        const bool in = std::min({x, y, z}) >= 1 && std::max({x, y, z}) < 4;
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_EQ(inside_by_parity(table, axis, Vec3(x, y, z)), in) << x << y << z << " axis " << axis;
      }
}

// An octahedron with all its vertices, edges and diagonals on grid lines and planes; membership is |x| + |y| + |z| against 4
// after moving the point by (e1, e2, e3).
TEST(GridLine, ParityIsRightOnAnOctahedronOfTheGrid) {
  const FacetTable table = gather_facets({make(star_shape(0, [](const Vec3&) { return 4.0; }))}, 1e-9);
  const double e1 = 1e-3, e2 = 1e-6, e3 = 1e-9;
  for (int x = -5; x <= 5; ++x)
    for (int y = -5; y <= 5; ++y)
      for (int z = -5; z <= 5; ++z) {
        const bool in = std::abs(x + e1) + std::abs(y + e2) + std::abs(z + e3) < 4;
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_EQ(inside_by_parity(table, axis, Vec3(x, y, z)), in) << x << ' ' << y << ' ' << z << " axis " << axis;
      }
}

// A segment is crossed once more for every change of side: parities at its ends differ by its crossings.
TEST(GridLine, SegmentCrossingsAreWhatChangesBetweenTheirEnds) {
  std::mt19937 random(2);
  const Mesh mesh = stone(random, 2, 8);
  const FacetTable table = gather_facets({make(mesh)}, 1e-9);
  std::uniform_int_distribution<int> x(0, 32);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p(x(random), x(random), x(random));
    const int axis = k % 3;
    Vec3 q = p;
    q[axis] = x(random);
    bool flips = false, back = false;
    for (std::uint32_t f = 0; f < table.size(); ++f) {
      flips ^= segment_crosses(table, f, axis, p, q[axis]);
      back ^= segment_crosses(table, f, axis, q, p[axis]);
    }
    EXPECT_EQ(flips, inside_by_parity(table, axis, p) != inside_by_parity(table, axis, q));
    EXPECT_EQ(back, flips) << "the same from both ends";
  }
}

// Clipping is plain double arithmetic: right for boxes a millionth smaller and larger, and the exact answer lies between.
TEST(GridLine, ABoxMeetsTheFacetsThatClippingLeavesSomethingOf) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(0, 16);
  std::uniform_int_distribution<int> size(1, 4);
  int met = 0, missed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Mesh mesh{{{x(random), x(random), x(random)}, {x(random), x(random), x(random)}, {x(random), x(random), x(random)}, {20, 20, 20}},
                    {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
    const FacetTable table = gather_facets({make(mesh)}, 1e-9);
    const Vec3 lower(std::floor(x(random)), std::floor(x(random)), std::floor(x(random)));
    const Box3 box(lower, lower + Vec3::Constant(1 << size(random)));
    const Vec3 margin = Vec3::Constant(1e-6);
    const bool meets = box_meets_facet(table, 0, box);
    EXPECT_TRUE(meets || clip_facet(table, 0, Box3(box.min() + margin, box.max() - margin)).empty()) << i;
    EXPECT_TRUE(!meets || !clip_facet(table, 0, Box3(box.min() - margin, box.max() + margin)).empty()) << i;
    (meets ? met : missed)++;
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(missed, 500);
}

TEST(GridLine, ASegmentMeetsABoxLikeItsMiddlePointsDo) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(-2, 3);
  const Box3 box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p(x(random), x(random), x(random)), q(x(random), x(random), x(random));
    double from = 0, to = 1;  // the part of the segment inside the slabs
    for (int k = 0; k < 3; ++k) {
      const double a = (0 - p[k]) / (q[k] - p[k]), b = (1 - p[k]) / (q[k] - p[k]);
      from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
    }
    if (std::abs(to - from) < 1e-9) continue;
    EXPECT_EQ(box_meets_segment(p, q, box), from < to);
    EXPECT_EQ(box_meets_segment(p, q, box), box_meets_segment(q, p, box));
  }
}

}  // namespace
}  // namespace starcell
