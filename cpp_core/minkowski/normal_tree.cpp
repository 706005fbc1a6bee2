#include "minkowski/normal_tree.h"

#include <algorithm>
#include <cmath>

namespace starcell {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr double slack = 1e-9;

bool meet(const NormalCap& a, const NormalCap& b) {
  const double reach = a.angle + b.angle + slack;
  return reach >= 3.1415 || angle_between(a.axis, b.axis) <= reach;
}

}  // namespace

NormalTree::NormalTree(std::vector<NormalCap> caps) : caps_(std::move(caps)), items_(caps_.size()) {
  for (std::uint32_t i = 0; i < items_.size(); ++i) items_[i] = i;
  if (items_.empty()) return;
  nodes_.reserve(items_.size() + 1);
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(items_.size()), 0});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) build(node);
}

void NormalTree::build(std::uint32_t at) {
  const std::uint32_t first = nodes_[at].first, last = nodes_[at].last;
  Vec3 sum = Vec3::Zero(), low = Vec3::Constant(2), high = -low;
  for (std::uint32_t k = first; k < last; ++k) {
    const Vec3& axis = caps_[items_[k]].axis;
    sum += axis;
    low = low.cwiseMin(axis);
    high = high.cwiseMax(axis);
  }
  NormalCap cap;
  if (sum.norm() > 1e-9) cap.axis = sum.normalized();
  for (std::uint32_t k = first; k < last; ++k) cap.angle = std::max(cap.angle, angle_between(cap.axis, caps_[items_[k]].axis) + caps_[items_[k]].angle + slack);
  nodes_[at].cap = cap;
  if (last - first <= leaf_size) return;
  int widest = 0;
  (high - low).maxCoeff(&widest);
  const std::uint32_t middle = (first + last) / 2;
  std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last, [&](std::uint32_t i, std::uint32_t j) {
    const double x = caps_[i].axis[widest], y = caps_[j].axis[widest];
    return x != y ? x < y : i < j;
  });
  nodes_[at].child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, middle, 0});
  nodes_.push_back({{}, middle, last, 0});
}

void NormalTree::meeting(const NormalTree& a, const NormalTree& b, const std::function<void(std::uint32_t, std::uint32_t)>& visit) {
  if (a.nodes_.empty() || b.nodes_.empty()) return;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const Node &m = a.nodes_[i], &n = b.nodes_[j];
    if (!meet(m.cap, n.cap)) continue;
    if (m.child == 0 && n.child == 0) {
      for (std::uint32_t k = m.first; k < m.last; ++k)
        for (std::uint32_t l = n.first; l < n.last; ++l)
          if (meet(a.caps_[a.items_[k]], b.caps_[b.items_[l]])) visit(a.items_[k], b.items_[l]);
    } else if (n.child == 0 || (m.child != 0 && m.last - m.first >= n.last - n.first)) {
      stack.emplace_back(m.child, j);
      stack.emplace_back(m.child + 1, j);
    } else {
      stack.emplace_back(i, n.child);
      stack.emplace_back(i, n.child + 1);
    }
  }
}

}  // namespace starcell
