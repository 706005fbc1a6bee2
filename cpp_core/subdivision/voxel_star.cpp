#include "subdivision/voxel_star.h"

#include <algorithm>

#include "subdivision/guard.h"

namespace starcell {
namespace {

// +1: a solid's outward normals are E's, -1: turned, 0: both occur.
std::vector<int> polarities(const LocalExpression& expression) {
  using Op = LocalExpression::Op;
  std::vector<int> polarity(expression.solids().size(), 2);
  // Values carry the slots below them; a complement turns them all.
  std::vector<std::vector<std::pair<std::uint32_t, int>>> stack;
  for (const auto& step : expression.program()) {
    if (step.op == Op::leaf) {
      stack.push_back({{step.count, 1}});
    } else if (step.op == Op::complement) {
      for (auto& [slot, sign] : stack.back()) sign = -sign;
    } else {
      std::vector<std::pair<std::uint32_t, int>> all;
      for (std::uint32_t k = 0; k < step.count; ++k) {
        all.insert(all.end(), stack.back().begin(), stack.back().end());
        stack.pop_back();
      }
      stack.push_back(std::move(all));
    }
  }
  if (stack.empty()) return polarity;
  for (const auto& [slot, sign] : stack.back()) polarity[slot] = polarity[slot] == 2 || polarity[slot] == sign ? sign : 0;
  return polarity;
}

}  // namespace

std::optional<Vec3> star_direction(const Restriction& restriction, const CellProblem& problem, Statistics& statistics) {
  const std::vector<int> polarity = polarities(problem.expression);
  std::vector<OrientedFacet> facets;
  for (const std::uint32_t f : problem.facets) {
    const int p = polarity[restriction.slot_of(problem, f)];
    if (p == 0) return std::nullopt;
    // Facets in contact bound E together or not at all; only V-planes can tell.
    if (restriction.table().surfaces[restriction.table().surface[f]].shared) return std::nullopt;
    facets.push_back({f, p < 0});
  }
  return find_direction(restriction.table(), facets, -1, statistics);
}

bool all_outer(const std::vector<const Loop*>& loops, const Vec3& direction) {
  if (loops.size() <= 1) return true;
  return std::all_of(loops.begin(), loops.end(), [&](const Loop* loop) {
    bool faces_u = false, faces_away = false;
    for (const LoopArc& a : *loop) {
      const double towards = direction[a.side / 2] * (a.side % 2 ? 1 : -1);
      faces_u = faces_u || towards > 0;
      faces_away = faces_away || towards < 0;
    }
    return faces_u && faces_away;
  });
}

std::optional<std::vector<std::vector<Crossing>>> star_loops(const Leaf& leaf, const Vec3& direction) {
  const auto loops = leaf_loops(leaf);
  if (!loops) return std::nullopt;
  std::vector<const Loop*> all;
  std::vector<std::vector<Crossing>> result;
  for (const Loop& loop : *loops) all.push_back(&loop), result.push_back(crossings_of(loop));
  if (!all_outer(all, direction)) return std::nullopt;
  return result;
}

}  // namespace starcell
