#include "contouring/flat_regions.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

#include <tbb/parallel_for.h>

#include "contouring/embedding.h"
#include "contouring/flat_polygon.h"
#include "solids/connectivity.h"
#include "solids/errors.h"

namespace starcell {
namespace {

using Edge = RimEdge;

constexpr std::uint32_t none = UINT32_MAX;
// Worked on in parallel between two looks at the outside world.
constexpr std::size_t regions_at_once = 1024;

class Merger {
 public:
  Merger(SurfaceMesh& mesh, double tolerance, const GoOn& go_on, const std::function<bool()>& hurried)
      : mesh_(mesh), tolerance_(tolerance), go_on_(go_on), hurried_(hurried) {}

  FlatMerge run() {
    Connectivity connectivity = connect(mesh_.vertices, mesh_.triangles);
    if (!connectivity.closed_manifold()) return {};
    neighbours_ = std::move(connectivity.neighbours);
    find_regions();
    std::vector<char> frozen(regions_.size(), 0);
    // Each round freezes at least one region, and a frozen region keeps all its vertices.
    for (int round = 0; round < 20; ++round) {
      classify_vertices(frozen);
      if (!rebuild(frozen)) continue;
      FlatMerge result{tolerance_, true, {}, false};
      const std::vector<char> bad = meeting_regions(result);
      bool again = false;
      for (std::size_t r = 0; r < regions_.size(); ++r)
        if (bad[r] && !frozen[r]) frozen[r] = again = true;
      if (again && hurried_ && hurried_()) std::fill(frozen.begin(), frozen.end(), char{1});
      if (!again) {
        adopt();
        return result;
      }
    }
    return {};  // everything stays as it was
  }

 private:
  void find_regions() {
    region_.assign(mesh_.triangles.size(), none);
    std::vector<std::uint32_t> front;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (region_[t] != none || mesh_.surface[t] == no_surface) continue;
      const auto id = static_cast<std::uint32_t>(regions_.size());
      regions_.emplace_back();
      front.assign(1, t);
      region_[t] = id;
      while (!front.empty()) {
        const std::uint32_t s = front.back();
        front.pop_back();
        regions_[id].push_back(s);
        for (const std::uint32_t n : neighbours_[s])
          if (region_[n] == none && mesh_.surface[n] == mesh_.surface[t]) {
            region_[n] = id;
            front.push_back(n);
          }
      }
      std::sort(regions_[id].begin(), regions_[id].end());
    }
  }

  // keep_[v]: 0 inside a region, 1 a corner or a vertex of the rest, 2 on the line between two regions.
  void classify_vertices(const std::vector<char>& frozen) {
    keep_.assign(mesh_.vertices.size(), 0);
    std::vector<Edge> seen(mesh_.vertices.size(), {none, none});  // up to two regions at each vertex
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t]) {
        const std::uint32_t r = region_[t];
        const bool merges = r != none && !frozen[r];
        if (merges && (seen[v].first == none || seen[v].first == r))
          seen[v].first = r;
        else if (merges && (seen[v].second == none || seen[v].second == r))
          seen[v].second = r;
        else
          keep_[v] = 1;
      }
    std::vector<int> rim(mesh_.vertices.size(), 0);
    for_rim_edges([&](std::uint32_t, const Edge& e) { ++rim[e.first], ++rim[e.second]; });
    for (std::size_t v = 0; v < keep_.size(); ++v) {
      if (keep_[v] || seen[v].second == none) continue;
      // Each rim edge is seen from both regions: a smooth passage has two edges, four sightings.
      keep_[v] = rim[v] == 4 ? 2 : 1;
    }
    check_chains();
  }

  template <class Visit>
  void for_rim_edges(Visit visit) const {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (region_[t] == none || region_[neighbours_[t][k]] != region_[t])
          visit(t, Edge{mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]});
  }

  // Chains of passage vertices must be straight between the corners at their ends; else all of them stay.
  void check_chains() {
    std::unordered_map<std::uint32_t, Edge> ways;  // the two rim neighbours of a passage vertex
    const auto add = [&](std::uint32_t v, std::uint32_t to) {
      if (keep_[v] != 2) return;
      auto [it, fresh] = ways.emplace(v, Edge{to, none});
      if (!fresh && it->second.first != to && it->second.second == none) it->second.second = to;
    };
    for_rim_edges([&](std::uint32_t, const Edge& e) { add(e.first, e.second), add(e.second, e.first); });
    std::vector<char> done(keep_.size(), 0);
    for (std::uint32_t v = 0; v < keep_.size(); ++v) {
      if (keep_[v] != 2 || done[v]) continue;
      std::vector<std::uint32_t> chain{v};
      done[v] = 1;
      std::uint32_t ends[2];
      bool closed = false;
      for (int way = 0; way < 2 && !closed; ++way) {
        std::uint32_t previous = v, at = way == 0 ? ways[v].first : ways[v].second;
        while (at != none && keep_[at] == 2) {
          if (done[at]) {
            closed = true;
            break;
          }
          done[at] = 1;
          chain.push_back(at);
          const Edge& e = ways[at];
          const std::uint32_t next = e.first == previous ? e.second : e.first;
          previous = at;
          at = next;
        }
        ends[way] = at;
      }
      bool straight = !closed && ends[0] != none && ends[1] != none && ends[0] != ends[1];
      if (straight) {
        const Vec3 &a = mesh_.vertices[ends[0]], &b = mesh_.vertices[ends[1]];
        const Vec3 d = (b - a).normalized();
        for (const std::uint32_t c : chain) {
          const Vec3 p = mesh_.vertices[c] - a;
          const double along = p.dot(d);
          straight = straight && along > 0 && along < (b - a).norm() && (p - along * d).norm() <= tolerance_;
        }
      }
      if (!straight)
        for (const std::uint32_t c : chain) keep_[c] = 1;
    }
  }

  // Triangulates every region; false if one had to be frozen.
  bool rebuild(std::vector<char>& frozen) {
    std::vector<std::vector<Edge>> rims(regions_.size());
    for_rim_edges([&](std::uint32_t t, const Edge& e) {
      if (region_[t] != none) rims[region_[t]].push_back(e);
    });
    fresh_.assign(regions_.size(), {});
    std::vector<char> failed(regions_.size(), 0);
    for (std::size_t first = 0; first < regions_.size(); first += regions_at_once) {
      if (go_on_ && !go_on_()) throw CancelledError("The run was cancelled.");
      tbb::parallel_for(first, std::min(first + regions_at_once, regions_.size()), [&](std::size_t r) {
        if (frozen[r]) return;
        if (auto triangles = triangulate(rims[r]))
          fresh_[r] = std::move(*triangles);
        else
          failed[r] = 1;
      });
    }
    bool ok = true;
    for (std::size_t r = 0; r < regions_.size(); ++r)
      if (failed[r]) frozen[r] = 1, ok = false;
    if (!ok) return false;
    new_triangles_.clear();
    new_region_.clear();
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (region_[t] == none || frozen[region_[t]]) {
        new_triangles_.push_back(mesh_.triangles[t]);
        new_region_.push_back(region_[t]);
      }
    for (std::size_t r = 0; r < regions_.size(); ++r)
      for (const Triangle& t : fresh_[r]) {
        new_triangles_.push_back(t);
        new_region_.push_back(static_cast<std::uint32_t>(r));
      }
    return true;
  }

  // The rim with passage vertices skipped: edges between corners.
  std::optional<std::vector<Edge>> corner_edges(const std::vector<Edge>& rim) const {
    std::unordered_map<std::uint32_t, std::uint32_t> next;  // of passage vertices
    for (const Edge& e : rim)
      if (keep_[e.first] == 2 && !next.emplace(e.first, e.second).second) return std::nullopt;
    std::vector<Edge> edges;
    for (const Edge& e : rim) {
      if (keep_[e.first] != 1) continue;
      std::uint32_t to = e.second;
      for (std::size_t guard = 0; keep_[to] == 2; ++guard) {
        const auto it = next.find(to);
        if (it == next.end() || guard > rim.size()) return std::nullopt;
        to = it->second;
      }
      if (to == e.first) return std::nullopt;
      edges.emplace_back(e.first, to);
    }
    return edges;
  }

  std::optional<std::vector<Triangle>> triangulate(const std::vector<Edge>& rim) const {
    const auto edges = corner_edges(rim);
    return edges ? triangulate_flat(mesh_.vertices, *edges) : std::nullopt;
  }

  std::vector<char> meeting_regions(FlatMerge& result) const {
    std::vector<char> bad(regions_.size(), 0);
    std::vector<RoundedAxes> roundings{no_axis};
    roundings.insert(roundings.end(), every_rounding.begin(), every_rounding.end());
    const auto meeting = meeting_pairs(mesh_.vertices, new_triangles_, roundings, go_on_);
    result.embedded = meeting[0].empty();
    result.depends_on_rounding = std::any_of(meeting.begin() + 1, meeting.end(), [](const auto& pairs) { return !pairs.empty(); });
    for (const auto& pairs : {meeting[0], meeting[1]})
      for (const std::uint32_t t : triangles_of(pairs))
        if (new_region_[t] != none) bad[new_region_[t]] = 1;
    for (const std::uint32_t t : triangles_of(meeting[1])) {
      Box3 box;
      for (const std::uint32_t v : new_triangles_[t]) box.extend(mesh_.vertices[v]);
      result.meeting_as_floats.push_back(box);
    }
    return bad;
  }

  void adopt() {
    std::vector<std::uint32_t> map(mesh_.vertices.size(), none);
    SurfaceMesh next;
    std::vector<std::uint32_t> surface_of_region;
    for (const auto& region : regions_) surface_of_region.push_back(mesh_.surface[region.front()]);
    for (const Triangle& t : new_triangles_)
      for (const std::uint32_t v : t) map[v] = 0;
    for (std::size_t v = 0; v < map.size(); ++v)
      if (map[v] != none) {
        map[v] = static_cast<std::uint32_t>(next.vertices.size());
        next.vertices.push_back(mesh_.vertices[v]);
      }
    for (std::size_t t = 0; t < new_triangles_.size(); ++t) {
      const Triangle& x = new_triangles_[t];
      next.triangles.push_back({map[x[0]], map[x[1]], map[x[2]]});
      next.surface.push_back(new_region_[t] == none ? no_surface : surface_of_region[new_region_[t]]);
    }
    mesh_ = std::move(next);
  }

  SurfaceMesh& mesh_;
  double tolerance_;
  const GoOn& go_on_;
  const std::function<bool()>& hurried_;
  std::vector<Triangle> neighbours_;
  std::vector<std::uint32_t> region_;
  std::vector<std::vector<std::uint32_t>> regions_;
  std::vector<char> keep_;
  std::vector<std::vector<Triangle>> fresh_;
  std::vector<Triangle> new_triangles_;
  std::vector<std::uint32_t> new_region_;
};

}  // namespace

FlatMerge merge_flat_regions(SurfaceMesh& mesh, double tolerance, const GoOn& go_on, const std::function<bool()>& hurried) {
  if (mesh.triangles.empty()) return {0, true, {}, false};
  return Merger(mesh, tolerance, go_on, hurried).run();
}

}  // namespace starcell
