// V-link: E in a cell whose sheets do not cross each other.
//
// Rests on DESIGN §3 (V-link): the facets that meet the cell, linked through mesh edges that meet the cell, form groups.
// By inclusion and exclusion over facets, edges and vertices clipped to the (convex) cell, a group's Euler characteristic
// is #facets - #edges + #vertices there; connected with characteristic 1 is a disk. Groups of different solids that do
// not cross each other inside the cell each lie where membership in all other solids is constant, so one evaluation
// says whether a group belongs to E (redundant-facet culling, T§4.1.5) and which of its sides is solid.
#pragma once

#include <optional>

#include "subdivision/cell_problem.h"

namespace starcell {

struct Group {
  std::uint32_t slot = 0;
  std::vector<std::uint32_t> facets;   ///< ascending
  int characteristic = 0;
  bool contributes = true;
  bool flip = false;                   ///< E's solid is on the other side than the group's own
};

/// The groups of every solid in the cell.
std::vector<Group> link_groups(const Restriction& restriction, const CellProblem& problem, const Box3& box);

/// Could two facets of different solids touch each other inside the cell? Conservative: true when unsure.
bool groups_may_cross(const Restriction& restriction, const CellProblem& problem, const Box3& box);

/// Fills `contributes` and `flip`; false if some group's surroundings could not be certified.
bool classify_groups(const Restriction& restriction, const CellProblem& problem, const Box3& box,
                     std::vector<Group>& groups);

/// A facet clipped to a box, in plain double arithmetic; empty if nothing is left.
std::vector<Vec3> clip_facet(const FacetTable& table, std::uint32_t facet, const Box3& box);

}  // namespace starcell
