#include "subdivision/voxel_planes.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "numerics/interval.h"
#include "numerics/predicates.h"

namespace starcell {
namespace {

struct Plane {
  Interval n[3];
  Interval d;   // relative to the cell's lower corner
};

// A point on three planes, named by them: ascending labels. Labels below the plane count are surfaces, the rest the six
// sides of the cell (lower x, upper x, lower y, ...).
using Name = std::array<int, 3>;

Name name_of(int a, int b, int c) {
  Name n{a, b, c};
  std::sort(n.begin(), n.end());
  return n;
}

// edge[k] is the plane that cuts out the edge from corner k to k+1.
struct Polygon {
  int plane = 0;
  std::vector<int> corner;   // indices of points
  std::vector<int> edge;
  bool positive_inside = false;
};

class Arrangement {
 public:
  Arrangement(const Restriction& restriction, const CellProblem& problem)
      : restriction_(restriction), problem_(problem), box_(box_of(restriction.grid(), problem.cell)) {}

  std::optional<std::vector<PlaneSheet>> sheets() {
    const FacetTable& table = restriction_.table();
    for (const std::uint32_t f : problem_.facets) surfaces_.push_back(table.surface[f]);
    std::sort(surfaces_.begin(), surfaces_.end());
    surfaces_.erase(std::unique(surfaces_.begin(), surfaces_.end()), surfaces_.end());
    if (surfaces_.size() > max_cell_planes) return std::nullopt;
    {
      const Rounding rounding;
      make_planes();
      for (std::size_t i = 0; i < surfaces_.size(); ++i)
        if (!cut_plane(static_cast<int>(i))) return std::nullopt;
    }
    if (!keep_boundary()) return std::nullopt;
    return glue();
  }

 private:
  int count() const { return static_cast<int>(surfaces_.size()); }

  void make_planes() {
    const double size = restriction_.grid().unit * problem_.cell.size;
    for (const std::uint32_t id : surfaces_) {
      const Surface& s = restriction_.table().surfaces[id];
      Plane p;
      Interval dot(0.0);
      for (int k = 0; k < 3; ++k) {
        p.n[k] = Interval(s.normal[k]);
        dot += p.n[k] * Interval(box_.min()[k]);
      }
      p.d = Interval(s.offset) - dot + Interval(-s.thickness, s.thickness);
      planes_.push_back(p);
    }
    for (int side = 0; side < 6; ++side) {
      Plane p;
      for (int k = 0; k < 3; ++k) p.n[k] = Interval(k == side / 2 ? 1.0 : 0.0);
      p.d = Interval(side % 2 ? size : 0.0);
      planes_.push_back(p);
    }
  }

  static Interval value(const Plane& p, const Interval3& x) { return p.n[0] * x.x + p.n[1] * x.y + p.n[2] * x.z - p.d; }

  static Interval det(const Interval& a, const Interval& b, const Interval& c, const Interval& d) { return a * d - b * c; }

  // Cramer's rule in intervals.
  bool solve(const Name& name, Interval3& x) const {
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

  int point(const Name& name) {
    const auto [it, fresh] = index_.emplace(name, static_cast<int>(points_.size()));
    if (fresh) {
      Interval3 x;
      if (!solve(name, x)) return -1;
      points_.push_back(x);
      names_.push_back(name);
    }
    return it->second;
  }

  // The polygon in which plane i cuts the cell, from the signs of the eight corners.
  bool start_polygon(int i, Polygon& polygon) {
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
    return true;
  }

  bool cut_plane(int i) {
    Polygon whole;
    if (!start_polygon(i, whole)) return false;
    if (whole.corner.empty()) return true;
    std::vector<Polygon> parts{std::move(whole)}, next;
    for (int j = 0; j < count(); ++j) {
      if (j == i) continue;
      next.clear();
      for (Polygon& part : parts)
        if (!split(part, j, next)) return false;
      parts.swap(next);
    }
    for (Polygon& part : parts) polygons_.push_back(std::move(part));
    return true;
  }

  bool split(Polygon& part, int j, std::vector<Polygon>& out) {
    const std::size_t n = part.corner.size();
    std::vector<int> sign(n);
    bool above = false, under = false;
    for (std::size_t k = 0; k < n; ++k) {
      sign[k] = certain_sign(value(planes_[j], points_[part.corner[k]]));
      if (sign[k] == 0) return false;
      (sign[k] > 0 ? above : under) = true;
    }
    if (!above || !under) {
      out.push_back(std::move(part));
      return true;
    }
    for (const int keep : {1, -1}) {
      Polygon half;
      half.plane = part.plane;
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t next = (k + 1) % n;
        if (sign[k] == keep) {
          half.corner.push_back(part.corner[k]);
          half.edge.push_back(part.edge[k]);
        }
        if (sign[k] == sign[next]) continue;
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
  bool keep_boundary() {
    std::vector<Polygon> kept;
    for (Polygon& polygon : polygons_) {
      Vec3 middle = Vec3::Zero();
      for (const int c : polygon.corner) middle += points_[c].middle();
      middle /= static_cast<double>(polygon.corner.size());
      if (!certainly_inside(polygon, middle)) return false;
      const Vec3 world = middle + box_.min();
      const Membership flips = covering(polygon.plane, world);
      if (flips == 0) continue;
      const std::uint32_t surface = surfaces_[polygon.plane];
      const auto around = restriction_.mask_near(
          problem_, world, 0.0, [&](std::uint32_t f) { return restriction_.table().surface[f] == surface; });
      if (!around) return false;
      const bool corner_side = problem_.expression.value(*around);
      if (corner_side == problem_.expression.value(*around ^ flips)) continue;
      polygon.positive_inside = (corner_sign_[polygon.plane] > 0) == corner_side;
      kept.push_back(std::move(polygon));
    }
    polygons_.swap(kept);
    return true;
  }

  // The rounded middle must be certified to lie in the polygon's own region of the arrangement.
  bool certainly_inside(const Polygon& polygon, const Vec3& middle) {
    const Rounding rounding;
    const Interval3 x{Interval(middle.x()), Interval(middle.y()), Interval(middle.z())};
    if (corner_sign_.empty())
      for (int j = 0; j < count(); ++j) corner_sign_.push_back(certain_sign(-planes_[j].d));
    for (int j = 0; j < count() + 6; ++j) {
      if (j == polygon.plane) continue;
      const int sign = certain_sign(value(planes_[j], x));
      if (sign == 0) return false;
      for (const int c : polygon.corner)
        if (names_[c][0] != j && names_[c][1] != j && names_[c][2] != j &&
            certain_sign(value(planes_[j], points_[c])) == -sign)
          return false;
    }
    return true;
  }

  Membership covering(int plane, const Vec3& x) const {
    const FacetTable& table = restriction_.table();
    int axis = 0;
    table.surfaces[surfaces_[plane]].normal.cwiseAbs().maxCoeff(&axis);
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const Vec2 at = project(x, axis);
    Membership mask = 0;
    for (const std::uint32_t f : problem_.facets) {
      if (table.surface[f] != surfaces_[plane]) continue;
      const Vec2 p = project(table.corner(f, 0), axis), q = project(table.corner(f, 1), axis),
                 r = project(table.corner(f, 2), axis);
      const int s = turn_grid(p, q, at, a, b);
      if (s != 0 && turn_grid(q, r, at, a, b) == s && turn_grid(r, p, at, a, b) == s)
        mask ^= Membership{1} << restriction_.slot_of(problem_, f);
    }
    return mask;
  }

  // Is the polygon on the positive side of plane j?
  bool above(const Polygon& polygon, int j) const {
    for (const int c : polygon.corner) {
      const Name& name = names_[c];
      if (name[0] == j || name[1] == j || name[2] == j) continue;
      const Rounding rounding;
      return certain_sign(value(planes_[j], points_[c])) > 0;
    }
    return false;
  }

  struct Sets {
    std::vector<int> parent;
    explicit Sets(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }
    int root(int i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    }
    void join(int a, int b) { parent[root(a)] = root(b); }
  };

  struct Side {
    int polygon, corner, edge;  // the edge from corner to corner + 1
  };

  std::optional<std::vector<PlaneSheet>> glue() {
    std::vector<int> first_corner(polygons_.size() + 1, 0);
    for (std::size_t p = 0; p < polygons_.size(); ++p)
      first_corner[p + 1] = first_corner[p] + static_cast<int>(polygons_[p].corner.size());
    Sets sheets(polygons_.size()), corners(first_corner.back());
    std::vector<int> edges(polygons_.size(), 0);
    std::vector<bool> bounded(polygons_.size(), false), contact(polygons_.size(), false);
    std::map<std::pair<int, int>, std::vector<Side>> sides;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      const Polygon& polygon = polygons_[p];
      const int n = static_cast<int>(polygon.corner.size());
      for (int k = 0; k < n; ++k) {
        if (polygon.edge[k] >= count()) {
          ++edges[p];
          bounded[p] = true;
        } else {
          const auto [lo, hi] = std::minmax(polygon.corner[k], polygon.corner[(k + 1) % n]);
          sides[{lo, hi}].push_back({static_cast<int>(p), k, polygon.edge[k]});
        }
      }
    }
    const auto join = [&](const Side& x, const Side& y) {
      sheets.join(x.polygon, y.polygon);
      ++edges[x.polygon];
      for (int ex = 0; ex < 2; ++ex)
        for (int ey = 0; ey < 2; ++ey) {
          const Polygon &px = polygons_[x.polygon], &py = polygons_[y.polygon];
          const int cx = (x.corner + ex) % static_cast<int>(px.corner.size());
          const int cy = (y.corner + ey) % static_cast<int>(py.corner.size());
          if (px.corner[cx] == py.corner[cy])
            corners.join(first_corner[x.polygon] + cx, first_corner[y.polygon] + cy);
        }
    };
    for (const auto& [key, around] : sides) {
      if (around.size() == 2) {
        join(around[0], around[1]);
      } else if (around.size() == 4) {
        // Inside joins only across a face: pair the polygons that bound the same inside wedge.
        for (int a = 0; a < 4; ++a)
          for (int b = a + 1; b < 4; ++b) {
            const Polygon &pa = polygons_[around[a].polygon], &pb = polygons_[around[b].polygon];
            if (pa.plane == pb.plane) continue;
            if (above(pa, pb.plane) == pb.positive_inside && above(pb, pa.plane) == pa.positive_inside)
              join(around[a], around[b]);
          }
        for (const Side& s : around) contact[s.polygon] = true;
      } else {
        return std::nullopt;
      }
    }
    return collect(sheets, corners, edges, bounded, contact, first_corner);
  }

  std::optional<std::vector<PlaneSheet>> collect(Sets& sheets, Sets& corners, const std::vector<int>& edges,
                                                 const std::vector<bool>& bounded, const std::vector<bool>& contact,
                                                 const std::vector<int>& first_corner) {
    std::map<int, int> characteristic, sheet_of;
    std::map<int, bool> has_boundary;
    std::vector<PlaneSheet> result;
    std::map<int, int> vertex_root_of_point;  // point -> first class seen: several classes are a vertex contact
    std::vector<int> split_points;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      const int r = sheets.root(static_cast<int>(p));
      characteristic[r] += 1 - edges[p];
      has_boundary[r] = has_boundary[r] || bounded[p];
      for (std::size_t k = 0; k < polygons_[p].corner.size(); ++k) {
        const int c = corners.root(first_corner[p] + static_cast<int>(k));
        if (c == first_corner[p] + static_cast<int>(k)) ++characteristic[r];
        const auto [it, fresh] = vertex_root_of_point.emplace(polygons_[p].corner[k], c);
        if (!fresh && it->second != c) split_points.push_back(polygons_[p].corner[k]);
      }
    }
    for (const auto& [r, chi] : characteristic) {
      if (chi != 1 || !has_boundary[r]) return std::nullopt;
      sheet_of[r] = static_cast<int>(result.size());
      result.emplace_back();
    }
    std::sort(split_points.begin(), split_points.end());
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      PlaneSheet& sheet = result[sheet_of[sheets.root(static_cast<int>(p))]];
      sheet.surfaces.push_back(surfaces_[polygons_[p].plane]);
      sheet.contact = sheet.contact || contact[p];
      for (const int c : polygons_[p].corner) {
        if (std::binary_search(split_points.begin(), split_points.end(), c)) sheet.contact = true;
        add_crossing(names_[c], sheet);
      }
    }
    for (PlaneSheet& sheet : result) {
      std::sort(sheet.surfaces.begin(), sheet.surfaces.end());
      sheet.surfaces.erase(std::unique(sheet.surfaces.begin(), sheet.surfaces.end()), sheet.surfaces.end());
      std::sort(sheet.crossings.begin(), sheet.crossings.end());
      sheet.crossings.erase(std::unique(sheet.crossings.begin(), sheet.crossings.end()), sheet.crossings.end());
    }
    return result;
  }

  // A point on a surface and two sides of the cell is a crossing of a cell edge.
  void add_crossing(const Name& name, PlaneSheet& sheet) const {
    if (name[0] >= count() || name[1] < count()) return;
    const int s = name[1] - count(), t = name[2] - count();
    const int axis = 3 - s / 2 - t / 2;
    GridPoint p{};
    for (const int side : {s, t}) p[side / 2] = problem_.cell.lower[side / 2] + (side % 2 ? problem_.cell.size : 0);
    Crossing x;
    x.axis = static_cast<std::uint8_t>(axis);
    x.i = p[(axis + 1) % 3];
    x.j = p[(axis + 2) % 3];
    x.surface = surfaces_[name[0]];
    sheet.crossings.push_back(x);
  }

  const Restriction& restriction_;
  const CellProblem& problem_;
  const Box3 box_;
  std::vector<std::uint32_t> surfaces_;
  std::vector<Plane> planes_;
  std::vector<int> corner_sign_;
  std::map<Name, int> index_;
  std::vector<Interval3> points_;
  std::vector<Name> names_;
  std::vector<Polygon> polygons_;
};

}  // namespace

std::optional<std::vector<PlaneSheet>> plane_sheets(const Restriction& restriction, const CellProblem& problem) {
  return Arrangement(restriction, problem).sheets();
}

}  // namespace starcell
