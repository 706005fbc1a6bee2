#include "subdivision/voxel_planes.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "subdivision/plane_arrangement.h"

namespace starcell {
namespace {

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

class Gluing {
 public:
  Gluing(const PlaneArrangement& arrangement, const CellProblem& problem)
      : arrangement_(arrangement), problem_(problem), polygons_(arrangement.polygons()) {}

  std::optional<std::vector<PlaneSheet>> glue() {
    std::vector<int> first_corner(polygons_.size() + 1, 0);
    for (std::size_t p = 0; p < polygons_.size(); ++p)
      first_corner[p + 1] = first_corner[p] + static_cast<int>(polygons_[p].corner.size());
    Sets sheets(polygons_.size()), corners(first_corner.back());
    std::vector<int> edges(polygons_.size(), 0);
    std::vector<bool> bounded(polygons_.size(), false), contact(polygons_.size(), false);
    std::map<std::pair<int, int>, std::vector<Side>> sides;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      const PlanePolygon& polygon = polygons_[p];
      const int n = static_cast<int>(polygon.corner.size());
      for (int k = 0; k < n; ++k) {
        if (polygon.edge[k] >= arrangement_.count()) {
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
          const PlanePolygon &px = polygons_[x.polygon], &py = polygons_[y.polygon];
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
            const PlanePolygon &pa = polygons_[around[a].polygon], &pb = polygons_[around[b].polygon];
            if (pa.plane == pb.plane) continue;
            if (arrangement_.above(pa, pb.plane) == pb.positive_inside && arrangement_.above(pb, pa.plane) == pa.positive_inside)
              join(around[a], around[b]);
          }
        for (const Side& s : around) contact[s.polygon] = true;
      } else {
        return std::nullopt;
      }
    }
    return collect(sheets, corners, edges, bounded, contact, first_corner);
  }

 private:
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
      if (!has_boundary[r]) return std::nullopt;
      sheet_of[r] = static_cast<int>(result.size());
      result.emplace_back().disk = chi == 1;
    }
    std::sort(split_points.begin(), split_points.end());
    std::vector<std::vector<int>> members(result.size());
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      const int s = sheet_of[sheets.root(static_cast<int>(p))];
      PlaneSheet& sheet = result[s];
      members[s].push_back(static_cast<int>(p));
      sheet.surfaces.push_back(arrangement_.surfaces()[polygons_[p].plane]);
      sheet.contact = sheet.contact || contact[p];
      for (const int c : polygons_[p].corner) {
        if (std::binary_search(split_points.begin(), split_points.end(), c)) sheet.contact = true;
        add_crossing(arrangement_.name(c), sheet);
      }
    }
    for (std::size_t s = 0; s < result.size(); ++s) result[s].flats = flat_parts(members[s]);
    if (std::any_of(result.begin(), result.end(), [](const PlaneSheet& s) { return !s.disk && (s.contact || s.flats.empty()); })) return std::nullopt;
    for (PlaneSheet& sheet : result) {
      std::sort(sheet.surfaces.begin(), sheet.surfaces.end());
      sheet.surfaces.erase(std::unique(sheet.surfaces.begin(), sheet.surfaces.end()), sheet.surfaces.end());
      std::sort(sheet.crossings.begin(), sheet.crossings.end());
      sheet.crossings.erase(std::unique(sheet.crossings.begin(), sheet.crossings.end()), sheet.crossings.end());
    }
    return result;
  }

  // A point on a surface and two sides of the cell is a crossing of a cell edge.
  void add_crossing(const PointName& name, PlaneSheet& sheet) const {
    if (name[0] >= arrangement_.count() || name[1] < arrangement_.count()) return;
    const int s = name[1] - arrangement_.count(), t = name[2] - arrangement_.count();
    const int axis = 3 - s / 2 - t / 2;
    GridPoint p{};
    for (const int side : {s, t}) p[side / 2] = problem_.cell.lower[side / 2] + (side % 2 ? problem_.cell.size : 0);
    Crossing x;
    x.axis = static_cast<std::uint8_t>(axis);
    x.i = p[(axis + 1) % 3];
    x.j = p[(axis + 2) % 3];
    x.surface = arrangement_.surfaces()[name[0]];
    sheet.crossings.push_back(x);
  }

  std::uint32_t label(int plane) const {
    return plane < arrangement_.count() ? arrangement_.surfaces()[plane] : side_label(plane - arrangement_.count());
  }

  // The polygons of one plane and sense joined: what cuts through a plane without bounding E there leaves no corner.
  std::vector<FlatPart> flat_parts(const std::vector<int>& members) const {
    std::map<std::array<int, 3>, int> directed;  // (plane and sense, from, to) -> cutting plane
    for (const int p : members) {
      const PlanePolygon& polygon = polygons_[p];
      const std::size_t n = polygon.corner.size();
      for (std::size_t k = 0; k < n; ++k) {
        int from = polygon.corner[k], to = polygon.corner[(k + 1) % n];
        if (polygon.positive_inside) std::swap(from, to);
        const int sense = 2 * polygon.plane + polygon.positive_inside;
        if (directed.erase({sense, to, from}) == 0) directed[{sense, from, to}] = polygon.edge[k];
      }
    }
    std::map<int, std::map<int, std::pair<int, int>>> next;  // plane and sense -> from -> (to, cutting plane)
    for (const auto& [key, edge] : directed)
      if (!next[key[0]].emplace(key[1], std::pair(key[2], edge)).second) return {};
    std::map<int, std::vector<Cycle>> cycles;  // by plane and sense
    std::set<int> corners;                     // a corner of one part is one of all parts that pass it
    for (auto& [sense, rim] : next)
      while (!rim.empty()) {
        auto cycle = take_cycle(rim);
        if (!cycle) return {};
        for (std::size_t k = 0; k < cycle->size(); ++k)
          if (turns(*cycle, k)) corners.insert((*cycle)[k].first);
        cycles[sense].push_back(std::move(*cycle));
      }
    std::vector<FlatPart> parts;
    for (const auto& [sense, some] : cycles) {
      FlatPart part;
      part.surface = arrangement_.surfaces()[sense / 2];
      for (const Cycle& cycle : some) part.cycles.push_back(corners_of(cycle, corners));
      parts.push_back(std::move(part));
    }
    return parts;
  }

  using Cycle = std::vector<std::pair<int, int>>;   // points, and the cutting plane onwards

  static bool turns(const Cycle& cycle, std::size_t k) {
    return cycle[(k + cycle.size() - 1) % cycle.size()].second != cycle[k].second;
  }

  std::optional<Cycle> take_cycle(std::map<int, std::pair<int, int>>& rim) const {
    Cycle around;
    for (auto at = rim.begin(); at != rim.end();) {
      around.emplace_back(at->first, at->second.second);
      const int to = at->second.first;
      rim.erase(at);
      at = rim.find(to);
      if (at == rim.end() && to != around.front().first) return std::nullopt;
    }
    return around;
  }

  std::vector<FlatPart::Corner> corners_of(const Cycle& cycle, const std::set<int>& corners) const {
    std::vector<FlatPart::Corner> result;
    for (const auto& [c, edge] : cycle) {
      if (!corners.contains(c)) continue;
      const PointName& name = arrangement_.name(c);
      CornerName corner{label(name[0]), label(name[1]), label(name[2])};
      std::sort(corner.begin(), corner.end());
      result.push_back({corner, label(edge), arrangement_.place(c)});
    }
    return result;
  }

  const PlaneArrangement& arrangement_;
  const CellProblem& problem_;
  const std::vector<PlanePolygon>& polygons_;
};

}  // namespace

std::optional<PlaneSheets> plane_sheets(const Restriction& restriction, const CellProblem& problem,
                                        const LocalPlanes& local) {
  PlaneArrangement arrangement(restriction, problem, local);
  if (!arrangement.build(max_cell_planes)) return std::nullopt;
  auto sheets = Gluing(arrangement, problem).glue();
  if (!sheets) return std::nullopt;
  return PlaneSheets{std::move(*sheets), arrangement.touching()};
}

}  // namespace starcell
