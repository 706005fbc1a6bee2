// F-link: E on a face that only one solid's surface reaches.
//
// Rests on DESIGN §3 (F-link): on the face's plane a polyhedral surface is a set of polylines whose corners are mesh
// edges, so following the mesh's own adjacency gives E∩f exactly, as arcs; a closed polyline is found as a leftover.
#pragma once

#include <optional>

#include "subdivision/face_pieces.h"

namespace starcell {

/// The arcs and closed curves that the pieces form; none if they do not fit together.
/// `flip`: the expression is the complement of the solid here, so the solid side changes.
std::optional<std::vector<Arc>> link_pieces(const Restriction& restriction, const Face& face,
                                            const std::vector<Piece>& pieces, bool flip);

/// Turns an arc around: its other side is solid.
void reverse(Arc& arc);

}  // namespace starcell
