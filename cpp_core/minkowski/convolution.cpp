#include "minkowski/convolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>

#include "minkowski/flat_faces.h"
#include "minkowski/normal_tree.h"

namespace starcell {
namespace {

// Sums of vertices that rounding alone keeps apart are one point, as a share of the coordinates.
constexpr double same_point = 4e-15;
// Edges this nearly parallel span no area that their faces do not cover.
constexpr double parallel = 1e-13;
constexpr std::size_t pairs_between_pauses = 1 << 14;

using Key = std::array<std::int64_t, 3>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t h = 0;
    for (const std::int64_t k : key) h = (h ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
    return h;
  }
};

Key key_of(const Vec3& p, double cube) {
  Key key;
  for (int k = 0; k < 3; ++k) key[k] = static_cast<std::int64_t>(std::floor(p[k] / cube));
  return key;
}

class Convolving {
 public:
  Convolving(const SumOperand& a, const SumOperand& b, const ConvolutionSettings& settings) : a_(a), b_(b), settings_(settings) {
    if (settings.covers) flat_.emplace(a, b);
  }

  Convolution make() {
    faces_at_vertices(a_, b_, false);
    faces_at_vertices(b_, a_, true);
    edges_by_edges();
    if (flat_)
      for (const auto& corners : flat_->cover()) add(corners, static_cast<std::uint32_t>(result_.facets.size()));
    weld();
    return std::move(result_);
  }

 private:
  template <class Items>
  static NormalTree tree_of(const Items& items) {
    std::vector<NormalCap> caps;
    for (const auto& item : items) caps.push_back(item.normals);
    return NormalTree(std::move(caps));
  }

  using Origin = SumOrigin;

  void add(const std::array<Origin, 3>& corners, std::uint32_t partner) {
    Triangle t{};
    for (int k = 0; k < 3; ++k) t[k] = point(corners[k]);
    result_.facets.push_back(t);
    result_.partners.push_back(partner);
    if (settings_.origins) result_.origins.push_back(corners);
  }

  std::uint32_t point(const Origin& o) {
    const auto [it, fresh] = index_.emplace(std::uint64_t{o[0]} << 32 | o[1], static_cast<std::uint32_t>(result_.points.size()));
    if (fresh) {
      result_.points.push_back(a_.points()[o[0]] + b_.points()[o[1]]);
      origins_.push_back(o);
    }
    return it->second;
  }

  void count_pair() {
    if (++result_.pairs % pairs_between_pauses == 0 && settings_.pause) settings_.pause();
  }

  void faces_at_vertices(const SumOperand& faces, const SumOperand& vertices, bool turned) {
    NormalTree::meeting(tree_of(faces.faces()), tree_of(vertices.vertices()), [&](std::uint32_t i, std::uint32_t j) {
      count_pair();
      const SumOperand::Face& face = faces.faces()[i];
      const SumOperand::Vertex& vertex = vertices.vertices()[j];
      if (flat_ && flat_->cover_facet(face.facet, vertex.vertex, turned)) return;
      if (face.normals.angle < 1 && !vertices.supports(vertex, face.normals.axis, face.slack)) return;
      std::array<Origin, 3> corners;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = faces.facets()[face.facet][k];
        corners[k] = turned ? Origin{vertex.vertex, v} : Origin{v, vertex.vertex};
      }
      add(corners, static_cast<std::uint32_t>(result_.facets.size()));
    });
  }

  void edges_by_edges() {
    NormalTree::meeting(tree_of(a_.edges()), tree_of(b_.edges()), [&](std::uint32_t i, std::uint32_t j) {
      count_pair();
      const SumOperand::Edge &e = a_.edges()[i], &f = b_.edges()[j];
      if (flat_ && flat_->cover_edges(e, f)) return;
      const Vec3 along = a_.points()[e.to] - a_.points()[e.from], across = b_.points()[f.to] - b_.points()[f.from];
      const Vec3 cross = along.cross(across);
      const double length = cross.norm(), whole = along.norm() * across.norm();
      if (!(length > parallel * whole)) return;
      const double slack = 1e-15 * whole / length;
      for (const double sense : {1.0, -1.0}) {
        const Vec3 n = sense / length * cross;
        if (!a_.supports(e, n, slack) || !b_.supports(f, n, slack)) continue;
        std::array<Origin, 4> q{{{e.from, f.from}, {e.to, f.from}, {e.to, f.to}, {e.from, f.to}}};
        if (sense < 0) std::swap(q[1], q[3]);
        const auto at = static_cast<std::uint32_t>(result_.facets.size());
        add({q[0], q[1], q[2]}, at + 1);
        add({q[0], q[2], q[3]}, at);
      }
    });
  }

  // What rounding left off a point: sums are equal exactly where both are.
  Vec3 rounded_off(std::uint32_t i) const {
    const Vec3 &a = a_.points()[origins_[i][0]], &b = b_.points()[origins_[i][1]], &sum = result_.points[i];
    Vec3 rest;
    for (int k = 0; k < 3; ++k) {   // Knuth's two-sum
      const double of_b = sum[k] - a[k], of_a = sum[k] - of_b;
      rest[k] = (a[k] - of_a) + (b[k] - of_b);
    }
    return rest;
  }

  bool equal(std::uint32_t i, std::uint32_t j) const { return result_.points[i] == result_.points[j] && rounded_off(i) == rounded_off(j); }

  // Symmetric operands meet in the same sums by different ways. What then is one facet is kept once.
  void weld() {
    std::vector<Vec3>& points = result_.points;
    double scale = 0;
    for (const Vec3& p : points) scale = std::max(scale, p.cwiseAbs().maxCoeff());
    const double near = same_point * scale;
    std::vector<std::uint32_t> stands(points.size());
    std::unordered_map<Key, std::vector<std::uint32_t>, KeyHash> kept_near;   // by cubes of a few roundings
    const double cube = 4 * near + std::numeric_limits<double>::min();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (i % pairs_between_pauses == 0 && settings_.pause) settings_.pause();
      stands[i] = i;
      const Vec3& p = points[i];
      // Only cubes that reach to p count: mostly its own alone.
      const Key low = key_of(p - Vec3::Constant(near), cube), high = key_of(p + Vec3::Constant(near), cube);
      for (std::int64_t x = low[0]; x <= high[0] && stands[i] == i; ++x)
        for (std::int64_t y = low[1]; y <= high[1] && stands[i] == i; ++y)
          for (std::int64_t z = low[2]; z <= high[2] && stands[i] == i; ++z) {
            const auto at = kept_near.find({x, y, z});
            if (at == kept_near.end()) continue;
            for (const std::uint32_t j : at->second)
              if ((points[j] - p).cwiseAbs().maxCoeff() <= near) stands[i] = std::min(stands[i], j);
          }
      if (stands[i] == i) kept_near[key_of(p, cube)].push_back(i);
    }
    std::vector<std::uint32_t> number(points.size(), UINT32_MAX);
    std::vector<Vec3> kept;
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if (stands[i] == i) number[i] = static_cast<std::uint32_t>(kept.size()), kept.push_back(points[i]);
    result_.merged.assign(kept.size(), 0);
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if (stands[i] != i && !equal(i, stands[i])) result_.merged[number[stands[i]]] = 1;
    for (Triangle& t : result_.facets)
      for (std::uint32_t& v : t) v = number[stands[v]];
    points = std::move(kept);
    drop_doubles();
  }

  void drop_doubles() {
    const std::size_t n = result_.facets.size();
    std::vector<std::uint32_t> order(n);
    std::vector<Triangle> key(n);
    for (std::uint32_t f = 0; f < n; ++f) {
      order[f] = f;
      Triangle t = result_.facets[f];
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());   // the sense stays
      key[f] = t;
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t f, std::uint32_t g) { return key[f] != key[g] ? key[f] < key[g] : f < g; });
    std::vector<char> keep(n, 1);
    for (std::size_t k = 0; k < n; ++k) {
      const Triangle& t = key[order[k]];
      if (t[0] == t[1] || t[1] == t[2] || t[0] == t[2] || (k > 0 && key[order[k - 1]] == t)) keep[order[k]] = 0;
    }
    std::vector<std::uint32_t> number(n, UINT32_MAX);
    std::uint32_t count = 0;
    for (std::size_t f = 0; f < n; ++f)
      if (keep[f]) number[f] = count++;
    std::vector<Triangle> facets;
    std::vector<std::uint32_t> partners;
    for (std::size_t f = 0; f < n; ++f) {
      if (!keep[f]) continue;
      if (settings_.origins) result_.origins[facets.size()] = result_.origins[f];
      const std::uint32_t partner = number[result_.partners[f]];
      partners.push_back(partner == UINT32_MAX ? number[f] : partner);
      facets.push_back(result_.facets[f]);
    }
    if (settings_.origins) result_.origins.resize(facets.size());
    result_.facets = std::move(facets);
    result_.partners = std::move(partners);
  }

  const SumOperand& a_;
  const SumOperand& b_;
  const ConvolutionSettings& settings_;
  std::optional<FlatFaces> flat_;
  Convolution result_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  std::vector<Origin> origins_;   // of each point
};

}  // namespace

Convolution convolve(const SumOperand& a, const SumOperand& b, const ConvolutionSettings& settings) { return Convolving(a, b, settings).make(); }

}  // namespace starcell
