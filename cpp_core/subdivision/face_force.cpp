#include "subdivision/face_force.h"

#include <algorithm>

#include "subdivision/rim.h"

namespace starcell {

std::vector<Arc> force_face(const Restriction& restriction, const CellProblem& problem, const Face& face) {
  const std::vector<Flip> around = *RimLines(restriction, problem).around(face, false);
  const Grid& grid = restriction.grid();
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const Flip &enter = around[k], &leave = around[(k + 1) % around.size()];
    if (!enter.enters) continue;
    Arc arc;
    arc.start = enter.crossing;
    arc.end = leave.crossing;
    arc.surfaces.push_back(no_surface);
    if (enter.side == leave.side && around.size() > 1) {
      // A chord would lie on the edge: bend it into the face.
      const int axis = enter.crossing.axis;
      Vec3 bend = grid.point(face.corner(0, 0));
      bend[axis] = 0.5 * (enter.crossing.at + leave.crossing.at);
      const double depth = std::max(4 * grid.margin(face.size), 0.25 * std::abs(enter.crossing.at - leave.crossing.at));
      const int across = enter.side < 2 ? face.b_axis() : face.c_axis();
      const double from = grid.coordinate(across, (enter.side < 2 ? face.b : face.c) + (enter.side % 2 ? face.size : 0));
      bend[across] = from + (enter.side % 2 ? -depth : depth);
      arc.bends.push_back(bend);
      arc.surfaces.push_back(no_surface);
    }
    arcs.push_back(std::move(arc));
  }
  return arcs;
}

}  // namespace starcell
