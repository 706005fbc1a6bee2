#include "subdivision/face_trace.h"

#include <algorithm>

#include "subdivision/face_cone.h"
#include "subdivision/face_graph.h"
#include "subdivision/face_join.h"
#include "subdivision/face_link.h"
#include "subdivision/face_planes.h"

namespace starcell {
namespace {

constexpr std::size_t max_lines = 14;   // an arrangement of more is dearer than four smaller ones
constexpr int max_splits = 5;

class FaceTracer {
 public:
  FaceTracer(const Restriction& restriction, const CellProblem& problem, const TraceSettings& settings, const LocalPlanes& planes, RimLines& rims,
             Statistics& statistics)
      : restriction_(restriction), problem_(problem), candidates_(problem.candidates(restriction.table())), settings_(settings), planes_(planes),
        rims_(rims), statistics_(statistics) {}

  std::optional<std::vector<Arc>> trace(const std::vector<std::uint32_t>& facets, const Face& face, int splits) {
    const std::vector<Piece> pieces = face_pieces(restriction_, problem_, facets, face);
    if (pieces.empty()) return std::vector<Arc>{};
    const std::uint32_t slot = pieces.front().slot;
    const bool alone = std::all_of(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.slot == slot; });
    if (alone && !(candidates_ >> slot & 1)) return trace_one_solid(face, pieces, slot);
    if (line_count(pieces) <= max_lines) {
      if (auto arcs = arrange_pieces({restriction_, problem_, face, pieces, settings_.pull, planes_})) {
        count(statistics_.face_planes);
        return arcs;
      }
      if (auto arcs = trace_cone(face, pieces)) {
        count(statistics_.face_cone);
        return arcs;
      }
    }
    if (candidates_ != 0)
      if (auto arcs = graph_face(restriction_, problem_, pieces, rims_, face, settings_.error, statistics_)) return arcs;
    if (splits >= max_splits || face.size < 2) return std::nullopt;
    return split(pieces, face, splits);
  }

 private:
  std::size_t line_count(const std::vector<Piece>& pieces) const {
    std::vector<std::uint32_t> surfaces;
    for (const Piece& p : pieces) surfaces.push_back(planes_.of(p.surface));
    std::sort(surfaces.begin(), surfaces.end());
    return static_cast<std::size_t>(std::unique(surfaces.begin(), surfaces.end()) - surfaces.begin());
  }

  // Planes that are nearly one are no concurrent ones: smaller cells tell them apart from what crosses them.
  std::optional<std::vector<Arc>> trace_cone(const Face& face, const std::vector<Piece>& pieces) const {
    if (candidates_ != 0) return std::nullopt;
    std::vector<std::uint32_t> facets;
    for (const Piece& p : pieces) facets.push_back(p.facet);
    const Grid& grid = restriction_.grid();
    const Box3 box(grid.point(face.corner(0, 0)), grid.point(face.corner(1, 1)));
    if (!LocalPlanes(restriction_.table(), facets, box).empty()) return std::nullopt;
    return cone_pieces({restriction_, problem_, face, pieces, settings_.pull, planes_});
  }

  // No other solid's surface reaches the face, so membership in the others is that of any of its corners.
  std::optional<std::vector<Arc>> trace_one_solid(const Face& face, const std::vector<Piece>& pieces,
                                                  std::uint32_t slot) {
    const Membership bit = Membership{1} << slot;
    const Membership others = problem_.slots() > 1 ? restriction_.mask_at(problem_, face.corner(0, 0)) : 0;
    const bool within = problem_.expression.value(others | bit), without = problem_.expression.value(others & ~bit);
    if (within == without) return std::vector<Arc>{};
    auto arcs = link_pieces(restriction_, face, pieces, without);
    if (arcs) count(statistics_.face_link);
    return arcs;
  }

  std::optional<std::vector<Arc>> split(const std::vector<Piece>& pieces, const Face& face, int splits) {
    std::vector<std::uint32_t> facets;
    for (const Piece& p : pieces) facets.push_back(p.facet);
    std::vector<Arc> parts;
    for (int quarter = 0; quarter < 4; ++quarter) {
      auto arcs = trace(facets, face.quarter(quarter), splits + 1);
      if (!arcs) return std::nullopt;
      parts.insert(parts.end(), std::make_move_iterator(arcs->begin()), std::make_move_iterator(arcs->end()));
    }
    count(statistics_.face_split);
    return join_arcs(std::move(parts));
  }

  const Restriction& restriction_;
  const CellProblem& problem_;
  const Membership candidates_;
  const TraceSettings settings_;
  const LocalPlanes& planes_;
  RimLines& rims_;
  Statistics& statistics_;
};

}  // namespace

std::optional<std::vector<Arc>> trace_face(const Restriction& restriction, const CellProblem& problem,
                                           const std::vector<std::uint32_t>& facets, const Face& face, const TraceSettings& settings,
                                           const LocalPlanes& planes, RimLines& rims, Statistics& statistics) {
  return FaceTracer(restriction, problem, settings, planes, rims, statistics).trace(facets, face, 0);
}

}  // namespace starcell
