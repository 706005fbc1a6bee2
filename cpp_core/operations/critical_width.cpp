#include "operations/critical_width.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "inspection/thin_places.h"

namespace starcell {
namespace {

constexpr double move_share = 0.25;       // of the contact tolerance; a wall loses it on both sides,
constexpr double critical_share = 0.4;    // so that what is wider than its critical width by this would be gone too
constexpr double coordinate_loss = 4e-7;  // what files of float32 coordinates do to round numbers; what differs by more was meant to
constexpr double parallel = 1e-10;        // 1 + cosine of the normals of two parallel sides
constexpr double normal_digits = 1e6;

Vec3 unit_normal(const Polyhedron& solid, std::size_t t) {
  const auto corner = [&](int k) { return solid.vertices()[solid.triangles()[t][k]]; };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
}

// Planes of (almost) one direction: how far out each is along it, by the side that it faces.
struct Stack {
  std::vector<double> up, down;
};

// Are there two parallel planes at all that face each other, or away from each other, this far apart? Where roundings of the normals
// disagree a pair is missed.
bool has_planes_apart(const Polyhedron& solid, double width, double slack, ThinSide side) {
  std::map<std::array<std::int64_t, 3>, Stack> stacks;
  for (std::size_t t = 0; t < solid.triangles().size(); ++t) {
    const Vec3 n = unit_normal(solid, t);
    std::array<std::int64_t, 3> key{};
    for (int k = 0; k < 3; ++k) key[k] = std::llround(n[k] * normal_digits);
    const bool turned = key < std::array<std::int64_t, 3>{};
    if (turned)
      for (auto& k : key) k = -k;
    Stack& stack = stacks[key];
    const Vec3 &a = solid.vertices()[solid.triangles()[t][0]];
    (turned ? stack.down : stack.up).push_back(turned ? -n.dot(a) : n.dot(a));
  }
  for (auto& [key, stack] : stacks) {
    // A wall's upper side faces up and its lower one down; of a gap it is the other way round.
    auto &high = side == ThinSide::wall ? stack.up : stack.down, &low = side == ThinSide::wall ? stack.down : stack.up;
    std::sort(low.begin(), low.end());
    for (const double h : high) {
      const auto at = std::lower_bound(low.begin(), low.end(), h - width - slack);
      if (at != low.end() && *at <= h - width + slack) return true;
    }
  }
  return false;
}

}  // namespace

OffsetTask off_critical_width(const PolyhedronPtr& solid, double distance, double contact, const std::function<bool()>& go_on) {
  const ThinSide side = distance < 0 ? ThinSide::wall : ThinSide::gap;
  const double width = 2 * std::abs(distance);
  const double scale = std::max(solid->bounding_box().min().cwiseAbs().maxCoeff(), solid->bounding_box().max().cwiseAbs().maxCoeff());
  const double slack = std::min(critical_share * contact, coordinate_loss * scale);
  if (!has_planes_apart(*solid, width, slack, side)) return {solid, distance};
  Spokes spokes = find_spokes(*solid, width + contact, side, go_on);
  std::erase_if(spokes.all, [&](const Spoke& s) {
    return std::abs(s.length() - width) > slack || unit_normal(*solid, s.from_face).dot(unit_normal(*solid, s.to_face)) > parallel - 1;
  });
  Provenance provenance = solid->provenance();
  for (const ThinPlace& place : gather(spokes).places) {
    // It is in the middle between the two sides that the offset touches itself.
    Box3 box;
    for (const Spoke& s : place.spokes) box.extend(Vec3(0.5 * (s.from + s.to)));
    const Vec3 margin = Vec3::Constant(spokes.spacing);
    provenance.contacts.emplace_back(box.min() - margin, box.max() + margin);
  }
  if (provenance.contacts.size() == solid->provenance().contacts.size()) return {solid, distance};
  provenance.moved += move_share * contact;
  return {Polyhedron::trusted(solid->vertices(), solid->triangles(), std::move(provenance)),
          distance + std::copysign(move_share * contact, distance)};
}

}  // namespace starcell
