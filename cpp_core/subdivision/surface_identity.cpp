#include "subdivision/surface_identity.h"

#include "solids/disjoint_sets.h"

namespace starcell {
namespace {

// The canonical plane of a class is that of its largest facet: the best determined one.
void adopt_largest(FacetTable& table, DisjointSets& classes) {
  std::vector<std::uint32_t> best(classes.size(), UINT32_MAX);
  std::vector<double> area(classes.size(), -1);
  for (std::uint32_t f = 0; f < table.size(); ++f) {
    const std::uint32_t r = classes.root(table.surface[f]);
    const double a = table.area_vector(f).norm();
    if (a > area[r]) area[r] = a, best[r] = table.surface[f];
  }
  for (std::uint32_t id = 0; id < classes.size(); ++id) {
    const std::uint32_t r = classes.root(id);
    if (r != id || best[r] == id) continue;
    std::swap(table.surfaces[r].normal, table.surfaces[best[r]].normal);
    std::swap(table.surfaces[r].offset, table.surfaces[best[r]].offset);
  }
}

}  // namespace

void identify_surfaces(FacetTable& table, const std::vector<FacetPair>& pairs, double contact) {
  DisjointSets classes(table.surfaces.size());
  bool any = false;
  for (const auto& [f, g] : pairs) {
    // Each facet against the plane of the other's whole surface: the test is symmetric and does not depend on order.
    if (table.distance(table.surfaces[table.surface[f]], g) > contact ||
        table.distance(table.surfaces[table.surface[g]], f) > contact)
      continue;
    const std::uint32_t a = classes.root(table.surface[f]), b = classes.root(table.surface[g]);
    if (a == b) continue;
    classes.join(a, b);
    any = true;
  }
  if (!any) return;
  adopt_largest(table, classes);
  for (std::uint32_t id = 0; id < classes.size(); ++id)
    if (classes.root(id) != id) table.surfaces[classes.root(id)].shared = true;
  for (std::uint32_t& id : table.surface) id = classes.root(id);
}

}  // namespace starcell
