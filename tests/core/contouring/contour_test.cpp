// Rounds of contouring: what was drawn before and is kept against everything drawn anew.
#include "contouring/contour.h"

#include <gtest/gtest.h>

#include "operations/results.h"
#include "subdivision/scene.h"
#include "subdivision/subdivide.h"

namespace starcell {
namespace {

using namespace sample;
using Op = LocalExpression::Op;

std::vector<std::array<Vec3, 3>> as_places(const SurfaceMesh& mesh) {
  std::vector<std::array<Vec3, 3>> all;
  for (const Triangle& t : mesh.triangles) all.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  const auto less = [](const Vec3& a, const Vec3& b) { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end()); };
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  });
  return all;
}

// Leaves are refined and relaxed at random between rounds, as evaluate() does with those that failed.
TEST(Contouring, ARoundEqualsDrawingEverything) {
  std::mt19937 random(12);
  for (int run = 0; run < 4; ++run) {
    std::vector<Mesh> meshes{stone(random), stone(random)};
    for (Mesh& m : meshes)
      for (Vec3& p : m.vertices) p *= 512;
    const Scene scene(meshes, run % 2 ? Op::intersection : Op::set_union, 14);
    AcceptanceSettings settings;
    settings.error = 600;
    settings.pull = 1;
    Statistics statistics;
    SubdivisionLimits limits;
    limits.max_level = 12;
    limits.max_cells = 1000000;
    limits.max_seconds = std::numeric_limits<double>::infinity();
    const Progress none;
    Reporter reporter(none, "", 0, 1);
    Subdivision subdivision(scene.restriction, settings, limits, statistics, reporter);
    Octree tree = subdivision.build(scene.restriction.root(scene.expression));
    Contouring rounds(scene.restriction, tree, {settings.error, settings.pull, {}});
    std::vector<Cell> relaxed;
    for (int round = 0; round < 4; ++round) {
      rounds.round();
      const std::vector<Leaf*> leaves = tree.leaves();
      ASSERT_GT(leaves.size(), 50u);
      for (int k = 0; k < 3; ++k) {
        const Cell cell = leaves[random() % leaves.size()]->problem.cell;
        if (k == 0)
          rounds.relax(cell), relaxed.push_back(cell);
        else if (tree.node_of(cell)->leaf)
          subdivision.refine(tree, cell);
      }
    }
    rounds.round();
    const Contour kept = rounds.take();
    ASSERT_GT(kept.mesh.triangles.size(), 100u);

    // The same tree and the same relaxed cells for one that has seen nothing: arcs that were forgotten are traced again.
    Statistics again;
    Subdivision anew(scene.restriction, settings, limits, again, reporter);
    for (Leaf* leaf : tree.leaves()) {
      CellProblem problem = leaf->problem;
      auto made = Acceptance(scene.restriction, settings, again).accept(problem);
      ASSERT_TRUE(made);
      leaf->arcs = made->arcs;
      leaf->number = UINT32_MAX;
    }
    Contouring fresh(scene.restriction, tree, {settings.error, settings.pull, {}});
    for (const Cell& cell : relaxed) fresh.relax(cell);
    fresh.round();
    const Contour drawn = fresh.take();
    EXPECT_EQ(as_places(kept.mesh), as_places(drawn.mesh)) << run;
    EXPECT_DOUBLE_EQ(kept.bound, drawn.bound) << run;
  }
}

}  // namespace
}  // namespace starcell
