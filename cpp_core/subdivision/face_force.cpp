#include "subdivision/face_force.h"

#include <algorithm>

#include "subdivision/face_pieces.h"
#include "subdivision/grid_line.h"

namespace starcell {
namespace {

struct Flip {
  Crossing crossing;
  std::vector<std::size_t> slots;
};

bool value_of(const LocalExpression& expression, const std::vector<char>& inside) {
  std::vector<State> states;
  for (const char s : inside) states.push_back(s ? State::inside : State::outside);
  return expression.constant() ? *expression.constant() : *expression.simplified(states).constant();
}

// Every surface that some solid's facet crosses the side with, in order along the side's axis.
std::vector<Flip> flips_along(const Restriction& restriction, const CellProblem& problem, const Face& face, int side) {
  const FacetTable& table = restriction.table();
  const Grid& grid = restriction.grid();
  const int axis = side < 2 ? face.c_axis() : face.b_axis();
  const GridPoint low = side < 2 ? face.corner(side, 0) : face.corner(0, side - 2);
  const Vec3 p = grid.point(low);
  std::vector<Flip> flips;
  for (const std::uint32_t f : problem.facets) {
    if (!segment_crosses(table, f, axis, p, grid.coordinate(axis, low[axis] + face.size))) continue;
    const std::uint32_t surface = table.surface[f];
    auto it = std::find_if(flips.begin(), flips.end(), [&](const Flip& x) { return x.crossing.surface == surface; });
    if (it == flips.end()) {
      flips.push_back({side_crossing(table, grid, face, side, surface), {}});
      it = flips.end() - 1;
    }
    it->slots.push_back(restriction.slot_of(problem, f));
  }
  std::sort(flips.begin(), flips.end(), [](const Flip& x, const Flip& y) {
    return x.crossing.at != y.crossing.at ? x.crossing.at < y.crossing.at : x.crossing.surface < y.crossing.surface;
  });
  return flips;
}

struct Event {
  Crossing crossing;
  bool enters;
  int side;
};

// Where E flips along one side, walked upwards from a corner with the given memberships.
std::vector<Event> events_along(const Restriction& restriction, const CellProblem& problem, const Face& face, int side) {
  const GridPoint low = side < 2 ? face.corner(side, 0) : face.corner(0, side - 2);
  std::vector<char> inside = restriction.membership_at(problem, low);
  std::vector<Event> events;
  bool value = value_of(problem.expression, inside);
  for (const Flip& flip : flips_along(restriction, problem, face, side)) {
    for (const std::size_t slot : flip.slots) inside[slot] ^= 1;
    const bool next = value_of(problem.expression, inside);
    if (next != value) events.push_back({flip.crossing, next, side});
    value = next;
  }
  return events;
}

}  // namespace

std::vector<Arc> force_face(const Restriction& restriction, const CellProblem& problem, const Face& face) {
  // Counter-clockwise: bottom and right upwards, top and left downwards.
  std::vector<Event> around;
  for (const int side : {2, 1, 3, 0}) {
    std::vector<Event> events = events_along(restriction, problem, face, side);
    if (side == 3 || side == 0) {
      std::reverse(events.begin(), events.end());
      for (Event& e : events) e.enters = !e.enters;
    }
    around.insert(around.end(), events.begin(), events.end());
  }
  const Grid& grid = restriction.grid();
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const Event &enter = around[k], &leave = around[(k + 1) % around.size()];
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
