#include "remeshing/size_field.h"

#include <algorithm>
#include <map>
#include <queue>

#include "isotopy/triangle_grid.h"

namespace starcell {
namespace {

// How fast sizes grow, by distance.
constexpr double growth = 0.4;

double distance_to_segment(const Vec3& x, const Vec3& p, const Vec3& q) {
  const Vec3 along = q - p;
  const double square = along.squaredNorm(), at = square > 0 ? std::clamp((x - p).dot(along) / square, 0.0, 1.0) : 0;
  return (x - p - at * along).norm();
}

// What sharp edges leave room for, at the vertices on them.
void leave_room(const std::vector<Vec3>& places, const Features& features, double least, std::vector<double>& size) {
  const auto limit = [&](std::uint32_t v, double length) {
    if (length >= least) size[v] = std::min(size[v], length);
  };
  const std::vector<Run> all = runs(features, places);
  if (all.empty()) return;
  double mean = 0;
  std::map<std::uint32_t, std::vector<std::uint32_t>> ending;   // per corner: its runs
  for (std::uint32_t r = 0; r < all.size(); ++r) {
    const double length = (places[all[r].to] - places[all[r].from]).norm();
    mean += length / static_cast<double>(all.size());
    for (const std::uint32_t corner : {all[r].from, all[r].to}) {
      limit(corner, length);
      ending[corner].push_back(r);
    }
  }
  TriangleGrid grid(2 * mean);
  for (std::uint32_t r = 0; r < all.size(); ++r) grid.add(r, Box3(places[all[r].from]).extend(places[all[r].to]));
  const auto look_about = [&](std::uint32_t v, const std::vector<std::uint32_t>& own) {
    std::vector<std::uint32_t> beside;
    for (const std::uint32_t r : own)
      for (const std::uint32_t corner : {all[r].from, all[r].to}) beside.insert(beside.end(), ending[corner].begin(), ending[corner].end());
    const Box3 about(places[v] - Vec3::Constant(size[v]), places[v] + Vec3::Constant(size[v]));
    for (const std::uint32_t r : grid.near(about))
      if (!std::count(beside.begin(), beside.end(), r)) limit(v, distance_to_segment(places[v], places[all[r].from], places[all[r].to]));
  };
  for (const auto& [corner, own] : ending) look_about(corner, own);
  for (std::uint32_t r = 0; r < all.size(); ++r)
    for (const std::uint32_t v : all[r].between) look_about(v, {r});
}

}  // namespace

std::vector<double> sizes(const std::vector<Vec3>& places, const std::vector<std::array<std::uint32_t, 2>>& edges, const Features& features, std::vector<double> most,
                          double least) {
  std::vector<double> size = std::move(most);
  leave_room(places, features, least, size);
  std::vector<std::vector<std::uint32_t>> joined(places.size());
  for (const auto& [a, b] : edges) {
    joined[a].push_back(b);
    joined[b].push_back(a);
  }
  using Next = std::pair<double, std::uint32_t>;
  std::priority_queue<Next, std::vector<Next>, std::greater<>> queue;
  for (std::uint32_t v = 0; v < places.size(); ++v)
    if (!joined[v].empty()) queue.emplace(size[v], v);
  while (!queue.empty()) {
    const auto [s, v] = queue.top();
    queue.pop();
    if (s > size[v]) continue;
    for (const std::uint32_t w : joined[v])
      if (const double grown = s + growth * (places[w] - places[v]).norm(); grown < size[w]) queue.emplace(size[w] = grown, w);
  }
  return size;
}

}  // namespace starcell
