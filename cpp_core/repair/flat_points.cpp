#include "repair/flat_points.h"

#include <algorithm>
#include <map>

namespace starcell {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

class Flattening {
 public:
  explicit Flattening(ExactSurface& surface) : points_(surface.points), triangles_(surface.triangles), about_(surface.points.size()) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (const std::uint32_t v : triangles_[t]) about_[v].push_back(t);
  }

  bool take_out(std::uint32_t v) {
    const std::vector<std::uint32_t> ring = neighbours(v);
    if (ring.size() != about_[v].size() || ring.size() < 3 || !is_one_cycle(v)) return false;   // surfaces touch here
    return std::any_of(ring.begin(), ring.end(), [&](std::uint32_t w) { return moves_onto(v, w); });
  }

  void compact() {
    std::erase_if(triangles_, [](const Triangle& t) { return t[0] == none; });
  }

 private:
  std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : about_[v])
      for (const std::uint32_t w : triangles_[t])
        if (w != v) found.push_back(w);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  // The two others, in order.
  std::pair<std::uint32_t, std::uint32_t> opposite(std::uint32_t t, std::uint32_t v) const {
    const std::size_t k = static_cast<std::size_t>(std::find(triangles_[t].begin(), triangles_[t].end(), v) - triangles_[t].begin());
    return {triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]};
  }

  bool is_one_cycle(std::uint32_t v) const {
    std::map<std::uint32_t, std::uint32_t> next;
    for (const std::uint32_t t : about_[v])
      if (!next.emplace(opposite(t, v)).second) return false;
    std::uint32_t at = next.begin()->first;
    for (std::size_t step = 0; step < next.size(); ++step) {
      const auto to = next.find(at);
      if (to == next.end()) return false;
      at = to->second;
      if (at == next.begin()->first) return step + 1 == next.size();
    }
    return false;
  }

  bool moves_onto(std::uint32_t v, std::uint32_t w) {
    const std::vector<std::uint32_t> of_v = neighbours(v), of_w = neighbours(w);
    std::vector<std::uint32_t> common;
    std::set_intersection(of_v.begin(), of_v.end(), of_w.begin(), of_w.end(), std::back_inserter(common));
    if (common.size() != 2 || about_[common[0]].size() <= 3 || about_[common[1]].size() <= 3) return false;
    for (const std::uint32_t t : about_[v]) {
      const auto [a, b] = opposite(t, v);
      if (a == w || b == w) continue;
      if (CGAL::orientation(points_[v], points_[a], points_[b], points_[w]) != CGAL::COPLANAR) return false;
      // On the same side of the edge that stays.
      const auto normal = CGAL::cross_product(points_[b] - points_[a], points_[v] - points_[a]), moved = CGAL::cross_product(points_[b] - points_[a], points_[w] - points_[a]);
      if (!(normal * moved > 0)) return false;
    }
    for (const std::uint32_t t : about_[v]) {
      const auto [a, b] = opposite(t, v);
      if (a == w || b == w) {
        for (const std::uint32_t u : {a, b}) std::erase(about_[u], t);
        triangles_[t] = {none, none, none};
        continue;
      }
      std::replace(triangles_[t].begin(), triangles_[t].end(), v, w);
      about_[w].push_back(t);
    }
    about_[v].clear();
    return true;
  }

  const std::vector<ExactPoint>& points_;
  std::vector<Triangle>& triangles_;
  std::vector<std::vector<std::uint32_t>> about_;
};

}  // namespace

void take_out_flat_points(ExactSurface& surface, std::uint32_t first, const std::function<void()>& pause) {
  Flattening flattening(surface);
  for (bool again = true; again;) {   // what is taken out makes room for others
    again = false;
    for (std::uint32_t v = first; v < surface.points.size(); ++v) {
      if (v % 64 == 0) pause();
      again = flattening.take_out(v) || again;
    }
  }
  flattening.compact();
}

}  // namespace starcell
