#include "subdivision/root_box.h"

#include <gtest/gtest.h>

#include "subdivision/scene.h"

namespace starcell {
namespace {

using namespace sample;

// Rounding to float32 must not move a grid coordinate (DESIGN §3); a volatile float cannot be optimised away.
bool is_float(double x) {
  volatile float rounded = static_cast<float>(x);
  return static_cast<double>(rounded) == x;
}

// Boxes of all sizes at all distances from the origin, 10^-30 to 10^30.
TEST(RootBox, EveryMultipleOfTheStepIsAFloat32) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-30, 30), part(-1, 1), thin(0.01, 1), far(-3, 3);
  for (int i = 0; i < 300; ++i) {
    const double size = std::pow(10, exponent(random)), shift = size * std::pow(10, far(random));
    const Vec3 lower = shift * Vec3(part(random), part(random), part(random));
    const Box3 model(lower, lower + size * Vec3(thin(random), thin(random), thin(random)));
    const FacetTable table = gather_facets({make(box(model.min(), model.max()))}, 1e-12 * size);
    const Grid grid = choose_grid(model, table);
    const std::uint64_t side = std::uint64_t{1} << grid.depth;
    const auto units = static_cast<std::uint64_t>(grid.step / grid.unit);
    ASSERT_EQ(static_cast<double>(units) * grid.unit, grid.step);
    std::uniform_int_distribution<std::uint64_t> index(0, side / units);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 50; ++k) EXPECT_TRUE(is_float(grid.coordinate(axis, static_cast<std::uint32_t>(units * index(random))))) << i;
      EXPECT_TRUE(is_float(grid.coordinate(axis, 0)));
      EXPECT_TRUE(is_float(grid.coordinate(axis, static_cast<std::uint32_t>(side))));
      EXPECT_LT(grid.coordinate(axis, 0), model.min()[axis]) << "the solid lies in the root's interior";
      EXPECT_GT(grid.coordinate(axis, static_cast<std::uint32_t>(side)), model.max()[axis]);
    }
  }
}

TEST(RootBox, TheSameInputGivesTheSameGrid) {
  const Mesh mesh = sphere(2, 3.3);
  const FacetTable table = gather_facets({make(mesh)}, 1e-9);
  const Box3 model(Vec3::Constant(-3.3), Vec3::Constant(3.3));
  const Grid a = choose_grid(model, table), b = choose_grid(model, table);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.depth, b.depth);
}

}  // namespace
}  // namespace starcell
