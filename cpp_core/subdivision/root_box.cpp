#include "subdivision/root_box.h"

#include <algorithm>
#include <cmath>

namespace starcell {
namespace {

constexpr int float_bits = 24;
// Crossings are told apart to this many bits of the largest coordinate: distances are known to about 44.
constexpr int finest_bits = 40;
// Two crossings of a knife's edge of 1e-3 are this much nearer to each other than the cells it takes are large.
constexpr int most_finer = 12;
// Cells may be this many levels below the root: 4e-9 of its side, fine enough for slivers between generic parts.
constexpr int least_depth = 28;
constexpr int candidates = 16;
constexpr int shallow_levels = 6;
// The cosine from which a plane counts as one across an axis. Those of moved faces have no vertices that stand for them.
constexpr double along_axis = 1 - 1e-9;
// Of the grid's side: a plane this near to one of the first levels' is avoided, whatever the vertices say.
constexpr double too_near = 1e-5;

// The smallest distance between a vertex, or a plane across the axis, and a plane of the first levels along one axis, in units.
double clearance(const Grid& grid, int axis, const std::vector<double>& coordinates) {
  const double step = std::ldexp(grid.unit, grid.depth - shallow_levels);
  const double lower = grid.coordinate(axis, 0);
  double nearest = step;
  for (const double x : coordinates) {
    const double t = (x - lower) / step;
    nearest = std::min(nearest, std::abs(t - std::round(t)) * step);
  }
  return nearest;
}

}  // namespace

double float_step(const Box3& box) {
  const double side = 1.2 * std::max(box.sizes().maxCoeff(), 1e-300);
  const double reach = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) + 2 * side;
  return std::ldexp(1.0, std::ilogb(reach) + 1 - float_bits);
}

Grid choose_grid(const Box3& box, const FacetTable& table, int attempt) {
  Grid grid;
  grid.step = float_step(box);
  const double side = 1.1 * std::max(box.sizes().maxCoeff(), 8 * grid.step);
  const int float_depth = std::max(4, static_cast<int>(std::ceil(std::log2(side / grid.step))));
  grid.depth = std::max(float_depth, least_depth);
  grid.unit = std::ldexp(grid.step, float_depth - grid.depth);
  const double size = std::ldexp(grid.unit, grid.depth);
  const auto units = static_cast<std::int64_t>(grid.step / grid.unit);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    const std::size_t stride = table.points.size() / 20000 + 1;
    for (std::size_t i = 0; i < table.points.size(); i += stride)
      if (box.min()[axis] <= table.points[i][axis] && table.points[i][axis] <= box.max()[axis])
        coordinates.push_back(table.points[i][axis]);
    std::vector<double> planes;
    for (const Surface& s : table.surfaces)
      if (!s.form && std::abs(s.normal[axis]) > along_axis) planes.push_back(s.offset / s.normal[axis]);
    const double slack = size - box.sizes()[axis];
    double best = -1;
    std::int64_t origin = 0;
    for (int k = 0; k < candidates; ++k) {
      // Irrational steps through the middle half of the slack.
      const double fraction = 0.25 + 0.5 * std::fmod(0.38196601125 + 0.61803398875 * k + 0.137 * axis + 0.0917 * attempt, 1.0);
      grid.origin[axis] = (static_cast<std::int64_t>(std::floor((box.min()[axis] - fraction * slack) / grid.step)) | 1) * units;
      double c = clearance(grid, axis, coordinates);
      if (clearance(grid, axis, planes) < too_near * size) c *= too_near;
      if (c > best) best = c, origin = grid.origin[axis];
    }
    grid.origin[axis] = origin;
  }
  // Sums and middles of two coordinates are doubles then, and signs at the ends of such intervals seldom uncertain.
  std::int64_t farthest = 0;
  for (const std::int64_t o : grid.origin) farthest = std::max(farthest, std::abs(o) + (std::int64_t{1} << grid.depth));
  grid.finer = std::clamp(finest_bits - std::ilogb(static_cast<double>(farthest)), 0, most_finer);
  return grid;
}

}  // namespace starcell
