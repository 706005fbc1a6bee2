// Problems handed down the tree against the same questions asked of the whole model.
#include "subdivision/cell_problem.h"

#include <gtest/gtest.h>

#include "subdivision/scene.h"

namespace starcell {
namespace {

using namespace sample;
using Op = LocalExpression::Op;

bool solid_contains(const Scene& scene, std::uint32_t solid, const Vec3& p) {
  bool inside = false;
  for (std::uint32_t f = scene.table.first[solid]; f < scene.table.first[solid + 1]; ++f)
    if (const int sign = line_meets(scene.table, f, 2, p)) inside ^= crossing_below(scene.table, f, sign, p);
  return inside;
}

/// Checks a problem against the whole table, then its children, and counts the cells.
int check_down(const Scene& scene, const std::vector<Mesh>& meshes, const CellProblem& problem, int levels) {
  const Box3 box = box_of(scene.grid, problem.cell);
  std::vector<std::uint32_t> expected;
  for (const std::uint32_t solid : problem.expression.solids())
    for (std::uint32_t f = scene.table.first[solid]; f < scene.table.first[solid + 1]; ++f)
      if (box_meets_facet(scene.table, f, box)) expected.push_back(f);
  EXPECT_EQ(problem.facets, expected) << "level " << problem.cell.level;
  for (std::size_t slot = 0; slot < problem.slots(); ++slot)
    EXPECT_EQ(bool(problem.at_lower[slot]), solid_contains(scene, problem.expression.solids()[slot], box.min()));
  // The expression that is left has the value of the whole one at every corner.
  for (int corner = 0; corner < 8; ++corner) {
    Membership whole = 0;
    const Vec3 p = scene.grid.point(problem.cell.corner(corner));
    for (std::uint32_t s = 0; s < meshes.size(); ++s) whole |= Membership{solid_contains(scene, s, p)} << s;
    const Membership here = problem.expression.constant() ? 0 : scene.restriction.mask_at(problem, problem.cell.corner(corner));
    EXPECT_EQ(problem.expression.value(here), scene.expression.value(whole)) << "level " << problem.cell.level;
  }
  int cells = 1;
  if (levels > 0 && !problem.expression.constant())
    for (const CellProblem& child : scene.restriction.children(problem)) cells += check_down(scene, meshes, child, levels - 1);
  return cells;
}

TEST(CellProblem, FacetsAndMembershipAreThoseOfTheWholeModel) {
  std::mt19937 random(1);
  for (const Op op : {Op::set_union, Op::intersection}) {
    const std::vector<Mesh> meshes{stone(random), stone(random), stone(random, 1, 6)};
    const Scene scene(meshes, op);
    EXPECT_GT(check_down(scene, meshes, scene.restriction.root(scene.expression), 4), 300);
  }
}

// Boxes on grid coordinates: every facet lies on a cell's side, every edge on a cell's edge.
TEST(CellProblem, FacetsOnTheGridBelongToOneSideOnly) {
  const std::vector<Mesh> meshes{box({8, 8, 8}, {16, 16, 16}), box({12, 12, 16}, {20, 20, 24})};
  const Scene scene(meshes, Op::set_union);
  EXPECT_GT(check_down(scene, meshes, scene.restriction.root(scene.expression), 4), 20);
}

// Far inside a solid nothing is left of a union, far outside of it only the others are.
TEST(CellProblem, SolidsThatDoNotReachACellAreFoldedAway) {
  const Scene scene({box({1, 1, 1}, {15.5, 15.5, 15.5}), box({10.5, 10.5, 10.5}, {30, 30, 30})}, Op::set_union);
  EXPECT_EQ(scene.at({4, 4, 4}, 4).expression.constant(), true);
  EXPECT_EQ(scene.at({20, 0, 0}, 4).expression.constant(), false);
  EXPECT_EQ(scene.at({8, 0, 0}, 8).expression.solids(), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(scene.at({8, 8, 8}, 8).expression.solids(), (std::vector<std::uint32_t>{0, 1}));
}

// The point's own cell decides: membership along a path of grid edges is that along a line from far away.
TEST(CellProblem, MembershipAtGridPointsOfACell) {
  std::mt19937 random(2);
  const std::vector<Mesh> meshes{stone(random), stone(random)};
  const Scene scene(meshes, Op::intersection);
  std::uniform_int_distribution<std::uint32_t> inside(0, 8), octant(0, 3);
  for (int i = 0; i < 200; ++i) {
    const GridPoint lower{8 * octant(random), 8 * octant(random), 8 * octant(random)};
    const CellProblem problem = scene.at(lower, 8);
    if (problem.cell.size != 8 || problem.expression.constant()) continue;
    const GridPoint p{lower[0] + inside(random), lower[1] + inside(random), lower[2] + inside(random)};
    const std::vector<char> membership = scene.restriction.membership_at(problem, p);
    for (std::size_t slot = 0; slot < problem.slots(); ++slot)
      EXPECT_EQ(bool(membership[slot]), solid_contains(scene, problem.expression.solids()[slot], scene.grid.point(p)));
  }
}

}  // namespace
}  // namespace starcell
