#include "subdivision/grazes.h"

#include <algorithm>
#include <cmath>

namespace starcell {
namespace {

class GrazeFinder {
 public:
  GrazeFinder(const FacetTable& table, double tolerance) : table_(table), tolerance_(tolerance) {}

  void look_at(const FacetPair& pair) {
    note_vertices(pair.first, pair.second);
    note_vertices(pair.second, pair.first);
    note_edges(pair.first, pair.second);
  }

  std::vector<Graze> found() {
    keep_vertices();
    return std::move(grazes_);
  }

 private:
  struct Note {
    std::uint32_t vertex, on, facet;
    auto operator<=>(const Note&) const = default;
  };

  // Corners of g on facet f, its rim included.
  void note_vertices(std::uint32_t f, std::uint32_t g) {
    const Surface& s = table_.surfaces[table_.surface[f]];
    for (int k = 0; k < 3; ++k)
      if (s.distance(table_.corner(g, k)) <= tolerance_ && within(f, table_.corner(g, k)))
        notes_.push_back({table_.corners[g][k], table_.operand_of(f), f});
  }

  bool within(std::uint32_t f, const Vec3& p) const {
    const Vec3 n = table_.area_vector(f);
    for (int k = 0; k < 3; ++k) {
      const Vec3& a = table_.corner(f, k);
      const Vec3 outward = (table_.corner(f, (k + 1) % 3) - a).cross(n);
      if (outward.dot(p - a) > 2 * tolerance_ * outward.norm()) return false;
    }
    return true;
  }

  // Every edge counts at the lower of its two facets, and only if they are on two surfaces.
  void note_edges(std::uint32_t f, std::uint32_t g) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t nf = table_.neighbours[f][i];
      if (nf < f || table_.surface[nf] == table_.surface[f]) continue;
      for (int j = 0; j < 3; ++j) {
        const std::uint32_t ng = table_.neighbours[g][j];
        if (ng < g || table_.surface[ng] == table_.surface[g]) continue;
        Vec3 place;
        if (!cross(table_.corner(f, i), table_.corner(f, (i + 1) % 3), table_.corner(g, j), table_.corner(g, (j + 1) % 3), place))
          continue;
        // With a surface in common three planes are left, and those meet in a point anyway.
        const std::uint32_t a = table_.surface[f], b = table_.surface[nf], c = table_.surface[g], d = table_.surface[ng];
        if (a == c || a == d || b == c || b == d) continue;
        grazes_.push_back({table_.operand_of(g), table_.operand_of(f), place});
      }
    }
  }

  // Do two segments that are not parallel come within the tolerance? (Of parallel ones a vertex lies on the other's facets.)
  bool cross(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Vec3& place) const {
    const Vec3 u = b - a, v = d - c, w = c - a;
    const Vec3 n = u.cross(v);
    const double nn = n.squaredNorm();
    if (!(nn > 1e-16 * u.squaredNorm() * v.squaredNorm())) return false;
    if (std::abs(n.dot(w)) > tolerance_ * std::sqrt(nn)) return false;
    const double s = w.cross(v).dot(n) / nn, t = w.cross(u).dot(n) / nn;
    if (s < 0 || s > 1 || t < 0 || t > 1) return false;
    place = a + s * u;
    return true;
  }

  // A vertex with a facet of its own in the plane that it lies on is no graze: identity takes care of it.
  void keep_vertices() {
    std::sort(notes_.begin(), notes_.end());
    std::vector<char> wanted(table_.points.size(), 0);
    for (const Note& n : notes_) wanted[n.vertex] = 1;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> own;  // (vertex, surface) for the noted vertices
    std::vector<std::uint32_t> facet_at(table_.points.size(), UINT32_MAX);
    for (std::uint32_t f = 0; f < table_.size(); ++f)
      for (const std::uint32_t v : table_.corners[f])
        if (wanted[v]) own.emplace_back(v, table_.surface[f]), facet_at[v] = f;
    std::sort(own.begin(), own.end());
    std::uint32_t last_vertex = UINT32_MAX, last_on = UINT32_MAX;
    for (const Note& n : notes_) {
      if (n.vertex == last_vertex && n.on == last_on) continue;
      if (std::binary_search(own.begin(), own.end(), std::pair(n.vertex, table_.surface[n.facet]))) continue;
      last_vertex = n.vertex;
      last_on = n.on;
      grazes_.push_back({table_.operand_of(facet_at[n.vertex]), n.on, table_.points[n.vertex]});
    }
  }

  const FacetTable& table_;
  const double tolerance_;
  std::vector<Note> notes_;
  std::vector<Graze> grazes_;
};

}  // namespace

std::vector<Graze> find_grazes(const FacetTable& table, const std::vector<FacetPair>& pairs, double tolerance) {
  GrazeFinder finder(table, tolerance);
  for (const FacetPair& pair : pairs) finder.look_at(pair);
  return finder.found();
}

std::vector<Vec3> shifts_off_grazes(const FacetTable& table, const std::vector<Graze>& grazes, double reach, int attempt) {
  const std::size_t n = table.operands();
  std::vector<Vec3> shifts(n, Vec3::Zero());
  std::vector<char> grazing(n, 0);
  for (const Graze& g : grazes) grazing[std::max(g.of, g.on)] = 1;
  // Surfaces that an operand shares must stay where they are: it may only move along all of them.
  std::vector<std::vector<Vec3>> fixed(n);
  for (std::size_t s = 0; s < table.faceted(); ++s)
    for (std::uint32_t f = table.first[s]; grazing[s] && f < table.first[s + 1]; ++f) {
      const Surface& surface = table.surfaces[table.surface[f]];
      if (!surface.shared) continue;
      Vec3 rest = surface.normal;
      for (const Vec3& u : fixed[s]) rest -= rest.dot(u) * u;
      if (rest.norm() > 1e-6) fixed[s].push_back(rest.normalized());
    }
  // A shared cylinder or sphere leaves its solid few ways to move, and others that are shared none: it stays.
  for (const Region& region : table.regions) {
    const Surface& surface = table.surfaces[region.surface];
    if (!surface.shared) continue;
    if (surface.form) grazing[region.body] = 0;
    Vec3 rest = surface.normal;
    for (const Vec3& u : fixed[region.body]) rest -= rest.dot(u) * u;
    if (rest.norm() > 1e-6) fixed[region.body].push_back(rest.normalized());
  }
  for (std::size_t s = 0; s < n; ++s) {
    if (!grazing[s]) continue;
    // No direction is special to the eye, to axes or diagonals; every operand gets one of its own.
    const double turn = static_cast<double>(s) + 0.7 * attempt;
    Vec3 direction(0.5547 + 0.083 * std::sin(2.1 * turn), 0.6731, 0.4889 + 0.061 * std::cos(1.7 * turn));
    for (const Vec3& u : fixed[s]) direction -= direction.dot(u) * u;
    if (direction.norm() > 1e-3) shifts[s] = reach * (0.6 + 0.4 * std::fmod(0.618 * turn, 1.0)) * direction.normalized();
  }
  return shifts;
}

}  // namespace starcell
