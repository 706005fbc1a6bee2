#include "subdivision/voxel_link.h"

#include <algorithm>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include "numerics/predicates.h"
#include "solids/disjoint_sets.h"
#include "subdivision/grid_line.h"

namespace starcell {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Pairs beyond this are cheaper to subdivide than to test.
constexpr std::size_t max_pairs = 20000;

// All corners of g strictly on one side of f's plane.
bool one_side(const FacetTable& table, std::uint32_t f, std::uint32_t g) {
  const Vec3 &a = table.corner(f, 0), &b = table.corner(f, 1), &c = table.corner(f, 2);
  const int s = side(a, b, c, table.corner(g, 0));
  return s != 0 && side(a, b, c, table.corner(g, 1)) == s && side(a, b, c, table.corner(g, 2)) == s;
}

bool facets_touch(const FacetTable& table, std::uint32_t f, std::uint32_t g) {
  if (one_side(table, f, g) || one_side(table, g, f)) return false;
  const auto triangle = [&](std::uint32_t t) {
    const auto point = [&](int k) {
      const Vec3& p = table.corner(t, k);
      return Kernel::Point_3(p.x(), p.y(), p.z());
    };
    return Kernel::Triangle_3(point(0), point(1), point(2));
  };
  return CGAL::do_intersect(triangle(f), triangle(g));
}

}  // namespace

std::vector<Group> link_groups(const Restriction& restriction, const CellProblem& problem, const Box3& box) {
  const FacetTable& table = restriction.table();
  const auto& facets = problem.facets;
  DisjointSets sets(facets.size());
  std::vector<int> edges(facets.size(), 0), vertices(facets.size(), 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> inside;  // mesh vertex in the cell, a facet at it
  for (std::uint32_t i = 0; i < facets.size(); ++i) {
    const std::uint32_t f = facets[i];
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = table.corner(f, k);
      if (box_contains(box, p)) inside.emplace_back(table.corners[f][k], i);
      const std::uint32_t g = table.neighbours[f][k];
      if (g < f) continue;
      if (!box_meets_segment(p, table.corner(f, (k + 1) % 3), box)) continue;
      const auto it = std::lower_bound(facets.begin() + i, facets.end(), g);
      if (it == facets.end() || *it != g) continue;  // cannot happen: g meets the cell along this edge
      sets.join(i, static_cast<std::uint32_t>(it - facets.begin()));
      ++edges[i];
    }
  }
  std::sort(inside.begin(), inside.end());
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (i == 0 || inside[i].first != inside[i - 1].first) ++vertices[inside[i].second];
  std::vector<Group> groups;
  std::vector<std::uint32_t> group_of(facets.size(), UINT32_MAX);
  for (std::uint32_t i = 0; i < facets.size(); ++i) {
    const std::uint32_t r = sets.root(i);
    if (group_of[r] == UINT32_MAX) {
      group_of[r] = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back();
      groups.back().slot = restriction.slot_of(problem, facets[i]);
    }
    Group& group = groups[group_of[r]];
    group.facets.push_back(facets[i]);
    group.characteristic += 1 - edges[i] + vertices[i];
  }
  return groups;
}

bool groups_may_cross(const Restriction& restriction, const CellProblem& problem, const Box3& box) {
  if (problem.slots() < 2) return false;
  const FacetTable& table = restriction.table();
  const auto& facets = problem.facets;
  std::vector<Box3> boxes;
  std::vector<std::uint32_t> slots;
  for (const std::uint32_t f : facets) {
    boxes.push_back(table.box(f).intersection(box));
    slots.push_back(restriction.slot_of(problem, f));
  }
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < facets.size(); ++i)
    for (std::size_t j = i + 1; j < facets.size(); ++j) {
      if (slots[i] == slots[j]) continue;
      if (++pairs > max_pairs) return true;
      if (table.surface[facets[i]] == table.surface[facets[j]]) return true;
      if (!boxes[i].intersects(boxes[j])) continue;
      if (facets_touch(table, facets[i], facets[j])) return true;
    }
  return false;
}

std::vector<Vec3> clip_facet(const FacetTable& table, std::uint32_t facet, const Box3& box) {
  std::vector<Vec3> polygon{table.corner(facet, 0), table.corner(facet, 1), table.corner(facet, 2)}, next;
  for (int side = 0; side < 6 && !polygon.empty(); ++side) {
    const int axis = side / 2;
    const double limit = side % 2 ? box.max()[axis] : box.min()[axis];
    const auto depth = [&](const Vec3& p) { return side % 2 ? limit - p[axis] : p[axis] - limit; };
    next.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double dp = depth(p), dq = depth(q);
      if (dp >= 0) next.push_back(p);
      if ((dp >= 0) != (dq >= 0)) {
        Vec3 x = p + (dp / (dp - dq)) * (q - p);
        x[axis] = limit;
        next.push_back(x);
      }
    }
    polygon.swap(next);
  }
  return polygon;
}

bool classify_groups(const Restriction& restriction, const CellProblem& problem, const Box3& box,
                     std::vector<Group>& groups) {
  const FacetTable& table = restriction.table();
  const double margin = 1e-12 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  for (Group& group : groups) {
    Membership around = 0;
    if (problem.slots() > 1) {
      const std::uint32_t operand = problem.expression.solids()[group.slot];
      const auto own = [&](std::uint32_t f) { return f >= table.first[operand] && f < table.first[operand + 1]; };
      std::optional<Membership> found;
      const std::size_t step = std::max<std::size_t>(1, group.facets.size() / 8);
      for (std::size_t i = 0; i < group.facets.size() && !found; i += step) {
        const std::vector<Vec3> polygon = clip_facet(table, group.facets[i], box);
        if (polygon.size() < 3) continue;
        Vec3 x = Vec3::Zero();
        for (const Vec3& p : polygon) x += p;
        found = restriction.mask_near(problem, x / static_cast<double>(polygon.size()), margin, own);
      }
      if (!found) return false;
      around = *found;
    }
    const Membership bit = Membership{1} << group.slot;
    const bool within = problem.expression.value(around | bit), without = problem.expression.value(around & ~bit);
    group.contributes = within != without;
    group.flip = without;
  }
  return true;
}

}  // namespace starcell
