#include "subdivision/complex_cell.h"

#include <algorithm>
#include <map>

#include "subdivision/face_pieces.h"
#include "subdivision/guard.h"
#include "subdivision/voxel_link.h"

namespace starcell {
namespace {

// Facets that can bound E, turned outwards; none if a solid's contribution is not that of a single sign.
std::optional<std::vector<OrientedFacet>> boundary_facets(const Restriction& restriction, const CellProblem& problem,
                                                          const Box3& box) {
  std::vector<Group> groups = link_groups(restriction, problem, box);
  std::vector<OrientedFacet> facets;
  if (!groups_may_cross(restriction, problem, box)) {
    if (!classify_groups(restriction, problem, box, groups)) return std::nullopt;
    for (const Group& g : groups)
      if (g.contributes)
        for (const std::uint32_t f : g.facets) facets.push_back({f, g.flip});
    return facets;
  }
  for (std::size_t slot = 0; slot < problem.slots(); ++slot) {
    // A solid's sign: does adding it ever add to E, or take from it, for any membership of the others?
    bool adds = false, takes = false;
    if (problem.slots() > 10) return std::nullopt;
    for (Membership m = 0; m < Membership{1} << problem.slots(); ++m) {
      const Membership bit = Membership{1} << slot;
      if (m & bit) continue;
      const bool without = problem.expression.value(m), within = problem.expression.value(m | bit);
      adds = adds || (within && !without);
      takes = takes || (without && !within);
    }
    if (adds && takes) return std::nullopt;
    for (const Group& g : groups)
      if (g.slot == slot && (adds || takes))
        for (const std::uint32_t f : g.facets) facets.push_back({f, takes});
  }
  return facets;
}

bool ambiguous_face(bool s00, bool s10, bool s11, bool s01) { return s00 == s11 && s10 == s01 && s00 != s10; }

}  // namespace

bool satisfies_complex_cell(const Restriction& restriction, const CellProblem& problem, const Leaf& leaf,
                            Statistics& statistics) {
  const Cell& cell = problem.cell;
  std::array<bool, 8> inside;
  for (int c = 0; c < 8; ++c) inside[c] = problem.expression.value(restriction.mask_at(problem, cell.corner(c)));
  const Box3 box = box_of(restriction.grid(), cell);
  const auto facets = boundary_facets(restriction, problem, box);
  if (!facets) return false;
  if (facets->empty()) return true;
  if (std::all_of(inside.begin(), inside.end(), [&](bool s) { return s == inside[0]; })) return false;
  for (int d = 0; d < 4; ++d) {  // a diagonal pair against all others
    bool lone = inside[d] == inside[7 - d];
    for (int c = 0; c < 8; ++c)
      if (c != d && c != 7 - d) lone = lone && inside[c] != inside[d];
    if (lone) return false;
  }
  std::map<std::array<std::uint32_t, 3>, int> crossings;  // per cell edge; each crossing is seen from two faces
  for (int side = 0; side < 6; ++side) {
    const Face face = face_of(cell, side);
    const auto corner = [&](int b, int c) {
      const GridPoint p = face.corner(b, c);
      int index = 0;
      for (int k = 0; k < 3; ++k) index |= (p[k] != cell.lower[k]) << k;
      return inside[index];
    };
    const bool s00 = corner(0, 0), s10 = corner(1, 0), s11 = corner(1, 1), s01 = corner(0, 1);
    if (ambiguous_face(s00, s10, s11, s01)) return false;
    const auto& arcs = leaf.arcs[side];
    if (arcs.empty()) continue;
    if (s00 == s10 && s10 == s11 && s11 == s01) return false;
    for (const Arc& arc : arcs)
      if (arc.closed) return false;
    for (const Arc& arc : arcs)
      for (const Crossing* x : {&arc.start, &arc.end}) ++crossings[{x->axis, x->i, x->j}];
    std::vector<std::uint32_t> here;
    for (const OrientedFacet& f : *facets) here.push_back(f.facet);
    std::sort(here.begin(), here.end());
    std::vector<OrientedFacet> on_face;
    for (const Piece& p : face_pieces(restriction, problem, here, face))
      on_face.push_back(*std::find_if(facets->begin(), facets->end(),
                                      [&](const OrientedFacet& f) { return f.facet == p.facet; }));
    if (!find_guard(restriction.table(), on_face, box, face.axis, restriction.grid().coordinate(face.axis, face.at),
                    statistics))
      return false;
  }
  for (const auto& [edge, n] : crossings)
    if (n > 2) return false;
  return find_guard(restriction.table(), *facets, box, -1, 0, statistics).has_value();
}

}  // namespace starcell
