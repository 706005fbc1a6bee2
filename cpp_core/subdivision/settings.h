// What steers a subdivision: the cell criterion, budgets, and the way out for progress and cancellation.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>

namespace starcell {

/// How cells are accepted: by the trace theorem (DESIGN §3), or by the thesis's own condition (T§3.4), for comparison.
enum class Criterion { trace, complex_cell };

/// Where a run stops and says `unresolved`.
struct Budget {
  int max_depth = 0;                ///< octree levels; 0: as many as float32 coordinates allow
  std::size_t max_cells = 0;        ///< 0: in proportion to the input's facets and to (size / error)^2, 50 million at most
  double max_seconds = std::numeric_limits<double>::infinity();
  std::size_t max_bytes = 0;        ///< estimated memory of the octree; 0: no limit
};

/// Called with the fraction done in [0, 1] and a stage's name, from one thread at a time; false cancels the run.
using Progress = std::function<bool(double fraction, const std::string& stage)>;

}  // namespace starcell
