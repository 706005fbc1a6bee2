// Where the vertices on grid edges and faces go, so that the trace stays embedded, also after rounding to float32.
//
// Crossings keep E's order along every grid line with gaps of a few float32 units between them and from the ends of their
// edges; bends stay inside their faces. Where E itself is that close to a grid vertex the points are moved: A needs E's
// order on edges, not its exact positions (trace theorem), and the move is part of the error bound.
#pragma once

#include <cstdint>
#include <vector>

#include "contouring/relaxed_cells.h"
#include "subdivision/cell_problem.h"
#include "subdivision/trace.h"

namespace starcell {

/// An arc as A has it: vertex ids from start to end, of a closed curve back to the start.
struct TracedArc {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> surfaces;   ///< per segment; no_surface where the segment left its plane
  double gap = 0;                        ///< Fréchet distance to E's arc, moves included

  bool closed() const { return vertices.front() == vertices.back(); }
};

/// The arcs of one minimal face, in their order.
struct TracedFace {
  std::vector<TracedArc> arcs;
  std::vector<Vec3> bends;   ///< between draw() and adopt(): vertices that have no id yet
  bool drawn = false;        ///< false: they cannot be drawn disjointly
};

/// Vertices keep their ids from round to round; those that no face uses any more stay as gaps in the numbering.
class TracePoints {
 public:
  TracePoints(const Restriction& restriction, const RelaxedCells& relaxed) : restriction_(restriction), relaxed_(relaxed) {}

  /// Registers the crossings of an arc on a minimal face; each round all arcs before place().
  void announce(const Arc& arc);
  void place();

  /// Draws the arcs of one minimal face, bends thinned to within `tolerance` (0: all stay). Safe to call in parallel.
  TracedFace draw(const Face& face, const std::vector<Arc>& arcs, double tolerance) const;
  /// Gives a drawn face's bends their ids.
  void adopt(TracedFace& face);

  /// Has the last place() put any vertex of the arc elsewhere than it was?
  bool moved(const TracedArc& arc) const;
  /// How a vertex that is a crossing was moved off E's, along its line.
  Vec3 move_of(std::uint32_t crossing) const;

  const std::vector<Vec3>& vertices() const { return vertices_; }

 private:
  struct Placed {
    Crossing crossing;
    std::uint32_t id;
  };
  /// What the last place() did to a vertex; bends never move.
  struct Move {
    double by = 0;
    std::uint8_t axis = 0;
    bool fresh = false;
  };

  void place_line(Crossing* first, Crossing* last, double* moved) const;
  void number(const std::vector<double>& moved);
  std::uint32_t vertex_of(const Crossing& x) const;
  const Vec3& at(const TracedFace& drawn, std::uint32_t id) const;
  bool disjoint(const Face& face, const TracedFace& drawn, bool rounded) const;
  bool draw_arcs(const Face& face, const std::vector<Arc>& arcs, double tolerance, bool coarse, TracedFace& drawn) const;
  bool draw_closed(const Face& face, const Arc& arc, TracedFace& drawn, TracedArc& traced) const;
  void draw_arc(const Face& face, const Arc& arc, const std::vector<std::size_t>& kept, TracedFace& drawn, TracedArc& traced) const;
  double margin_of(const Face& face) const;

  const Restriction& restriction_;
  const RelaxedCells& relaxed_;
  std::vector<Crossing> announced_;
  std::vector<Placed> placed_;           // sorted by crossing
  std::vector<Vec3> vertices_;
  std::vector<Move> moves_;              // per vertex
};

}  // namespace starcell
