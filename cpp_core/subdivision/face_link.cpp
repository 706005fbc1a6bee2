#include "subdivision/face_link.h"

#include <algorithm>

namespace starcell {

void reverse(Arc& arc) {
  std::swap(arc.start, arc.end);
  std::reverse(arc.bends.begin(), arc.bends.end());
  std::reverse(arc.surfaces.begin(), arc.surfaces.end());
}

std::optional<std::vector<Arc>> link_pieces(const Restriction& restriction, const Face& face,
                                            const std::vector<Piece>& pieces, bool flip) {
  // Pieces are ascending by facet, so a neighbour is found by binary search.
  const auto piece_of = [&](std::uint32_t facet) {
    const auto it = std::lower_bound(pieces.begin(), pieces.end(), facet,
                                     [](const Piece& p, std::uint32_t f) { return p.facet < f; });
    return it != pieces.end() && it->facet == facet ? static_cast<std::size_t>(it - pieces.begin()) : pieces.size();
  };
  std::vector<Arc> arcs;
  std::size_t used = 0;
  for (const Piece& first : pieces) {
    if (first.from.side < 0) continue;
    Arc arc;
    arc.start = first.from.crossing;
    arc.facet = first.facet;
    arc.surfaces.push_back(first.surface);
    const Piece* piece = &first;
    ++used;
    while (piece->to.side < 0) {
      const std::size_t next = piece_of(piece->to.neighbour);
      if (next == pieces.size() || ++used > pieces.size()) return std::nullopt;
      if (pieces[next].surface != piece->surface) {
        arc.bends.push_back(pierce_point(restriction, face, piece->facet, pieces[next].facet));
        arc.surfaces.push_back(pieces[next].surface);
      }
      piece = &pieces[next];
    }
    arc.end = piece->to.crossing;
    if (flip) reverse(arc);
    arcs.push_back(std::move(arc));
  }
  if (used != pieces.size()) return std::nullopt;
  return arcs;
}

}  // namespace starcell
