// Where a solid's walls, or the gaps between them, are thinner than a given thickness.
//
// From points all over the surface, rays run along the normal: inward through walls, outward across gaps. One that meets a face looking
// the other way nearer than the thickness is a spoke (the ray method of wall thickness checks). No ball of that diameter that stays on
// its side of the surface touches it where the spoke begins: it would contain more of the normal than the spoke is long. So an erosion
// or an opening by half the thickness loses the wall there, and a closing fills the gap.
// Guarantees: every spoke is real, up to the rounding of doubles. Does not guarantee to find every place: those narrower than `spacing`
// are left out, and walls whose sides differ by 60 degrees or more are edges, which taper off anyway.
#pragma once

#include <functional>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

enum class ThinSide { wall, gap };

/// A segment between two sides of a wall or gap, perpendicular to the one that it starts at.
struct Spoke {
  Vec3 from, to;
  std::uint32_t from_face, to_face;
  double length() const { return (to - from).norm(); }
};

/// Neighbouring spokes.
struct ThinPlace {
  Box3 box;            ///< of all its spokes
  double thickness;    ///< of the shortest one
  std::vector<Spoke> spokes;
};

struct ThinPlaces {
  std::vector<ThinPlace> places;   ///< the thinnest first
  double spacing = 0;              ///< of the surface points that were looked at
};

/// All spokes shorter than `thickness` from points `spacing` apart, in the order of the faces that they start at.
struct Spokes {
  std::vector<Spoke> all;
  double spacing = 0;
};

/// thickness > 0. Facets with a common corner make no wall, and facets of a tessellated solid narrower than its deflection, either way,
/// are left out. `go_on` is asked now and then; CancelledError once it says no.
Spokes find_spokes(const Polyhedron& solid, double thickness, ThinSide side, const std::function<bool()>& go_on = {});

/// Neighbouring spokes together.
ThinPlaces gather(const Spokes& spokes);

/// Both.
ThinPlaces find_thin_places(const Polyhedron& solid, double thickness, ThinSide side, const std::function<bool()>& go_on = {});

}  // namespace starcell
