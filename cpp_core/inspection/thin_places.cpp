#include "inspection/thin_places.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

#include "solids/disjoint_sets.h"
#include "solids/errors.h"

namespace starcell {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

constexpr double samples_across = 4;        // samples to the thickness, as long as there are no more of them than this:
constexpr double most_samples = 200000;
constexpr std::size_t asked_every = 64;     // triangles, whether to go on
constexpr double opposite = -0.5;           // cosine between the normals of a wall's two sides: less than 60 degrees from parallel

// Calls visit(p) for points at most about `spacing` apart all over a triangle: rows parallel to its longest side.
template <class Visit>
void sample(Vec3 a, Vec3 b, Vec3 c, double spacing, Visit visit) {
  while ((b - a).norm() < (c - b).norm() || (b - a).norm() < (a - c).norm()) {
    std::swap(a, b), std::swap(b, c);   // (a, b, c) becomes (b, c, a)
  }
  const double base = (b - a).norm(), height = (b - a).cross(c - a).norm() / base;
  const auto parts = [&](double length) { return static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0, most_samples)); };
  const int rows = parts(height);
  for (int row = 0; row < rows; ++row) {
    // Half way up a strip, a third up the tip: no sample is on an edge.
    const double up = (row + (row + 1 == rows ? 1.0 / 3 : 0.5)) / rows;
    const Vec3 left = a + up * (c - a), right = b + up * (c - b);
    const int columns = parts((1 - up) * base);
    for (int column = 0; column < columns; ++column) visit(Vec3(left + (column + 0.5) / columns * (right - left)));
  }
}

Kernel::Point_3 point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

class Search {
 public:
  Search(const Polyhedron& solid, double thickness, ThinSide side)
      : solid_(solid), thickness_(thickness), outward_(side == ThinSide::gap ? 1 : -1), spacing_(thickness / samples_across) {
    double area = 0;
    for (const Triangle& t : solid.triangles()) {
      const auto [a, b, c] = corners(t);
      triangles_.emplace_back(point(a), point(b), point(c));
      const Vec3 n = (b - a).cross(c - a);
      normals_.push_back(n.normalized());
      // A facet narrower than the distance to what it stands for, either way, says nothing of that surface's direction.
      const double height = n.norm() / std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      faces_a_way_.push_back(height > 2 * solid.provenance().deflection);
      area += 0.5 * n.norm();
    }
    spacing_ = std::max(spacing_, std::sqrt(area / most_samples));
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  Spokes run(const std::function<bool()>& go_on) {
    std::vector<std::vector<Spoke>> found(triangles_.size());   // in order, whatever the threads do
    std::atomic<bool> stopped{false};
    std::mutex asking;
    tbb::parallel_for(std::size_t{0}, triangles_.size(), [&](std::size_t t) {
      if (stopped || !faces_a_way_[t]) return;
      if (go_on && t % asked_every == 0) {
        const std::lock_guard lock(asking);
        if (!stopped && !go_on()) stopped = true;
      }
      const auto [a, b, c] = corners(solid_.triangles()[t]);
      sample(a, b, c, spacing_, [&](const Vec3& p) {
        if (!stopped) look(p, t, found[t]);
      });
    });
    if (stopped) throw CancelledError("The run was cancelled.");
    Spokes result{{}, spacing_};
    for (const auto& of_triangle : found) result.all.insert(result.all.end(), of_triangle.begin(), of_triangle.end());
    return result;
  }

 private:
  std::array<Vec3, 3> corners(const Triangle& t) const { return {solid_.vertices()[t[0]], solid_.vertices()[t[1]], solid_.vertices()[t[2]]}; }

  void look(const Vec3& p, std::size_t t, std::vector<Spoke>& found) const {
    const Vec3 along = outward_ * normals_[t];
    const Vec3 end = p + thickness_ * along;
    const Kernel::Ray_3 ray(point(p), point(end));
    const auto own = triangles_.begin() + static_cast<std::ptrdiff_t>(t);
    const auto hit = tree_.first_intersection(ray, [&](const auto& other) { return other == own; });
    if (!hit) return;
    const auto* at = boost::get<Kernel::Point_3>(&hit->first);
    if (!at) return;   // along a face: none that looks the other way
    const auto other = static_cast<std::size_t>(hit->second - triangles_.begin());
    const Spoke spoke{p, {at->x(), at->y(), at->z()}, static_cast<std::uint32_t>(t), static_cast<std::uint32_t>(other)};
    if (spoke.length() < thickness_ && faces_a_way_[other] && normals_[t].dot(normals_[other]) < opposite && !meet(t, other)) found.push_back(spoke);
  }

  // Facets with a common corner are two sides of an edge, or a fold that meshing left.
  bool meet(std::size_t s, std::size_t t) const {
    const Triangle &a = solid_.triangles()[s], &b = solid_.triangles()[t];
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
  }

  const Polyhedron& solid_;
  double thickness_, outward_, spacing_;
  Triangles triangles_;
  std::vector<Vec3> normals_;
  std::vector<char> faces_a_way_;
  Tree tree_;
};

}  // namespace

Spokes find_spokes(const Polyhedron& solid, double thickness, ThinSide side, const std::function<bool()>& go_on) {
  if (!(thickness > 0 && std::isfinite(thickness))) throw std::invalid_argument("thickness: must be finite and greater than 0");
  return Search(solid, thickness, side).run(go_on);
}

// Spokes whose middles are in the same or in neighbouring buckets two spacings wide belong together.
ThinPlaces gather(const Spokes& found) {
  const std::vector<Spoke>& spokes = found.all;
  const double spacing = found.spacing;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> buckets;
  std::vector<std::uint32_t> bucket_of;
  for (const Spoke& s : spokes) {
    const Vec3 middle = 0.5 * (s.from + s.to) / (2 * spacing);
    const std::array<std::int64_t, 3> key{std::llround(middle[0]), std::llround(middle[1]), std::llround(middle[2])};
    bucket_of.push_back(buckets.emplace(key, static_cast<std::uint32_t>(buckets.size())).first->second);
  }
  DisjointSets sets(buckets.size());
  for (const auto& [key, bucket] : buckets)
    for (int i = 0; i < 27; ++i) {
      const auto next = buckets.find({key[0] + i % 3 - 1, key[1] + i / 3 % 3 - 1, key[2] + i / 9 - 1});
      if (next != buckets.end()) sets.join(bucket, next->second);
    }
  std::map<std::uint32_t, ThinPlace> places;
  std::map<std::uint32_t, Box3> middles;
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    const auto [place, is_new] = places.try_emplace(sets.root(bucket_of[i]));
    middles[place->first].extend(Vec3(0.5 * (spokes[i].from + spokes[i].to)));
    ThinPlace& p = place->second;
    p.thickness = is_new ? spokes[i].length() : std::min(p.thickness, spokes[i].length());
    p.box.extend(spokes[i].from), p.box.extend(spokes[i].to);
    p.spokes.push_back(spokes[i]);
  }
  std::vector<ThinPlace> sorted;
  // What is not as wide as a spacing is the tip of something, or a fold that meshing left.
  for (auto& [root, place] : places)
    if (middles[root].sizes().maxCoeff() >= spacing) sorted.push_back(std::move(place));
  std::stable_sort(sorted.begin(), sorted.end(), [](const ThinPlace& a, const ThinPlace& b) { return a.thickness < b.thickness; });
  return {std::move(sorted), spacing};
}

ThinPlaces find_thin_places(const Polyhedron& solid, double thickness, ThinSide side, const std::function<bool()>& go_on) {
  return gather(find_spokes(solid, thickness, side, go_on));
}

}  // namespace starcell
