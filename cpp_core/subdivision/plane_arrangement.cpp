#include "subdivision/plane_arrangement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/predicates.h"

namespace starcell {
namespace {

PointName name_of(int a, int b, int c) {
  PointName n{a, b, c};
  std::sort(n.begin(), n.end());
  return n;
}

Interval det(const Interval& a, const Interval& b, const Interval& c, const Interval& d) { return a * d - b * c; }

}  // namespace

bool PlaneArrangement::build(std::size_t max_planes) {
  for (const std::uint32_t f : problem_.facets) surfaces_.push_back(surface_of(f));
  std::sort(surfaces_.begin(), surfaces_.end());
  surfaces_.erase(std::unique(surfaces_.begin(), surfaces_.end()), surfaces_.end());
  if (surfaces_.size() > max_planes) return false;
  {
    const Rounding rounding;
    make_planes();
    find_stars();
    find_reach();
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      if (!cut_plane(static_cast<int>(i))) return false;
  }
  return keep_boundary();
}

void PlaneArrangement::make_planes() {
  const double size = restriction_.grid().unit * problem_.cell.size;
  for (const std::uint32_t id : surfaces_) {
    Plane p;
    local_.enclose(restriction_.table(), id, box_.min(), p.n, p.d);
    planes_.push_back(p);
  }
  for (int side = 0; side < 6; ++side) {
    Plane p;
    for (int k = 0; k < 3; ++k) p.n[k] = Interval(k == side / 2 ? 1.0 : 0.0);
    p.d = Interval(side % 2 ? size : 0.0);
    planes_.push_back(p);
  }
}

Interval3 PlaneArrangement::local(std::uint32_t vertex) const {
  const Vec3& p = restriction_.table().points[vertex];
  Interval3 x;
  x.x = Interval(p.x()) - Interval(box_.min().x());
  x.y = Interval(p.y()) - Interval(box_.min().y());
  x.z = Interval(p.z()) - Interval(box_.min().z());
  return x;
}

// All facets around a vertex that lies in the cell meet the cell.
void PlaneArrangement::find_stars() {
  if (!local_.empty()) return;   // planes that stand for others pass by their vertices
  const FacetTable& table = restriction_.table();
  std::vector<std::pair<std::uint32_t, int>> around;
  for (const std::uint32_t f : problem_.facets)
    for (const std::uint32_t v : table.corners[f]) {
      const Vec3& p = table.points[v];
      if (!((p - box_.min()).array() > 0).all() || !((box_.max() - p).array() > 0).all()) continue;
      const auto at = std::lower_bound(surfaces_.begin(), surfaces_.end(), table.surface[f]);
      around.emplace_back(v, static_cast<int>(at - surfaces_.begin()));
    }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  for (std::size_t k = 0, end; k < around.size(); k = end) {
    for (end = k; end < around.size() && around[end].first == around[k].first;) ++end;
    if (end - k < 4) continue;
    Star star{around[k].first, {}};
    for (std::size_t i = k; i < end; ++i) star.planes.push_back(around[i].second);
    stars_.push_back(std::move(star));
  }
}

// The star whose vertex three planes name, or -1. None if there are two: the planes have a line in common.
std::optional<int> PlaneArrangement::star_of(const PointName& name) const {
  int found = -1;
  for (std::size_t k = 0; k < stars_.size(); ++k) {
    if (!stars_[k].has(name[0]) || !stars_[k].has(name[1]) || !stars_[k].has(name[2])) continue;
    if (found >= 0) return std::nullopt;
    found = static_cast<int>(k);
  }
  return found;
}

// Which side of the plane a point is on; 0: on it, as a vertex of its facets. None: uncertain.
std::optional<int> PlaneArrangement::side_of(int point, int plane) const {
  if (point_star_[point] >= 0 && stars_[point_star_[point]].has(plane)) return 0;
  const int sign = certain_sign(value(planes_[plane], points_[point]));
  return sign == 0 ? std::nullopt : std::optional(sign);
}

// On which sides of plane j do the facets of plane i have anything? What lies on the other side cannot be covered by them:
// with all corners on facets of j, or certainly above j, a facet lies above the lowest of the planes that j's interval
// encloses, and everything that is certainly under j lies under that one.
void PlaneArrangement::find_reach() {
  const std::size_t n = surfaces_.size();
  reach_.assign(n * n, local_.empty() ? 0 : 3);
  if (!local_.empty()) return;   // planes of different normals in one interval: none of them is the lowest
  const FacetTable& table = restriction_.table();
  std::vector<std::vector<std::uint32_t>> corners(n);
  for (const std::uint32_t f : problem_.facets) {
    const std::size_t i = static_cast<std::size_t>(std::lower_bound(surfaces_.begin(), surfaces_.end(), table.surface[f]) - surfaces_.begin());
    corners[i].insert(corners[i].end(), table.corners[f].begin(), table.corners[f].end());
  }
  for (auto& some : corners) {
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
  }
  for (std::size_t i = 0; i < n; ++i)
    for (const std::uint32_t v : corners[i]) {
      const Interval3 x = local(v);
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i || reach_[i * n + j] == 3 || std::binary_search(corners[j].begin(), corners[j].end(), v)) continue;
        const int sign = certain_sign(value(planes_[j], x));
        reach_[i * n + j] |= sign > 0 ? 1 : sign < 0 ? 2 : 3;
      }
    }
  for (char& reach : reach_)
    if (reach == 0) reach = 3;   // all corners on j: the planes are too close to tell
}

// Cramer's rule in intervals.
bool PlaneArrangement::solve(const PointName& name, Interval3& x) const {
  const Plane &p = planes_[name[0]], &q = planes_[name[1]], &r = planes_[name[2]];
  const Interval yz = det(q.n[1], q.n[2], r.n[1], r.n[2]), xz = det(q.n[0], q.n[2], r.n[0], r.n[2]),
                 xy = det(q.n[0], q.n[1], r.n[0], r.n[1]);
  const Interval whole = p.n[0] * yz - p.n[1] * xz + p.n[2] * xy;
  if (certain_sign(whole) == 0) return false;
  const Interval dyz = det(q.d, q.n[2], r.d, r.n[2]), dxy = det(q.d, q.n[1], r.d, r.n[1]),
                 dxz = det(q.n[0], q.d, r.n[0], r.d), xyd = det(q.n[0], q.n[1], r.n[0], r.n[1]),
                 ydx = det(q.n[1], q.d, r.n[1], r.d);
  x.x = (p.d * yz - p.n[1] * dyz + p.n[2] * dxy) / whole;
  x.y = (p.n[0] * dyz - p.d * xz + p.n[2] * dxz) / whole;
  x.z = (p.n[0] * ydx - p.n[1] * dxz + p.d * xyd) / whole;
  return true;
}

// -1 if the planes have no point in common for certain.
int PlaneArrangement::point(const PointName& planes) {
  const auto star = star_of(planes);
  if (!star) return -1;
  PointName name = planes;
  if (*star >= 0) std::copy_n(stars_[*star].planes.begin(), 3, name.begin());
  const auto [it, fresh] = index_.emplace(name, static_cast<int>(points_.size()));
  if (fresh) {
    Interval3 x;
    if (*star >= 0)
      x = local(stars_[*star].vertex);
    else if (!solve(name, x))
      return -1;
    points_.push_back(x);
    names_.push_back(name);
    point_star_.push_back(*star);
  }
  return it->second;
}

// The polygon in which plane i cuts the cell, from the signs of the eight corners.
bool PlaneArrangement::start_polygon(int i, PlanePolygon& polygon) {
  const double size = restriction_.grid().unit * problem_.cell.size;
  std::array<int, 8> sign;
  for (int c = 0; c < 8; ++c) {
    const Interval3 x{Interval(c & 1 ? size : 0.0), Interval(c & 2 ? size : 0.0), Interval(c & 4 ? size : 0.0)};
    sign[c] = certain_sign(value(planes_[i], x));
    if (sign[c] == 0) return false;
  }
  // Each crossed edge joins two sides of the cell, each crossed side two edges: one cycle around the cell.
  std::map<int, std::vector<std::pair<int, int>>> at_side;  // side -> (point, the point's other side)
  int crossed = 0;
  for (int c = 0; c < 8; ++c)
    for (int axis = 0; axis < 3; ++axis) {
      if (c >> axis & 1 || sign[c] == sign[c | 1 << axis]) continue;
      const int b = (axis + 1) % 3, d = (axis + 2) % 3;
      const int s = 2 * b + (c >> b & 1), t = 2 * d + (c >> d & 1);
      const int p = point(name_of(i, count() + s, count() + t));
      if (p < 0) return false;
      at_side[s].emplace_back(p, t);
      at_side[t].emplace_back(p, s);
      ++crossed;
    }
  polygon.plane = i;
  if (crossed == 0) return true;
  int side = at_side.begin()->first;
  int at = at_side.begin()->second[0].first;
  for (int k = 0; k < crossed; ++k) {
    const auto& pair = at_side[side];
    if (pair.size() != 2) return false;
    polygon.corner.push_back(at);
    polygon.edge.push_back(count() + side);
    const auto& next = pair[0].first == at ? pair[1] : pair[0];
    at = next.first;
    side = next.second;
  }
  return turn_to_normal(polygon);
}

// The whole polygon is wide enough for doubles to see its sense, or it is not used.
bool PlaneArrangement::turn_to_normal(PlanePolygon& polygon) const {
  const std::size_t n = polygon.corner.size();
  const Vec3 origin = points_[polygon.corner[0]].middle();
  Vec3 area = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < n; ++k)
    area += (points_[polygon.corner[k]].middle() - origin).cross(points_[polygon.corner[k + 1]].middle() - origin);
  const double along = area.dot(restriction_.table().surfaces[surfaces_[polygon.plane]].normal);
  if (!(std::abs(along) > 0.5 * area.norm())) return false;
  if (along > 0) return true;
  std::reverse(polygon.corner.begin(), polygon.corner.end());
  std::reverse(polygon.edge.begin(), polygon.edge.end() - 1);
  return true;
}

bool PlaneArrangement::cut_plane(int i) {
  PlanePolygon whole;
  if (!start_polygon(i, whole)) return false;
  if (whole.corner.empty()) return true;
  whole.side.assign(surfaces_.size(), 0);
  std::vector<PlanePolygon> parts{std::move(whole)}, next;
  // First the planes that leave one side only.
  for (const bool both : {false, true})
    for (int j = 0; j < count(); ++j) {
      if (j == i || both != (reaches(i, j, 1) && reaches(i, j, -1))) continue;
      next.clear();
      for (PlanePolygon& part : parts)
        if (!split(part, j, next)) return false;
      parts.swap(next);
    }
  for (PlanePolygon& part : parts) polygons_.push_back(std::move(part));
  return true;
}

// Parts that no facet of their plane can cover are dropped at once: few of the arrangement's are left.
bool PlaneArrangement::split(PlanePolygon& part, int j, std::vector<PlanePolygon>& out) {
  const std::size_t n = part.corner.size();
  std::vector<int> sign(n);
  bool above = false, under = false;
  for (std::size_t k = 0; k < n; ++k) {
    const auto side = side_of(part.corner[k], j);
    if (!side) return false;
    sign[k] = *side;
    above = above || sign[k] > 0;
    under = under || sign[k] < 0;
  }
  if (!above && !under) return false;
  if (!above || !under) {
    part.side[j] = above ? 1 : -1;
    if (reaches(part.plane, j, part.side[j])) out.push_back(std::move(part));
    return true;
  }
  for (const int keep : {1, -1}) {
    if (!reaches(part.plane, j, keep)) continue;
    PlanePolygon half;
    half.plane = part.plane;
    half.side = part.side;
    half.side[j] = static_cast<signed char>(keep);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      // A corner on the plane belongs to both halves; from it a half goes on along the plane or along its old edge.
      if (sign[k] == keep || sign[k] == 0) {
        half.corner.push_back(part.corner[k]);
        half.edge.push_back(sign[k] == 0 && sign[next] == -keep ? j : part.edge[k]);
      }
      if (sign[k] * sign[next] >= 0) continue;
      const int p = point(name_of(part.plane, part.edge[k], j));
      if (p < 0) return false;
      half.corner.push_back(p);
      half.edge.push_back(sign[k] == keep ? j : part.edge[k]);
    }
    out.push_back(std::move(half));
  }
  return true;
}

// Drops the polygons that E does not use; learns which side of the others is solid.
bool PlaneArrangement::keep_boundary() {
  look_between_walls();
  std::vector<PlanePolygon> kept;
  for (PlanePolygon& polygon : polygons_) {
    Vec3 middle = Vec3::Zero();
    for (const int c : polygon.corner) middle += points_[c].middle();
    middle /= static_cast<double>(polygon.corner.size());
    if (!certainly_inside(polygon, middle)) return false;
    const Vec3 world = middle + box_.min();
    const Cover cover = covering(polygon.plane, world);
    Membership flips = cover.flips;
    if (flips == 0) continue;
    const std::uint32_t surface = surfaces_[polygon.plane];
    auto around = restriction_.mask_near(
        problem_, world, 0.0, [&](std::uint32_t f) { return surface_of(f) == surface; });
    if (!around || !candidates_beside(polygon, middle, cover.opposed, *around, flips)) return false;
    if (flips == 0) continue;
    const bool corner_side = problem_.expression.value(*around);
    if (corner_side == problem_.expression.value(*around ^ flips)) continue;
    polygon.positive_inside = (corner_sign_[polygon.plane] > 0) == corner_side;
    kept.push_back(std::move(polygon));
  }
  polygons_.swap(kept);
  return true;
}

// The rounded middle must be certified to lie in the polygon's own region of the arrangement.
bool PlaneArrangement::certainly_inside(const PlanePolygon& polygon, const Vec3& middle) {
  const Rounding rounding;
  const Interval3 x{Interval(middle.x()), Interval(middle.y()), Interval(middle.z())};
  if (corner_sign_.empty())
    for (int j = 0; j < count(); ++j) corner_sign_.push_back(certain_sign(-planes_[j].d));
  for (int j = 0; j < count() + 6; ++j) {
    if (j == polygon.plane) continue;
    const int inside = j < count() ? polygon.side[j] : (j - count()) % 2 ? -1 : 1;  // of the cell's sides
    if (certain_sign(value(planes_[j], x)) != inside) return false;
  }
  return true;
}

}  // namespace starcell
