#include "subdivision/subdivide.h"

#include <cmath>

#include <tbb/task_group.h>

#include "solids/errors.h"

namespace starcell {
namespace {

// Problems larger than this are worth a task of their own.
constexpr std::size_t task_facets = 400;
// And all with regions down to here: nothing says how much is below them.
constexpr int task_levels = 5;

std::size_t bytes_of(const Leaf& leaf) {
  std::size_t bytes = sizeof(Leaf) + leaf.problem.facets.capacity() * sizeof(std::uint32_t);
  for (const auto& arcs : leaf.arcs)
    for (const Arc& arc : arcs) bytes += sizeof(Arc) + arc.bends.capacity() * sizeof(Vec3) + 16;
  for (const Sheet& sheet : leaf.sheets) bytes += sizeof(Sheet) + sheet.crossings.capacity() * sizeof(Crossing);
  return bytes;
}

}  // namespace

bool Reporter::advance(double share) {
  double done = done_.load(std::memory_order_relaxed);
  while (!done_.compare_exchange_weak(done, done + share, std::memory_order_relaxed)) {
  }
  if (!progress_ || cancelled()) return !cancelled();
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return !cancelled();
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(20)) return !cancelled();
  last_ = now;
  reported_ = std::max(reported_, from_ + (to_ - from_) * std::min(1.0, done + share));
  if (!progress_(reported_, stage_)) cancelled_ = true;
  return !cancelled();
}

Octree Subdivision::build(CellProblem root) {
  Octree tree;
  tree.size = root.cell.size;
  visit(tree.root, std::move(root), false);
  if (reporter_.cancelled()) throw CancelledError("The run was cancelled.");
  return tree;
}

bool Subdivision::refine(Octree& tree, const Cell& cell) {
  OctreeNode& node = *tree.node_of(cell);
  if (too_deep(cell) || exhausted()) {
    node.leaf->resolved = false;
    return false;
  }
  CellProblem problem = std::move(node.leaf->problem);
  node.leaf.reset();
  visit(node, std::move(problem), true);
  if (reporter_.cancelled()) throw CancelledError("The run was cancelled.");
  return true;
}

bool Subdivision::exhausted() const {
  if (statistics_.cells.load(std::memory_order_relaxed) >= limits_.max_cells) return true;
  if (limits_.max_bytes && bytes_.load(std::memory_order_relaxed) >= limits_.max_bytes) return true;
  if (std::isinf(limits_.max_seconds)) return false;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  return elapsed.count() > limits_.max_seconds;
}

bool Subdivision::too_deep(const Cell& cell) const {
  return cell.level >= limits_.max_level ||
         (cell.size < limits_.deep_size && deep_.load(std::memory_order_relaxed) > limits_.max_deep);
}

void Subdivision::visit(OctreeNode& node, CellProblem problem, bool must_split) {
  const double share = std::pow(0.125, problem.cell.level);
  count(statistics_.cells);
  std::size_t depth = statistics_.max_depth.load(std::memory_order_relaxed);
  while (depth < static_cast<std::size_t>(problem.cell.level) &&
         !statistics_.max_depth.compare_exchange_weak(depth, static_cast<std::size_t>(problem.cell.level))) {
  }
  if (!must_split) {
    if (!reporter_.advance(0)) return;
    if (problem.empty(restriction_.table())) {
      count(statistics_.empty);
      reporter_.advance(share);
      return;
    }
    if (auto leaf = acceptance_.accept(problem)) {
      if (leaf->sheets.empty() && !leaf->contact) {
        count(statistics_.empty);
      } else {
        count(statistics_.leaves);
        bytes_ += bytes_of(*leaf);
        node.leaf = std::make_unique<Leaf>(std::move(*leaf));
      }
      reporter_.advance(share);
      return;
    }
    if (problem.cell.size < limits_.deep_size) deep_.fetch_add(1, std::memory_order_relaxed);
    if (too_deep(problem.cell) || exhausted()) {
      count(statistics_.leaves);
      node.leaf = std::make_unique<Leaf>(acceptance_.give_up(problem));
      reporter_.advance(share);
      return;
    }
  }
  node.children = std::make_unique<std::array<OctreeNode, 8>>();
  std::array<CellProblem, 8> children = restriction_.children(problem);
  const bool parallel = problem.facets.size() > task_facets || (problem.has_regions(restriction_.table()) && problem.cell.level < task_levels);
  problem = CellProblem();
  if (!parallel) {
    for (int i = 0; i < 8; ++i) visit((*node.children)[i], std::move(children[i]), false);
    return;
  }
  tbb::task_group group;
  for (int i = 0; i < 8; ++i)
    group.run([&, i] { visit((*node.children)[i], std::move(children[i]), false); });
  group.wait();
}

}  // namespace starcell
