#include "remeshing/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "solids/connectivity.h"
#include "solids/disjoint_sets.h"

namespace starcell {
namespace {

// Of the coordinates: how far from a line a point on it is rounded.
constexpr double rounding = 1e-15;

// Slivers together with what they are a part of, and which way that faces.
class Faces {
 public:
  Faces(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, const std::vector<Triangle>& across, double sliver)
      : together_(triangles.size()), normal_(triangles.size(), Vec3::Zero()) {
    std::vector<Vec3> twice_area;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Triangle& c = triangles[t];
      const std::array<double, 3> side{(vertices[c[1]] - vertices[c[0]]).norm(), (vertices[c[2]] - vertices[c[1]]).norm(), (vertices[c[0]] - vertices[c[2]]).norm()};
      twice_area.push_back((vertices[c[1]] - vertices[c[0]]).cross(vertices[c[2]] - vertices[c[0]]));
      const std::size_t longest = static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
      if (twice_area.back().norm() <= sliver * side[longest]) together_.join(t, across[t][longest]);
    }
    std::vector<double> largest(triangles.size(), 0.0);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const std::uint32_t all = together_.root(t);
      if (const double size = twice_area[t].norm(); size > largest[all]) largest[all] = size, normal_[all] = twice_area[t] / size;
    }
  }
  // The cosine of the angle by which the surface turns from one to the other.
  double turn(std::uint32_t s, std::uint32_t t) { return together_.root(s) == together_.root(t) ? 1 : normal_[together_.root(s)].dot(normal_[together_.root(t)]); }

 private:
  DisjointSets together_;
  std::vector<Vec3> normal_;
};

}  // namespace

Features::Features(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double angle, double sliver) : along_(vertices.size()) {
  const std::vector<Triangle> across = connect(vertices, triangles).neighbours;
  Faces faces(vertices, triangles, across, sliver);
  const double least = std::cos(angle);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t other = across[t][k], a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      if (other <= t || !(faces.turn(t, other) < least)) continue;
      along_[a].push_back(b);
      along_[b].push_back(a);
    }
}

bool Features::has(std::uint32_t a, std::uint32_t b) const { return std::count(along(a).begin(), along(a).end(), b) > 0; }

bool Features::is_straight(std::uint32_t v, const std::vector<Vec3>& places) const {
  if (along(v).size() != 2) return false;
  const Vec3 &x = places[v], &p = places[along(v)[0]], &q = places[along(v)[1]];
  const double largest = std::max({x.cwiseAbs().maxCoeff(), p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff()}), length = (q - p).norm();
  return length > 0 && (x - p).dot(q - x) > 0 && (x - p).cross(q - p).norm() <= 4 * rounding * largest * length;
}

std::size_t Features::size() const {
  std::size_t ends = 0;
  for (const auto& list : along_) ends += list.size();
  return ends / 2;
}

void Features::split(std::uint32_t a, std::uint32_t b, std::uint32_t between) {
  if (!has(a, b)) return;
  if (along_.size() <= between) along_.resize(between + 1);
  *std::find(along_[a].begin(), along_[a].end(), b) = between;
  *std::find(along_[b].begin(), along_[b].end(), a) = between;
  along_[between] = {a, b};
}

void Features::straighten(std::uint32_t v) {
  const std::uint32_t p = along_[v][0], q = along_[v][1];
  *std::find(along_[p].begin(), along_[p].end(), v) = q;
  *std::find(along_[q].begin(), along_[q].end(), v) = p;
  along_[v].clear();
}

std::vector<Run> runs(const Features& features, const std::vector<Vec3>& places) {
  std::vector<Run> found;
  for (std::uint32_t v = 0; v < places.size(); ++v) {
    if (features.is_free(v) || features.is_straight(v, places)) continue;
    for (const std::uint32_t first : features.along(v)) {
      Run run{v, first, {}};
      for (std::uint32_t before = v; run.to != v && features.is_straight(run.to, places);) {
        run.between.push_back(run.to);
        const auto& both = features.along(run.to);
        const std::uint32_t next = both[both[0] == before ? 1 : 0];
        before = std::exchange(run.to, next);
      }
      if (v <= run.to) found.push_back(std::move(run));   // the other way round it is found from its other end
    }
  }
  return found;
}

}  // namespace starcell
