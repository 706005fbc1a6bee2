// F-split's second half: the arcs of a face's squares, joined (as T§5.6.3 refines faces for connectors).
#pragma once

#include <optional>
#include <vector>

#include "subdivision/grid.h"
#include "subdivision/trace.h"

namespace starcell {

/// An arc that ends where another starts goes on in it; what never starts on the rim is a closed curve. None if that does not
/// work out. `joints`: the places where arcs were joined become bends, because E is curved there; else it is straight.
std::optional<std::vector<Arc>> join_arcs(std::vector<Arc> parts, const Grid* joints = nullptr);

}  // namespace starcell
