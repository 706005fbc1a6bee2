// F-cone: E on a face whose lines all pass through one point.
//
// Where operands touch, more than two planes may meet a face in one point (an edge of one solid in another's side, a
// corner of many facets on a shared plane), and no arrangement of their lines has certified signs. But lines through one
// point cut the face into sectors, whatever their number, and membership in the sectors is read off the face's rim.
// Guarantees: the arcs are E∩f for planes moved by less than their thickness and rounding so that they are concurrent;
// such arcs are marked, and the leaf counts as a contact. Inside sectors join only across a line (DESIGN §4).
#pragma once

#include "subdivision/face_lines.h"

namespace starcell {

/// None if the lines have no common point strictly inside the face, or the order of their ends is uncertain.
std::optional<std::vector<Arc>> cone_pieces(const FaceProblem& problem);

}  // namespace starcell
