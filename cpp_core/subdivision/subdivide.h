// The driver: cells are accepted, or split and their problems handed down (T§3.5.3, Alg. 1), in parallel.
//
// Guarantees: what is accepted does not depend on the number of threads, only a budget's end does. A run that is told to
// stop stops within a few cells. Every cell that a budget leaves open becomes an unresolved leaf.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>

#include "subdivision/acceptance.h"
#include "subdivision/octree.h"

namespace starcell {

struct SubdivisionLimits {
  int max_level = 0;
  std::size_t max_cells = 0;
  std::size_t max_bytes = 0;
  double max_seconds = 0;
  std::uint32_t deep_size = 0;      ///< cells below this size are deep: where generic inputs need few
  std::size_t max_deep = 50000;     ///< more of them are a contact along a line or a face: no deeper cell is split
};

/// Reports progress and learns about cancellation, at most every few milliseconds, from one thread at a time.
class Reporter {
 public:
  Reporter(const Progress& progress, std::string stage, double from, double to)
      : progress_(progress), stage_(std::move(stage)), from_(from), to_(to) {}
  /// Adds to the share done (all shares sum to 1); false once the run is cancelled.
  bool advance(double share);
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  const Progress& progress_;
  std::string stage_;
  double from_, to_;
  std::mutex mutex_;
  std::atomic<double> done_{0};
  std::atomic<bool> cancelled_{false};
  double reported_ = 0;
  std::chrono::steady_clock::time_point last_{};
};

class Subdivision {
 public:
  Subdivision(const Restriction& restriction, const AcceptanceSettings& settings, const SubdivisionLimits& limits,
              Statistics& statistics, Reporter& reporter)
      : restriction_(restriction), acceptance_(restriction, settings, statistics), limits_(limits),
        statistics_(statistics), reporter_(reporter), start_(std::chrono::steady_clock::now()) {}

  /// Builds the tree below the root problem. Throws CancelledError.
  Octree build(CellProblem root);

  /// Splits a leaf that turned out not to serve (its fans would meet, or the bound is missed) and refines below it.
  /// False if it is as small as cells may be: the leaf is then unresolved.
  bool refine(Octree& tree, const Cell& cell);

  /// Has a budget (not the depth) run out?
  bool exhausted() const;

 private:
  void visit(OctreeNode& node, CellProblem problem, bool must_split);
  bool too_deep(const Cell& cell) const;

  const Restriction& restriction_;
  Acceptance acceptance_;
  SubdivisionLimits limits_;
  Statistics& statistics_;
  Reporter& reporter_;
  std::chrono::steady_clock::time_point start_;
  std::atomic<std::size_t> bytes_{0}, deep_{0};
};

}  // namespace starcell
