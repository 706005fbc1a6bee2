#include "subdivision/near_facets.h"

#include <algorithm>
#include <numeric>

#include <CGAL/box_intersection_d.h>

namespace starcell {
namespace {

// Operands are searched pair by pair up to this many; more of them all at once.
constexpr std::size_t few_operands = 8;

using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const std::uint32_t*>;

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
  std::vector<std::uint32_t> ids(table.size());
  std::iota(ids.begin(), ids.end(), 0u);
  std::vector<std::vector<Box>> boxes(table.first.size() - 1);
  for (std::size_t s = 0; s < boxes.size(); ++s)
    for (std::uint32_t f = table.first[s]; f < table.first[s + 1]; ++f) {
      const Box3 box = padded_box(table, f, reach);
      if (!box.intersects(others[s])) continue;
      boxes[s].emplace_back(CGAL::Bbox_3(box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()),
                            &ids[f]);
    }
  std::vector<FacetPair> pairs;
  const auto visit = [&](const Box& a, const Box& b) {
    const auto [f, g] = std::minmax(*a.handle(), *b.handle());
    if (boxes.size() <= few_operands || table.operand_of(f) != table.operand_of(g)) pairs.emplace_back(f, g);
  };
  if (boxes.size() <= few_operands) {
    for (std::size_t s = 0; s < boxes.size(); ++s)
      for (std::size_t t = s + 1; t < boxes.size(); ++t)
        CGAL::box_intersection_d(boxes[s].begin(), boxes[s].end(), boxes[t].begin(), boxes[t].end(), visit);
  } else {
    std::vector<Box> all;
    for (const auto& some : boxes) all.insert(all.end(), some.begin(), some.end());
    CGAL::box_self_intersection_d(all.begin(), all.end(), visit);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace starcell
