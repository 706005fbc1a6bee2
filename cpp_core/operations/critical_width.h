// Offsets at exactly half the width of a wall or gap between parallel planes: the one offset in which two sheets become one.
//
// Round numbers have this: a wall of 2 mm, eroded by 1. The sheets coincide on a whole area, and no cells, however small, tell them
// apart. As any contact it is decided by a move within the contact tolerance: the radius grows by a quarter of it, so that the wall is
// gone, or the gap closed. The solid's provenance says so, and the certificate's verdict is then "contact".
// Guarantees: the solid and distance returned are the ones given, or differ by that move alone, and then say where and how far.
// Does not guarantee to find every such place: walls that are curved, or narrower than the spacing of inspection/thin_places.h.
#pragma once

#include <functional>

#include "solids/polyhedron.h"

namespace starcell {

struct OffsetTask {
  PolyhedronPtr solid;
  double distance;
};

/// Throws CancelledError once `go_on` says no.
OffsetTask off_critical_width(const PolyhedronPtr& solid, double distance, double contact, const std::function<bool()>& go_on);

}  // namespace starcell
