#include "subdivision/facets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <CGAL/box_intersection_d.h>

namespace starcell {
namespace {

// Facets of one operand are one surface when they are coplanar to within this share of the coordinates: far above double
// rounding, far below float32's. Their true planes stay inside the surface's measured thickness, which every certified
// sign takes into account; planes that meet at a smaller angle would have a common line too uncertain to decide by.
constexpr double rounding_scale = 1e-9;

// A vertex this near to a foreign plane is on it by intent: generic positions do not come as close.
constexpr double graze_scale = 1e-11;

// Operands are searched pair by pair up to this many; more of them all at once.
constexpr std::size_t few_operands = 8;

double magnitude(const std::vector<Vec3>& points) {
  double m = 0;
  for (const Vec3& p : points) m = std::max(m, p.cwiseAbs().maxCoeff());
  return m;
}

Surface plane_of(const FacetTable& table, std::uint32_t facet) {
  Surface s;
  const Vec3 n = table.area_vector(facet);
  const double length = n.norm();
  s.normal = length > 0 ? Vec3(n / length) : Vec3::UnitX();
  s.offset = s.normal.dot((table.corner(facet, 0) + table.corner(facet, 1) + table.corner(facet, 2)) / 3);
  return s;
}

double distance(const Surface& s, const Vec3& p) { return std::abs(s.normal.dot(p) - s.offset); }

double facet_distance(const FacetTable& table, const Surface& s, std::uint32_t facet) {
  double d = 0;
  for (int k = 0; k < 3; ++k) d = std::max(d, distance(s, table.corner(facet, k)));
  return d;
}

// Grows coplanar regions over each operand, largest facets first: their planes are the best determined.
void find_surfaces(FacetTable& table, double tolerance) {
  const std::size_t n = table.size();
  table.surface.assign(n, UINT32_MAX);
  std::vector<std::uint32_t> order;  // facets that may share their plane with a neighbour
  std::vector<double> area(n);
  for (std::uint32_t f = 0; f < n; ++f) {
    const Vec3 normal = table.area_vector(f);
    area[f] = normal.norm();
    const double reach = tolerance * 2 * area[f];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t g = table.neighbours[f][k];
      int apex = 0;  // the corner of g that is not on the common edge
      while (table.corners[g][apex] == table.corners[f][k] || table.corners[g][apex] == table.corners[f][(k + 1) % 3])
        ++apex;
      if (std::abs(normal.dot(table.corner(g, apex) - table.corner(f, 0))) <= reach) {
        order.push_back(f);
        break;
      }
    }
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return area[a] != area[b] ? area[a] > area[b] : a < b;
  });
  std::vector<std::uint32_t> front;
  for (const std::uint32_t seed : order) {
    if (table.surface[seed] != UINT32_MAX) continue;
    const auto id = static_cast<std::uint32_t>(table.surfaces.size());
    const Surface plane = plane_of(table, seed);
    table.surfaces.push_back(plane);
    table.surface[seed] = id;
    front.assign(1, seed);
    while (!front.empty()) {
      const std::uint32_t f = front.back();
      front.pop_back();
      for (const std::uint32_t g : table.neighbours[f])
        if (table.surface[g] == UINT32_MAX && facet_distance(table, plane, g) <= tolerance) {
          table.surface[g] = id;
          front.push_back(g);
        }
    }
  }
  for (std::uint32_t f = 0; f < n; ++f)
    if (table.surface[f] == UINT32_MAX) {
      table.surface[f] = static_cast<std::uint32_t>(table.surfaces.size());
      table.surfaces.push_back(plane_of(table, f));
    }
}

// Surfaces of different operands that are one plane within the tolerance, where the operands come near each other.
class SurfaceIdentity {
 public:
  SurfaceIdentity(FacetTable& table, double contact, double graze) : table_(table), contact_(contact), graze_(graze) {
    parent_.resize(table.surfaces.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  void find() {
    using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const std::uint32_t*>;
    const std::vector<Box3> reach = operand_boxes();
    std::vector<std::uint32_t> ids(table_.size());
    std::iota(ids.begin(), ids.end(), 0u);
    std::vector<std::vector<Box>> boxes(table_.first.size() - 1);
    for (std::size_t s = 0; s < boxes.size(); ++s)
      for (std::uint32_t f = table_.first[s]; f < table_.first[s + 1]; ++f) {
        const Box3 box = facet_box(f);
        if (box.intersects(reach[s]))
          boxes[s].emplace_back(CGAL::Bbox_3(box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(),
                                             box.max().z()),
                                &ids[f]);
      }
    const auto visit = [&](const Box& a, const Box& b) { compare(*a.handle(), *b.handle()); };
    if (boxes.size() <= few_operands) {
      for (std::size_t s = 0; s < boxes.size(); ++s)
        for (std::size_t t = s + 1; t < boxes.size(); ++t)
          CGAL::box_intersection_d(boxes[s].begin(), boxes[s].end(), boxes[t].begin(), boxes[t].end(), visit);
      return;
    }
    std::vector<Box> all;
    for (const auto& some : boxes) all.insert(all.end(), some.begin(), some.end());
    CGAL::box_self_intersection_d(all.begin(), all.end(), visit);
  }

  void apply() {
    // The canonical plane of a class is that of its largest facet: the best determined one.
    std::vector<std::uint32_t> best(parent_.size(), UINT32_MAX);
    std::vector<double> area(parent_.size(), -1);
    bool any = false;
    for (std::uint32_t id = 0; id < parent_.size(); ++id) any |= root(id) != id;
    if (!any) return;
    for (std::uint32_t f = 0; f < table_.size(); ++f) {
      const std::uint32_t r = root(table_.surface[f]);
      const double a = table_.area_vector(f).norm();
      if (a > area[r]) area[r] = a, best[r] = table_.surface[f];
    }
    for (std::uint32_t id = 0; id < parent_.size(); ++id) {
      const std::uint32_t r = root(id);
      if (r != id || best[r] == id) continue;
      std::swap(table_.surfaces[r].normal, table_.surfaces[best[r]].normal);
      std::swap(table_.surfaces[r].offset, table_.surfaces[best[r]].offset);
    }
    for (std::uint32_t id = 0; id < parent_.size(); ++id)
      if (root(id) != id) table_.surfaces[root(id)].shared = true;
    for (std::uint32_t& id : table_.surface) id = root(id);
  }

  // Vertices on foreign planes, less those with a facet of their own in that plane: identity takes care of them.
  void keep_grazes() {
    std::sort(noted_.begin(), noted_.end());
    noted_.erase(std::unique(noted_.begin(), noted_.end()), noted_.end());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> own;  // (vertex, surface) for the noted vertices
    std::vector<char> wanted(table_.points.size(), 0);
    for (const Note& n : noted_) wanted[n.vertex] = 1;
    for (std::uint32_t f = 0; f < table_.size(); ++f)
      for (const std::uint32_t v : table_.corners[f])
        if (wanted[v]) own.emplace_back(v, table_.surface[f]);
    std::sort(own.begin(), own.end());
    std::uint32_t last_vertex = UINT32_MAX, last_on = UINT32_MAX;
    for (const Note& n : noted_) {
      if (n.vertex == last_vertex && n.on == last_on) continue;
      if (std::binary_search(own.begin(), own.end(), std::pair(n.vertex, table_.surface[n.facet]))) continue;
      last_vertex = n.vertex;
      last_on = n.on;
      table_.grazes.push_back({n.of, n.on, table_.points[n.vertex]});
    }
  }

 private:
  std::uint32_t root(std::uint32_t id) {
    while (parent_[id] != id) id = parent_[id] = parent_[parent_[id]];
    return id;
  }

  Box3 facet_box(std::uint32_t f) const {
    Box3 box(table_.corner(f, 0));
    box.extend(table_.corner(f, 1)).extend(table_.corner(f, 2));
    const Vec3 margin = Vec3::Constant(0.5 * contact_);
    return {box.min() - margin, box.max() + margin};
  }

  // Per operand: the box around all others, cut down to what can matter.
  std::vector<Box3> operand_boxes() const {
    const std::size_t n = table_.first.size() - 1;
    std::vector<Box3> own(n), others(n);
    for (std::size_t s = 0; s < n; ++s)
      for (std::uint32_t f = table_.first[s]; f < table_.first[s + 1]; ++f) own[s].extend(facet_box(f));
    for (std::size_t s = 0; s < n; ++s)
      for (std::size_t t = 0; t < n; ++t)
        if (t != s && own[t].intersects(own[s])) others[s].extend(own[t].intersection(own[s]));
    return others;
  }

  void compare(std::uint32_t f, std::uint32_t g) {
    note_grazes(f, g);
    note_grazes(g, f);
    const std::uint32_t a = root(table_.surface[f]), b = root(table_.surface[g]);
    if (a == b || table_.operand_of(f) == table_.operand_of(g)) return;
    // Each facet against the plane of the other's whole surface: the pair is symmetric and does not depend on order.
    if (facet_distance(table_, table_.surfaces[table_.surface[f]], g) > contact_ ||
        facet_distance(table_, table_.surfaces[table_.surface[g]], f) > contact_)
      return;
    parent_[std::max(a, b)] = std::min(a, b);
  }

  struct Note {
    std::uint32_t of, on, vertex, facet;
    auto operator<=>(const Note&) const = default;
  };

  void note_grazes(std::uint32_t f, std::uint32_t g) {
    const Surface& s = table_.surfaces[table_.surface[f]];
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = table_.corner(g, k);
      if (distance(s, p) > graze_ || !facet_box(f).contains(p)) continue;
      noted_.push_back({table_.operand_of(g), table_.operand_of(f), table_.corners[g][k], f});
    }
  }

  FacetTable& table_;
  double contact_, graze_;
  std::vector<std::uint32_t> parent_;
  std::vector<Note> noted_;
};

}  // namespace

std::uint32_t FacetTable::operand_of(std::uint32_t facet) const {
  return static_cast<std::uint32_t>(std::upper_bound(first.begin(), first.end(), facet) - first.begin() - 1);
}

FacetTable gather_facets(const std::vector<PolyhedronPtr>& operands, double contact, const std::vector<Vec3>& shifts) {
  FacetTable table;
  std::size_t points = 0, facets = 0;
  for (const auto& solid : operands) points += solid->vertices().size(), facets += solid->triangles().size();
  table.points.reserve(points);
  table.corners.reserve(facets);
  table.neighbours.reserve(facets);
  table.first.push_back(0);
  for (const auto& solid : operands) {
    const auto point_shift = static_cast<std::uint32_t>(table.points.size());
    const auto facet_shift = static_cast<std::uint32_t>(table.corners.size());
    const Vec3 shift = shifts.empty() ? Vec3(Vec3::Zero()) : shifts[table.first.size() - 1];
    for (const Vec3& p : solid->vertices()) table.points.push_back(p + shift);
    for (const Triangle& t : solid->triangles())
      table.corners.push_back({t[0] + point_shift, t[1] + point_shift, t[2] + point_shift});
    for (const Triangle& t : solid->neighbours())
      table.neighbours.push_back({t[0] + facet_shift, t[1] + facet_shift, t[2] + facet_shift});
    table.first.push_back(static_cast<std::uint32_t>(table.corners.size()));
  }
  const double scale = magnitude(table.points);
  find_surfaces(table, rounding_scale * scale);
  if (operands.size() > 1) {
    SurfaceIdentity identity(table, std::max(contact, rounding_scale * scale), graze_scale * scale);
    identity.find();
    identity.apply();
    identity.keep_grazes();
  }
  // Rounding of normal . x - offset itself: three products and sums on unit normals.
  const double evaluation = 8 * 2.220446049250313e-16 * scale;
  for (std::uint32_t f = 0; f < table.size(); ++f) {
    Surface& s = table.surfaces[table.surface[f]];
    s.thickness = std::max(s.thickness, facet_distance(table, s, f) + evaluation);
    if (s.shared) table.contact_moved = std::max(table.contact_moved, s.thickness);
    table.thickest = std::max(table.thickest, s.thickness);
  }
  return table;
}

std::vector<Vec3> shifts_off_grazes(const FacetTable& table, double reach) {
  const std::size_t n = table.first.size() - 1;
  std::vector<Vec3> shifts(n, Vec3::Zero());
  std::vector<char> grazing(n, 0);
  for (const Graze& g : table.grazes) grazing[std::max(g.of, g.on)] = 1;
  // Surfaces that an operand shares must stay where they are: it may only move along all of them.
  std::vector<std::vector<Vec3>> fixed(n);
  for (std::size_t s = 0; s < n; ++s)
    for (std::uint32_t f = table.first[s]; grazing[s] && f < table.first[s + 1]; ++f) {
      const Surface& surface = table.surfaces[table.surface[f]];
      if (!surface.shared) continue;
      Vec3 rest = surface.normal;
      for (const Vec3& u : fixed[s]) rest -= rest.dot(u) * u;
      if (rest.norm() > 1e-6) fixed[s].push_back(rest.normalized());
    }
  for (std::size_t s = 0; s < n; ++s) {
    if (!grazing[s]) continue;
    // No direction is special to the eye, to axes or diagonals; every operand gets one of its own.
    Vec3 direction(0.5547 + 0.083 * std::sin(2.1 * static_cast<double>(s)), 0.6731, 0.4889 + 0.061 * std::cos(1.7 * static_cast<double>(s)));
    for (const Vec3& u : fixed[s]) direction -= direction.dot(u) * u;
    if (direction.norm() > 1e-3) shifts[s] = reach * (0.6 + 0.4 * std::fmod(0.618 * static_cast<double>(s), 1.0)) * direction.normalized();
  }
  return shifts;
}

}  // namespace starcell
