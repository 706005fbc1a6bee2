// The supporting lines of a face: where the planes of its pieces cut it, with certified ends in order around the face.
//
// Ground that F-planes and F-cone stand on. Every sign is certified by interval arithmetic; a line through a corner, or two
// lines through one point of the rim, give no answer.
#pragma once

#include <functional>
#include <optional>

#include "numerics/interval.h"
#include "subdivision/face_pieces.h"
#include "subdivision/local_planes.h"

namespace starcell {

struct FaceProblem {
  const Restriction& restriction;
  const CellProblem& problem;
  const Face& face;
  const std::vector<Piece>& pieces;
  double pull;   ///< how far sheets of E in contact are pulled apart
  const LocalPlanes& planes;

  std::uint32_t surface_of(std::uint32_t facet) const { return planes.of(restriction.table().surface[facet]); }
};

struct FaceLine {
  std::uint32_t surface = 0;
  Interval nb, nc, d;                    ///< nb b + nc c = d, relative to the face's lower corner
  int start_side = -1, end_side = -1;    ///< walked sides; travelling start -> end, the line's negative side is on the left
  Interval start_at, end_at;             ///< coordinate on that side, increasing along the walk
  int start_rank = 0, end_rank = 0;      ///< position around the perimeter
  std::vector<int> others;               ///< lines it crosses inside the face, in order from start to end
  std::vector<Membership> covered;       ///< others.size() + 1 sub-segments: solids that flip there
};

/// An end of a line on the face's rim.
struct LineEnd {
  int side;
  Interval at;
  int line;
  bool start;
};

/// Corner and side numbering, counter-clockwise seen from +axis: corner k is where side k begins.
/// Sides as walked: 0 bottom (c low), 1 right (b high), 2 top (c high), 3 left (b low); here to PieceEnd's numbering.
constexpr std::array<int, 4> side_name{2, 1, 3, 0};

struct FaceLines {
  Vec3 low;                      ///< the face's lower corner
  double size = 0;
  std::vector<FaceLine> lines;   ///< ascending by surface
  std::vector<LineEnd> ends;     ///< in the order of the walk

  int line_of(std::uint32_t surface) const;
  /// A crossing of the face's rim, from an end: that of the facet which crosses there.
  Crossing crossing(const FaceProblem& problem, int line, bool start) const;
  /// Marks the sub-segments that facets cover, coplanar neighbours run together. `boundary` says which boundary between
  /// sub-segments a piece's end on a line is (0: the line's start), or -1. False if the pieces do not fit the lines. Candidates'
  /// pieces are left out.
  bool cover(const FaceProblem& problem, const std::function<int(const FaceLine&, const PieceEnd&)>& boundary);
};

/// Needs no rounding scope. None if some sign is uncertain.
std::optional<FaceLines> face_lines(const FaceProblem& problem);

/// Some facet of the problem on a surface.
std::uint32_t facet_on(const FaceProblem& problem, std::uint32_t surface);

}  // namespace starcell
