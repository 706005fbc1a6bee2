// Fans over loops whose vertices had to be moved.
#include "contouring/fan.h"

#include <gtest/gtest.h>

namespace starcell {
namespace {

// A crease along y where z = 0.5 meets a plane that rises by 1 in 10: the roof over a unit cell. One of the two bends where
// the loop changes planes was moved by 1e-4, as happens beside an edge of the cell.
TEST(Fan, AMovedBendDoesNotCostTheCrease) {
  FacetTable table;
  table.surfaces.push_back({Vec3(0, 0, 1), 0.5, 0, false});
  const Vec3 tilted = Vec3(-0.1, 0, 1).normalized();
  table.surfaces.push_back({tilted, tilted.dot(Vec3(0.5, 0, 0.5)), 0, false});
  Sheet sheet;
  sheet.shape = Sheet::Shape::crease;
  sheet.surfaces = {0, 1};
  const std::vector<Vec3> vertices{{0, 0, 0.5}, {0.5, 0, 0.5001}, {1, 0, 0.55}, {1, 1, 0.55}, {0.5, 1, 0.5}, {0, 1, 0.5}};
  DrawnLoop loop;
  loop.vertices = {0, 1, 2, 3, 4, 5};
  loop.surfaces = {no_surface, no_surface, 1, 1, 0, 0};
  loop.gap = 1e-4;
  const Fan fan = make_fan(table, Box3(Vec3::Zero(), Vec3::Ones()), sheet, loop, vertices, 0.1, 1e-6, 0);
  EXPECT_EQ(fan.bound, 1e-4) << "as far as the loop was moved, no farther";
  EXPECT_NEAR((fan.apex - Vec3(0.5, 0.5, 0.5)).norm(), 0, 1e-12);
}

// Two planes at an angle of 1e-13: where they meet is anybody's guess, but not how near the fan is to both.
TEST(Fan, PlanesTooNearlyParallelForALineAreASlab) {
  FacetTable table;
  table.surfaces.push_back({Vec3(0, 0, 1), 0.5, 1e-16, false});
  table.surfaces.push_back({Vec3(1e-13, 0, 1), 0.5 + 3e-13, 1e-16, false});   // their line: x = 3, outside the cell
  Sheet sheet;
  sheet.shape = Sheet::Shape::crease;
  sheet.surfaces = {0, 1};
  const std::vector<Vec3> vertices{{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}};
  DrawnLoop loop;
  loop.vertices = {0, 1, 2, 3};
  loop.surfaces = {0, 1, 1, 0};
  const Fan fan = make_fan(table, Box3(Vec3::Zero(), Vec3::Ones()), sheet, loop, vertices, 0.1, 1e-6, 0);
  EXPECT_GT(fan.bound, 1) << "it may be folded";
  sheet.level = true;
  const Fan level = make_fan(table, Box3(Vec3::Zero(), Vec3::Ones()), sheet, loop, vertices, 0.1, 1e-6, 0);
  EXPECT_LT(level.bound, 1e-11);
  EXPECT_NEAR(level.apex.z(), 0.5, 1e-11);
}

}  // namespace
}  // namespace starcell
