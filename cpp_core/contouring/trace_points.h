// Where the vertices on grid edges and faces go, so that the trace stays embedded, also after rounding to float32.
//
// Crossings keep E's order along every grid line with gaps of a few float32 units between them and from the ends of their
// edges; bends stay inside their faces. Where E itself is that close to a grid vertex the points are moved: A needs E's
// order on edges, not its exact positions (trace theorem), and the move is part of the error bound.
#pragma once

#include <unordered_map>
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

class TracePoints {
 public:
  TracePoints(const Restriction& restriction, const RelaxedCells& relaxed, std::vector<Vec3>& vertices)
      : restriction_(restriction), relaxed_(relaxed), vertices_(vertices) {}

  /// Registers the crossings of an arc on a minimal face; call for all arcs before place().
  void announce(const Arc& arc);
  void place();

  /// The arcs of one minimal face, bends thinned to within `tolerance` (0: all stay). False if they cannot be drawn disjointly.
  bool draw(const Face& face, const std::vector<const Arc*>& arcs, double tolerance, std::vector<TracedArc>& drawn);

  /// How a crossing was moved.
  Vec3 move_of(const Crossing& x) const;

 private:
  std::uint32_t vertex_of(const Crossing& x) const;
  bool disjoint(const Face& face, const std::vector<TracedArc>& arcs, bool rounded) const;
  bool draw_closed(const Face& face, const Arc& arc, TracedArc& drawn);
  void draw_arc(const Face& face, const Arc& arc, const std::vector<std::size_t>& kept, TracedArc& drawn);

  double margin_of(const Face& face) const;

  const Restriction& restriction_;
  const RelaxedCells& relaxed_;
  std::vector<Vec3>& vertices_;
  std::vector<Crossing> crossings_;      // sorted, unique, after place()
  std::vector<double> moved_;            // along their lines
};

}  // namespace starcell
