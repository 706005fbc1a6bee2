#include "subdivision/face_link.h"

#include <algorithm>

namespace starcell {

void reverse(Arc& arc) {
  std::swap(arc.start, arc.end);
  std::reverse(arc.bends.begin(), arc.bends.end());
  std::reverse(arc.surfaces.begin(), arc.surfaces.end() - (arc.closed ? 1 : 0));
}

namespace {

class Linker {
 public:
  Linker(const Restriction& restriction, const Face& face, const std::vector<Piece>& pieces)
      : restriction_(restriction), face_(face), pieces_(pieces), seen_(pieces.size(), 0) {}

  std::optional<std::vector<Arc>> link() {
    std::vector<Arc> arcs;
    // First what starts on the rim; what is left closes up inside the face.
    for (const bool closed : {false, true})
      for (std::size_t first = 0; first < pieces_.size(); ++first) {
        if (seen_[first] || (!closed && pieces_[first].from.side < 0)) continue;
        Arc arc;
        if (!follow(first, closed, arc)) return std::nullopt;
        arcs.push_back(std::move(arc));
      }
    return arcs;
  }

 private:
  // Pieces are ascending by facet, so a neighbour is found by binary search.
  std::size_t piece_of(std::uint32_t facet) const {
    const auto it = std::lower_bound(pieces_.begin(), pieces_.end(), facet,
                                     [](const Piece& p, std::uint32_t f) { return p.facet < f; });
    return it != pieces_.end() && it->facet == facet ? static_cast<std::size_t>(it - pieces_.begin()) : pieces_.size();
  }

  bool follow(std::size_t first, bool closed, Arc& arc) {
    arc.start = pieces_[first].from.crossing;
    arc.facet = pieces_[first].facet;
    arc.surfaces.push_back(pieces_[first].surface);
    std::size_t at = first;
    seen_[at] = 1;
    while (pieces_[at].to.side < 0) {
      const std::size_t next = piece_of(pieces_[at].to.neighbour);
      if (next == pieces_.size()) return false;
      if (pieces_[next].surface != pieces_[at].surface) {
        arc.bends.push_back(pierce_point(restriction_, face_, pieces_[at].facet, pieces_[next].facet));
        arc.surfaces.push_back(pieces_[next].surface);
      }
      if (seen_[next]) return closed && next == first && close(arc);
      at = next;
      seen_[at] = 1;
    }
    arc.end = pieces_[at].to.crossing;
    return !closed;
  }

  const Restriction& restriction_;
  const Face& face_;
  const std::vector<Piece>& pieces_;
  std::vector<char> seen_;
};

}  // namespace

std::optional<std::vector<Arc>> link_pieces(const Restriction& restriction, const Face& face,
                                            const std::vector<Piece>& pieces, bool flip) {
  auto arcs = Linker(restriction, face, pieces).link();
  if (arcs && flip)
    for (Arc& arc : *arcs) reverse(arc);
  return arcs;
}

}  // namespace starcell
