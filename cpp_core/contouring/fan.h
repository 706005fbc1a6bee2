// The fan that replaces one sheet of E in its cell, and the proof of how near it is.
//
// Rests on DESIGN §3 (contouring) and the lemmas of subdivision/sheet_shape.h. A fan from a point strictly inside a
// convex cell over a simple loop on its boundary is embedded: from that point the boundary is seen one to one.
#pragma once

#include "contouring/surface_mesh.h"
#include "subdivision/graph_shape.h"
#include "subdivision/leaf.h"

namespace starcell {

/// The loop as A has it, counter-clockwise about E's outward normal.
struct DrawnLoop {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> surfaces;   ///< surfaces[k]: plane of the segment from vertex k to k+1, or no_surface
  std::vector<CornerName> names;         ///< names[k]: what vertex k is to V-planes; zeros: a point that it does not know
  Vec3 shift = Vec3::Zero();             ///< how its crossings were moved, on average: to keep sheets apart
  double gap = 0;                        ///< Fréchet distance to E's loop, but for its sway
  std::vector<Sway> sways;               ///< per segment
};

struct Fan {
  Vec3 apex;
  double bound = 0;      ///< two-sided Hausdorff distance to the sheet
  bool on_planes = false;  ///< the triangle over a segment lies on the segment's plane
};

/// `error`: a bound within it will do; `margin`: how far inside the cell the apex must stay; `pull`: how far a contact's apex is moved off it.
Fan make_fan(const FacetTable& table, const Box3& cell, const Sheet& sheet, const DrawnLoop& loop,
             const std::vector<Vec3>& vertices, double error, double margin, double pull);

}  // namespace starcell
