#include "cad/planar_faces.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace starcell::cad {
namespace {

constexpr std::uint32_t none = 0xffffffffu;
constexpr int fits = 4;  ///< how often a region's plane is fitted and the region grown anew

int next(int k) { return k == 2 ? 0 : k + 1; }

/// The edge from corner k to corner k + 1 of a triangle.
struct HalfEdge {
  std::uint32_t triangle;
  int k;
};

struct Plane {
  Vec3 point, normal;
  double distance(const Vec3& p) const { return std::abs(normal.dot(p - point)); }
};

class Regions {
 public:
  Regions(const Polyhedron& mesh, double tolerance, const std::vector<char>& alone)
      : mesh_(mesh), tolerance_(tolerance), alone_(alone), of_(mesh.triangles().size(), none), seen_(of_.size(), none) {
    areas_.reserve(of_.size());
    for (std::uint32_t t = 0; t < of_.size(); ++t) {
      areas_.push_back(cross(t));
      const double longest = std::max({(at(t, 1) - at(t, 0)).norm(), (at(t, 2) - at(t, 1)).norm(), (at(t, 0) - at(t, 2)).norm()});
      thin_.push_back(areas_.back().norm() <= tolerance_ * longest);
    }
    std::vector<std::uint32_t> order(of_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return areas_[a].squaredNorm() > areas_[b].squaredNorm(); });
    for (const std::uint32_t seed : order)
      if (of_[seed] == none) add(seed);
  }

  std::vector<PlanarFace> faces;
  std::uint32_t of(std::uint32_t triangle) const { return of_[triangle]; }

 private:
  const Vec3& at(std::uint32_t t, int k) const { return mesh_.vertices()[mesh_.triangles()[t][static_cast<std::size_t>(k)]]; }
  Vec3 cross(std::uint32_t t) const { return (at(t, 1) - at(t, 0)).cross(at(t, 2) - at(t, 0)); }

  void add(std::uint32_t seed) {
    Plane plane{(at(seed, 0) + at(seed, 1) + at(seed, 2)) / 3, areas_[seed].stableNormalized()};
    std::vector<std::uint32_t> region{seed};
    if (!alone_[seed]) region = grown(seed, plane);
    for (int i = 0; i < fits && region.size() > 1; ++i) {
      const Plane better = fitted(region);
      if (!(better.normal.norm() > 0.5) || !fits_in(seed, better)) break;
      std::vector<std::uint32_t> larger = grown(seed, better);
      if (larger.size() < region.size()) break;
      const bool done = larger.size() == region.size();
      plane = better;
      region = std::move(larger);
      if (done) break;
    }
    PlanarFace face{plane.point, plane.normal, 0, std::move(region), {}};
    for (const std::uint32_t t : face.triangles) {
      of_[t] = static_cast<std::uint32_t>(faces.size());
      for (int k = 0; k < 3; ++k) face.away = std::max(face.away, plane.distance(at(t, k)));
    }
    faces.push_back(std::move(face));
  }

  bool fits_in(std::uint32_t t, const Plane& plane) const {
    for (int k = 0; k < 3; ++k)
      if (!(plane.distance(at(t, k)) <= tolerance_)) return false;
    return thin_[t] || areas_[t].dot(plane.normal) > 0;
  }

  std::vector<std::uint32_t> grown(std::uint32_t seed, const Plane& plane) {
    ++round_;
    std::vector<std::uint32_t> region{seed};
    seen_[seed] = round_;
    for (std::size_t i = 0; i < region.size(); ++i)
      for (const std::uint32_t t : mesh_.neighbours()[region[i]]) {
        if (seen_[t] == round_ || of_[t] != none || alone_[t] || !fits_in(t, plane)) continue;
        seen_[t] = round_;
        region.push_back(t);
      }
    return region;
  }

  /// The sum of the area vectors depends on the region's boundary only: the rounding of its inner vertices cancels.
  Plane fitted(const std::vector<std::uint32_t>& region) const {
    Vec3 normal = Vec3::Zero(), point = Vec3::Zero();
    for (const std::uint32_t t : region) {
      normal += areas_[t];
      point += (at(t, 0) + at(t, 1) + at(t, 2)) / 3;
    }
    return {point / static_cast<double>(region.size()), normal.stableNormalized()};
  }

  const Polyhedron& mesh_;
  double tolerance_;
  const std::vector<char>& alone_;
  std::vector<std::uint32_t> of_;
  std::vector<std::uint32_t> seen_;  ///< the round that last looked at a triangle
  std::uint32_t round_ = 0;
  std::vector<Vec3> areas_;  ///< twice the area, along the normal
  std::vector<char> thin_;   ///< height at most the tolerance: the direction of the normal says nothing
};

class Boundaries {
 public:
  Boundaries(const Polyhedron& mesh, const Regions& regions, double tolerance)
      : mesh_(mesh), regions_(regions), tolerance_(tolerance), degree_(mesh.vertices().size(), 0), keep_(degree_.size(), 1) {}

  void run(std::vector<PlanarFace>& faces) {
    for (std::uint32_t t = 0; t < mesh_.triangles().size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (is_boundary({t, k})) ++degree_[start({t, k})];
    straighten();
    collect(faces);
    for (PlanarFace& face : faces)
      for (auto& loop : face.loops) restore_if_short(loop);
    for (PlanarFace& face : faces)
      for (auto& loop : face.loops) std::erase_if(loop, [&](std::uint32_t v) { return !keep_[v]; });
  }

 private:
  std::uint32_t start(HalfEdge h) const { return mesh_.triangles()[h.triangle][static_cast<std::size_t>(h.k)]; }
  std::uint32_t end(HalfEdge h) const { return mesh_.triangles()[h.triangle][static_cast<std::size_t>(next(h.k))]; }
  std::uint32_t across(HalfEdge h) const { return mesh_.neighbours()[h.triangle][static_cast<std::size_t>(h.k)]; }
  bool is_boundary(HalfEdge h) const { return regions_.of(h.triangle) != regions_.of(across(h)); }

  HalfEdge twin(HalfEdge h) const {
    const std::uint32_t t = across(h);
    int k = 0;
    while (start({t, k}) != end(h)) ++k;
    return {t, k};
  }
  /// Along the boundary of the same region, through the same fan of its triangles around the common vertex.
  HalfEdge following(HalfEdge h) const {
    HalfEdge g{h.triangle, next(h.k)};
    while (!is_boundary(g)) {
      g = twin(g);
      g.k = next(g.k);
    }
    return g;
  }

  /// Loops of every face, cut where they pass through a vertex again.
  void collect(std::vector<PlanarFace>& faces) const {
    std::vector<char> done(3 * mesh_.triangles().size(), 0);
    std::vector<std::uint32_t> place(mesh_.vertices().size(), none);  // in the path
    for (PlanarFace& face : faces)
      for (const std::uint32_t t : face.triangles)
        for (int k = 0; k < 3; ++k) {
          std::vector<std::uint32_t> path;
          for (HalfEdge h{t, k}; is_boundary(h) && !done[3 * h.triangle + static_cast<std::uint32_t>(h.k)]; h = following(h)) {
            done[3 * h.triangle + static_cast<std::uint32_t>(h.k)] = 1;
            const std::uint32_t v = start(h);
            if (place[v] != none) cut(path, place, place[v], face);
            place[v] = static_cast<std::uint32_t>(path.size());
            path.push_back(v);
          }
          if (!path.empty()) cut(path, place, 0, face);
        }
  }

  static void cut(std::vector<std::uint32_t>& path, std::vector<std::uint32_t>& place, std::uint32_t from, PlanarFace& face) {
    std::vector<std::uint32_t> loop(path.begin() + from, path.end());
    for (const std::uint32_t v : loop) place[v] = none;
    path.resize(from);
    face.loops.push_back(std::move(loop));
  }

  /// Decides which vertices between exactly two regions stay.
  void straighten() {
    std::vector<char> done(3 * mesh_.triangles().size(), 0);
    const auto follow = [&](HalfEdge h) {
      std::vector<std::uint32_t> chain{start(h)};
      do {
        const HalfEdge g = twin(h);
        done[3 * h.triangle + static_cast<std::uint32_t>(h.k)] = done[3 * g.triangle + static_cast<std::uint32_t>(g.k)] = 1;
        chain.push_back(end(h));
        h = following(h);
      } while (degree_[chain.back()] == 2 && chain.back() != chain.front());
      return chain;
    };
    for (const bool from_nodes : {true, false})  // then what is left: closed chains between two regions
      for (std::uint32_t t = 0; t < mesh_.triangles().size(); ++t)
        for (int k = 0; k < 3; ++k) {
          const HalfEdge h{t, k};
          if (done[3 * t + static_cast<std::uint32_t>(k)] || !is_boundary(h) || (degree_[start(h)] > 2) != from_nodes) continue;
          std::vector<std::uint32_t> chain = follow(h);
          for (const std::uint32_t v : chain) keep_[v] = degree_[v] > 2;
          if (chain.front() != chain.back())
            straighten(chain, 0, chain.size() - 1);
          else
            straighten_closed(chain);
        }
  }

  void straighten_closed(std::vector<std::uint32_t>& chain) {
    const auto& p = mesh_.vertices();
    const auto farthest = [&] {
      return std::max_element(chain.begin(), chain.end(), [&](auto a, auto b) {
        return (p[a] - p[chain[0]]).squaredNorm() < (p[b] - p[chain[0]]).squaredNorm();
      });
    };
    if (degree_[chain[0]] == 2) {  // what is farthest from some vertex is a corner: start there
      chain.pop_back();
      std::rotate(chain.begin(), farthest(), chain.end());
      chain.push_back(chain[0]);
    }
    const auto middle = static_cast<std::size_t>(farthest() - chain.begin());
    keep_[chain[0]] = keep_[chain[middle]] = 1;
    straighten(chain, 0, middle);
    straighten(chain, middle, chain.size() - 1);
  }

  /// Keeps what deviates from the straight line between two kept vertices, the farthest first, or runs back along it.
  void straighten(const std::vector<std::uint32_t>& chain, std::size_t first, std::size_t last) {
    std::vector<std::pair<std::size_t, std::size_t>> parts{{first, last}};
    while (!parts.empty()) {
      const auto [a, b] = parts.back();
      parts.pop_back();
      const std::size_t bend = bend_of(chain, a, b);
      if (bend == a) continue;
      keep_[chain[bend]] = 1;
      parts.emplace_back(a, bend);
      parts.emplace_back(bend, b);
    }
  }

  /// Where the chain has to be divided; `a` if it is straight.
  std::size_t bend_of(const std::vector<std::uint32_t>& chain, std::size_t a, std::size_t b) const {
    const auto& p = mesh_.vertices();
    const Vec3 origin = p[chain[a]], along = (p[chain[b]] - origin).stableNormalized();
    std::size_t bend = a;
    double farthest = tolerance_;
    for (std::size_t i = a + 1; i < b; ++i) {
      const Vec3 q = p[chain[i]] - origin;
      const double off = (q - q.dot(along) * along).norm();
      if (off > farthest) {
        farthest = off;
        bend = i;
      }
    }
    for (std::size_t i = a + 1; i <= b && bend == a; ++i)
      if (!((p[chain[i]] - p[chain[i - 1]]).dot(along) > 0)) bend = i < b ? i : i - 1;
    return bend;
  }

  void restore_if_short(const std::vector<std::uint32_t>& loop) {
    if (std::count_if(loop.begin(), loop.end(), [&](std::uint32_t v) { return keep_[v]; }) < 3)
      for (const std::uint32_t v : loop) keep_[v] = 1;
  }

  const Polyhedron& mesh_;
  const Regions& regions_;
  double tolerance_;
  std::vector<int> degree_;  ///< vertex: boundary edges there
  std::vector<char> keep_;
};

}  // namespace

std::vector<PlanarFace> planar_faces(const Polyhedron& mesh, double tolerance, const std::vector<char>& alone) {
  Regions regions(mesh, tolerance, alone);
  Boundaries(mesh, regions, tolerance).run(regions.faces);
  return std::move(regions.faces);
}

}  // namespace starcell::cad
