// From certified leaves to a mesh: every arc of a minimal face is drawn, and every loop of arcs around a leaf filled
// (DESIGN §3, contouring).
//
// Guarantees: closed and manifold, because every arc of a minimal face is used once from each side; within each cell what
// cell_piece.h says. Leaves for which that fails, or whose pieces miss the error, are named; the caller refines or relaxes
// them and asks for another round. A round draws again only what changed, and its mesh is the same as if all were drawn.
#pragma once

#include <functional>

#include "contouring/cell_piece.h"
#include "contouring/relaxed_cells.h"

namespace starcell {

struct ContourSettings {
  double error = 0;
  double pull = 0;
  std::function<void()> poll;   ///< called now and then, from the calling thread; throws to stop
};

struct Contour {
  SurfaceMesh mesh;
  double bound = 0;              ///< H(A, E) over all pieces
};

class Contouring {
 public:
  Contouring(const Restriction& restriction, Octree& tree, ContourSettings settings)
      : restriction_(restriction), tree_(tree), settings_(std::move(settings)), relaxed_(tree.size), points_(restriction, relaxed_) {}

  /// Draws the tree as it now is. The leaves that have to be refined, ascending.
  std::vector<Cell> round();

  /// From the next round on (relaxed_cells.h).
  void relax(const Cell& cell) { relaxed_.add(cell); }
  bool is_relaxed(const Cell& cell) const { return relaxed_.has(cell); }

  /// What the last round drew. Once only: the pieces go as the mesh comes.
  Contour take();

 private:
  struct Drawn {
    TracedFace traced;
    bool every_bend, relaxed;
    bool fresh;   // drawn in this round
  };
  struct Piece {
    CellPiece piece;
    std::size_t faces = 0;
    bool relaxed = false, known = false;
  };

  std::size_t slot(const MinimalFace& f) const { return 6 * std::size_t{f.owner->number} + static_cast<std::size_t>(f.owner_side); }
  void number_leaves();
  static void forget_doubled_arcs(Leaf& leaf, const std::vector<MinimalFace>& around);
  void draw_faces(const std::vector<std::vector<MinimalFace>>& around);
  void fill(const Leaf& leaf, const std::vector<MinimalFace>& around);
  template <class Work>
  void for_leaves(Work work);

  const Restriction& restriction_;
  Octree& tree_;
  ContourSettings settings_;
  RelaxedCells relaxed_;
  TracePoints points_;
  std::vector<Leaf*> leaves_;
  std::uint32_t numbered_ = 0;
  std::vector<std::unique_ptr<Drawn>> drawn_;   // by the owner's number and side
  std::vector<Piece> pieces_;                   // by the leaf's number
};

}  // namespace starcell
