#include "subdivision/facets.h"

#include <algorithm>
#include <cmath>

#include "subdivision/candidate_surfaces.h"
#include "subdivision/grazes.h"
#include "subdivision/region_identity.h"
#include "subdivision/near_facets.h"
#include "subdivision/surface_identity.h"

namespace starcell {
namespace {

// Facets of one operand are one surface when they are coplanar to within this share of the coordinates: above double
// rounding, far below what any file format rounds to. Their true planes stay inside the surface's measured thickness, which every certified
// sign takes into account; planes that meet at a smaller angle would have a common line too uncertain to decide by.
constexpr double rounding_scale = 1e-12;

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

// Grows coplanar regions over each polyhedron, largest facets first: their planes are the best determined.
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
        if (table.surface[g] == UINT32_MAX && table.distance(plane, g) <= tolerance) {
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

// The candidates' facets, and where they have been moved. A facet's neighbour is its partner or itself.
void add_candidates(FacetTable& table, const std::vector<CandidateSolidPtr>& candidates, const std::vector<Vec3>& shifts) {
  for (const auto& solid : candidates) {
    const auto point_shift = static_cast<std::uint32_t>(table.points.size());
    const auto facet_shift = static_cast<std::uint32_t>(table.corners.size());
    const Vec3 shift = shifts.empty() ? Vec3(Vec3::Zero()) : shifts[table.first.size() - 1];
    for (const Vec3& p : solid->points()) table.points.push_back(p + shift);
    table.merged.resize(point_shift, 0);
    table.merged.insert(table.merged.end(), solid->merged().begin(), solid->merged().end());
    const auto& facets = solid->facets();
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
      const Triangle& t = facets[f];
      table.corners.push_back({t[0] + point_shift, t[1] + point_shift, t[2] + point_shift});
      const std::uint32_t partner = solid->partners()[f];
      Triangle beside{f + facet_shift, f + facet_shift, f + facet_shift};
      for (int k = 0; k < 3 && partner != f; ++k) {
        const Triangle& other = facets[partner];
        const auto has = [&](std::uint32_t v) { return std::find(other.begin(), other.end(), v) != other.end(); };
        if (has(t[k]) && has(t[(k + 1) % 3])) beside[k] = partner + facet_shift;
      }
      table.neighbours.push_back(beside);
    }
    table.first.push_back(static_cast<std::uint32_t>(table.corners.size()));
    table.candidates.resize(table.first.size() - 1);
    table.candidates.back() = solid;
    table.shifts.resize(table.candidates.size(), Vec3::Zero());
    table.shifts.back() = shift;
  }
}

}  // namespace

Expansion Surface::expand(const Vec3& center, const Vec3& reach) const {
  if (form) return form->expand(center, reach);
  Expansion e;
  e.reach = reach;
  e.value = dot(enclose(center), normal) - offset;
  e.gradient = e.slope = enclose(normal);
  return e;
}

double Surface::value(const Vec3& x, Vec3* gradient) const {
  if (form) return form->value(x, gradient);
  if (gradient) *gradient = normal;
  return normal.dot(x) - offset;
}

double FacetTable::distance(const Surface& s, std::uint32_t facet) const {
  double d = 0;
  for (int k = 0; k < 3; ++k) d = std::max(d, s.distance(corner(facet, k)));
  return d;
}

Box3 FacetTable::box(std::uint32_t facet) const {
  Box3 b(corner(facet, 0));
  return b.extend(corner(facet, 1)).extend(corner(facet, 2));
}

std::uint32_t FacetTable::operand_of(std::uint32_t facet) const {
  return static_cast<std::uint32_t>(std::upper_bound(first.begin(), first.end(), facet) - first.begin() - 1);
}

FacetTable gather_facets(const std::vector<PolyhedronPtr>& operands, double contact, const std::vector<Vec3>& shifts,
                         const std::vector<RegionOperand>& regions, const std::vector<CandidateSolidPtr>& candidates) {
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
  const auto polyhedra = static_cast<std::uint32_t>(operands.size());
  find_surfaces(table, rounding_scale * magnitude(table.points));
  add_candidates(table, candidates, shifts);
  const double scale = magnitude(table.points);
  const double tolerance = std::max(contact, rounding_scale * scale);
  for (std::uint32_t k = polyhedra; k < table.faceted(); ++k)
    find_candidate_surfaces(table, table.first[k], table.first[k + 1], rounding_scale * scale);
  if (table.faceted() > 1) {
    const std::vector<FacetPair> pairs = near_facets(table, tolerance);
    identify_surfaces(table, pairs, tolerance);
    table.grazes = find_grazes(table, pairs, graze_scale * scale);
  }
  // Rounding of normal . x - offset itself: three products and sums on unit normals.
  const double evaluation = 8 * 2.220446049250313e-16 * scale;
  for (std::uint32_t f = 0; f < table.size(); ++f) {
    Surface& s = table.surfaces[table.surface[f]];
    s.thickness = std::max(s.thickness, table.distance(s, f) + evaluation);
    table.thickest = std::max(table.thickest, s.thickness);
  }
  add_regions(table, regions, tolerance, shifts);
  return table;
}

}  // namespace starcell
