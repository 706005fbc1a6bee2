#include "contouring/contour.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace starcell {
namespace {

// Leaves are worked on in parallel, this many between two looks at the outside world.
constexpr std::size_t leaves_at_once = 512;

}  // namespace

template <class Work>
void Contouring::for_leaves(Work work) {
  for (std::size_t first = 0; first < leaves_.size(); first += leaves_at_once) {
    if (settings_.poll) settings_.poll();
    tbb::parallel_for(first, std::min(first + leaves_at_once, leaves_.size()), work);
  }
}

// New leaves come after all known ones; the numbers of leaves that were refined are not used again.
void Contouring::number_leaves() {
  leaves_ = tree_.leaves();
  for (Leaf* leaf : leaves_)
    if (leaf->number == UINT32_MAX) leaf->number = numbered_++;
  drawn_.resize(6 * std::size_t{numbered_});
  pieces_.resize(numbered_);
}

std::vector<Cell> Contouring::round() {
  number_leaves();
  std::vector<std::vector<MinimalFace>> around(leaves_.size());
  for_leaves([&](std::size_t k) { around[k] = minimal_faces(tree_, *leaves_[k]); });
  for_leaves([&](std::size_t k) { forget_doubled_arcs(*leaves_[k], around[k]); });
  draw_faces(around);
  for_leaves([&](std::size_t k) { fill(*leaves_[k], around[k]); });
  std::vector<Cell> failed;
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const bool drawn = std::all_of(around[k].begin(), around[k].end(), [&](const MinimalFace& f) { return drawn_[slot(f)]->traced.drawn; });
    if (!drawn || !pieces_[leaves_[k]->number].piece.good) failed.push_back(leaves_[k]->problem.cell);
  }
  std::sort(failed.begin(), failed.end(), [](const Cell& a, const Cell& b) { return a.lower < b.lower; });
  return failed;
}

// The same arcs stand in both neighbours. Whoever does not own a face never will: when the owner is refined its children
// are the finer ones.
void Contouring::forget_doubled_arcs(Leaf& leaf, const std::vector<MinimalFace>& around) {
  for (int side = 0; side < 6; ++side)
    if (std::none_of(around.begin(), around.end(), [&](const MinimalFace& f) { return f.owner == &leaf && f.owner_side == side; }))
      leaf.arcs[side] = {};
}

// A face that was drawn in an earlier round stays as it is unless a crossing on it has been moved or its mode has changed.
void Contouring::draw_faces(const std::vector<std::vector<MinimalFace>>& around) {
  std::vector<const MinimalFace*> faces;   // each once
  for (auto& drawn : drawn_)
    if (drawn) drawn->fresh = false;
  std::vector<char> seen(drawn_.size(), 0);
  for (const auto& some : around)
    for (const MinimalFace& f : some) {
      if (seen[slot(f)]) continue;
      seen[slot(f)] = 1;
      faces.push_back(&f);
      for (const Arc& arc : f.arcs()) points_.announce(arc);
    }
  points_.place();
  const double thinned = std::isinf(settings_.error) ? 1e300 : 0.2 * settings_.error;
  for (std::size_t first = 0; first < faces.size(); first += 2 * leaves_at_once) {
    if (settings_.poll) settings_.poll();
    const std::size_t last = std::min(first + 2 * leaves_at_once, faces.size());
    tbb::parallel_for(first, last, [&](std::size_t k) {
      const MinimalFace& f = *faces[k];
      std::unique_ptr<Drawn>& drawn = drawn_[slot(f)];
      const bool relaxed = relaxed_.touch(f.face());
      if (drawn && drawn->every_bend == f.every_bend && drawn->relaxed == relaxed &&
          std::none_of(drawn->traced.arcs.begin(), drawn->traced.arcs.end(), [&](const TracedArc& arc) { return points_.moved(arc); }))
        return;
      drawn = std::make_unique<Drawn>(Drawn{points_.draw(f.face(), f.arcs(), f.every_bend ? 0 : thinned), f.every_bend, relaxed, true});
    });
    for (std::size_t k = first; k < last; ++k)
      if (Drawn& drawn = *drawn_[slot(*faces[k])]; drawn.fresh) points_.adopt(drawn.traced);
  }
}

void Contouring::fill(const Leaf& leaf, const std::vector<MinimalFace>& around) {
  Piece& piece = pieces_[leaf.number];
  const Cell& cell = leaf.problem.cell;
  const bool relaxed = relaxed_.touch(cell);
  const bool same = std::none_of(around.begin(), around.end(), [&](const MinimalFace& f) { return drawn_[slot(f)]->fresh; });
  if (piece.known && piece.relaxed == relaxed && piece.faces == around.size() && same) return;
  std::vector<DrawnFace> faces;
  faces.reserve(around.size());
  for (const MinimalFace& f : around) faces.push_back({f, &drawn_[slot(f)]->traced});
  const Grid& grid = restriction_.grid();
  const PieceSettings settings{settings_.error, relaxed ? grid.least_gap() : grid.margin(cell.size), settings_.pull,
                               grid.holds_floats(cell.size) && !relaxed};
  piece = {make_piece(restriction_, leaf, faces, points_, settings), around.size(), relaxed, true};
}

Contour Contouring::take() {
  Contour result;
  SurfaceMesh& mesh = result.mesh;
  std::vector<std::uint32_t> id(points_.vertices().size(), UINT32_MAX);
  drawn_.clear();
  for (const Leaf* leaf : leaves_) {
    const CellPiece piece = std::move(pieces_[leaf->number].piece);
    result.bound = std::max(result.bound, piece.bound);
    for (const std::uint32_t v : piece.rim)
      if (id[v] == UINT32_MAX) {
        id[v] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(points_.vertices()[v]);
      }
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), piece.inner.begin(), piece.inner.end());
    const auto count = static_cast<std::uint32_t>(piece.rim.size());
    for (const Triangle& t : piece.triangles) {
      Triangle& made = mesh.triangles.emplace_back();
      for (int k = 0; k < 3; ++k) made[k] = t[k] < count ? id[piece.rim[t[k]]] : base + t[k] - count;
    }
    mesh.surface.insert(mesh.surface.end(), piece.surface.begin(), piece.surface.end());
  }
  return result;
}

}  // namespace starcell
