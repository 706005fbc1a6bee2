#include "minkowski/facet_tree.h"

#include <algorithm>

namespace starcell {
namespace {

constexpr std::uint32_t leaf_size = 2;

}  // namespace

FacetTree::FacetTree(const std::vector<Vec3>& points, const std::vector<Triangle>& facets) : order_(facets.size()) {
  if (facets.empty()) return;
  std::vector<Box3> boxes(facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    order_[f] = f;
    for (const std::uint32_t v : facets[f]) boxes[f].extend(points[v]);
  }
  nodes_.reserve(2 * facets.size());
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(facets.size()), 0});
  for (std::uint32_t at = 0; at < nodes_.size(); ++at) {
    const std::uint32_t first = nodes_[at].first, last = nodes_[at].last;
    Box3 box, middles;
    for (std::uint32_t k = first; k < last; ++k) box.extend(boxes[order_[k]]), middles.extend(boxes[order_[k]].center());
    nodes_[at].box = box;
    if (last - first <= leaf_size) continue;
    int widest = 0;
    middles.sizes().maxCoeff(&widest);
    const std::uint32_t middle = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](std::uint32_t f, std::uint32_t g) {
      const double x = boxes[f].center()[widest], y = boxes[g].center()[widest];
      return x != y ? x < y : f < g;
    });
    nodes_[at].child = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, first, middle, 0});
    nodes_.push_back({{}, middle, last, 0});
  }
}

}  // namespace starcell
