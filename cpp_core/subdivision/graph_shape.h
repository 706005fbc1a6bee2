// How near a fan, or a polyline, is to a part of E that is a graph along a direction: the error criterion for curved patches.
//
// Rests on the lemma *Lift*. Let E's part in the cell be seen along u (patch_view.h). A triangle T whose vertices' F-values are known
// is, lifted by s along u, beyond patch k as soon as s m >= excess - least F, m the least slope along u in the room that the
// lift sweeps: interpolation of the vertices' values exceeds F by at most `excess` (smooth_surface.h). When the patches that T is
// beyond make the lifted T outside whatever the others say, and the lowered T inside likewise, then E lies within s of T along
// u. It holds for each part of a triangle by itself. Creases and corners need no special case: the patches that matter are found by E's own logic.
// For two-sidedness: points of E whose shadow A's loop leaves out are met by the homotopy between E's loop and A's, both of which
// are within the arcs' sway of each other; heights differ along it by E's steepness there. All this is about E's logic on the
// class's surfaces, which in the cell is E and around it only E's continuation.
// Guarantees: bounds against E in the cell. Does not guarantee that the proposed apex is the best one.
#pragma once

#include <optional>
#include <vector>

#include "subdivision/leaf.h"
#include "subdivision/patch_view.h"

namespace starcell {

/// A bound on the distance along u between E's part of the class and the segment p q, infinite if none is
/// found within the room.
double segment_deviation(const Patches& patches, const PatchClass& c, const Vec3& u, double room, const Vec3& p,
                         const Vec3& q);

/// How E's loop lies about a segment of A's polygon: within `by`, along a direction (zero: any).
struct Sway {
  double by = 0;
  Vec3 along = Vec3::Zero();
};

struct GraphFan {
  Vec3 apex = Vec3::Zero();
  double bound = 0;        ///< of the distance between E's part and the fan
  double flat_bound = 0;   ///< of the triangles' own deviation, without the loop's
};

/// The best of a few fans over the loop, for a sheet of shape `graph`. `sways`: per segment; `gap`: how far the polygon was moved besides.
GraphFan graph_fan(const Box3& cell, const Sheet& sheet, const std::vector<Vec3>& loop,
                   const std::vector<Sway>& sways, double gap, double margin);

/// The sheet of a class that u sees in its cell.
Sheet graph_sheet(const Patches& patches, const PatchClass& c, const Vec3& u, double room);

/// How far around a piece E's graph is looked at; what is farther from it has no bound.
double room_around(double size, double error);

/// A point near `start` on all the given surfaces (three at most), by Newton's method: a proposal.
Vec3 common_place(const std::vector<const Surface*>& surfaces, const Vec3& start, int flat_axis = -1);

}  // namespace starcell
