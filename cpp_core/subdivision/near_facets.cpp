#include "subdivision/near_facets.h"

#include <algorithm>

#include <tbb/enumerable_thread_specific.h>

#include "solids/triangle_hierarchy.h"

namespace starcell {
namespace {

Box3 padded_box(const FacetTable& table, std::uint32_t f, double reach) {
  const Box3 box = table.box(f);
  const Vec3 margin = Vec3::Constant(0.5 * reach);
  return {box.min() - margin, box.max() + margin};
}

// Per operand: the box around all others, cut down to what can matter.
std::vector<Box3> others_boxes(const FacetTable& table, double reach) {
  const std::size_t n = table.first.size() - 1;
  std::vector<Box3> own(n), others(n);
  for (std::size_t s = 0; s < n; ++s)
    for (std::uint32_t f = table.first[s]; f < table.first[s + 1]; ++f) own[s].extend(padded_box(table, f, reach));
  for (std::size_t s = 0; s < n; ++s)
    for (std::size_t t = 0; t < n; ++t)
      if (t != s && own[t].intersects(own[s])) others[s].extend(own[t].intersection(own[s]));
  return others;
}

}  // namespace

std::vector<FacetPair> near_facets(const FacetTable& table, double reach) {
  const std::vector<Box3> others = others_boxes(table, reach);
  std::vector<std::uint32_t> facets, operand;
  std::vector<Triangle> corners;
  for (std::uint32_t s = 0; s < others.size(); ++s)
    for (std::uint32_t f = table.first[s]; f < table.first[s + 1]; ++f)
      if (padded_box(table, f, reach).intersects(others[s])) {
        facets.push_back(f);
        operand.push_back(s);
        corners.push_back(table.corners[f]);
      }
  tbb::enumerable_thread_specific<std::vector<FacetPair>> found;
  TriangleHierarchy(table.points, corners, 0.5 * reach).overlapping_pairs([&](std::uint32_t a, std::uint32_t b) {
    if (operand[a] != operand[b]) found.local().emplace_back(facets[a], facets[b]);
    return true;
  });
  std::vector<FacetPair> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace starcell
