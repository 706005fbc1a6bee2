#include "subdivision/loops.h"

#include <algorithm>

namespace starcell {
namespace {

const Crossing& head(const LoopArc& a) { return a.reversed ? a.arc->end : a.arc->start; }
const Crossing& tail(const LoopArc& a) { return a.reversed ? a.arc->start : a.arc->end; }

}  // namespace

std::optional<std::vector<Loop>> form_loops(const std::vector<LoopArc>& arcs) {
  std::vector<std::size_t> by_head;
  for (std::size_t i = 0; i < arcs.size(); ++i)
    if (!arcs[i].arc->closed) by_head.push_back(i);
  std::sort(by_head.begin(), by_head.end(),
            [&](std::size_t x, std::size_t y) { return head(arcs[x]) < head(arcs[y]); });
  for (std::size_t i = 1; i < by_head.size(); ++i)
    if (head(arcs[by_head[i]]) == head(arcs[by_head[i - 1]])) return std::nullopt;
  std::vector<bool> used(arcs.size(), false);
  std::vector<Loop> loops;
  for (std::size_t first = 0; first < arcs.size(); ++first) {
    if (used[first]) continue;
    if (arcs[first].arc->closed) {
      loops.push_back({arcs[first]});
      continue;
    }
    Loop loop;
    std::size_t at = first;
    while (!used[at]) {
      used[at] = true;
      loop.push_back(arcs[at]);
      const auto next = std::lower_bound(by_head.begin(), by_head.end(), tail(arcs[at]),
                                         [&](std::size_t i, const Crossing& x) { return head(arcs[i]) < x; });
      if (next == by_head.end() || !(head(arcs[*next]) == tail(arcs[at]))) return std::nullopt;
      at = *next;
    }
    if (at != first) return std::nullopt;
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::optional<std::vector<Loop>> leaf_loops(const Leaf& leaf) {
  std::vector<LoopArc> arcs;
  for (int side = 0; side < 6; ++side)
    for (const Arc& arc : leaf.arcs[side]) arcs.push_back({&arc, side, side % 2 == 0});
  return form_loops(arcs);
}

std::vector<Crossing> crossings_of(const Loop& loop) {
  std::vector<Crossing> crossings;
  for (const LoopArc& a : loop) {
    if (a.arc->closed) continue;
    crossings.push_back(a.arc->start);
    crossings.push_back(a.arc->end);
  }
  std::sort(crossings.begin(), crossings.end());
  crossings.erase(std::unique(crossings.begin(), crossings.end()), crossings.end());
  return crossings;
}

}  // namespace starcell
