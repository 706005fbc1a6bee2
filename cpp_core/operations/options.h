// What every operation takes beside its operands.
#pragma once

#include <optional>

#include "subdivision/settings.h"

namespace starcell {

struct Options {
  std::optional<double> error;      ///< two-sided Hausdorff bound; none: longest side of the bounding box / 128; inf: topology only
  std::optional<double> contact;    ///< contact tolerance; none: error / 100
  double kept = 0;                  ///< of the error: a share that contouring leaves to what comes after it
  Criterion criterion = Criterion::trace;
  int threads = 0;                  ///< 0: all
  Budget budget;
  Progress progress;
};

}  // namespace starcell
