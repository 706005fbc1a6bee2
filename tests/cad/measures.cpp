#include "measures.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace starcell::test {

double volume(const Polyhedron& solid) {
  double six = 0;
  for (const Triangle& t : solid.triangles())
    six += solid.vertices()[t[0]].dot(solid.vertices()[t[1]].cross(solid.vertices()[t[2]]));
  return six / 6;
}

int euler_characteristic(const Polyhedron& solid) {
  return static_cast<int>(solid.vertices().size()) - static_cast<int>(solid.triangles().size()) / 2;
}

double largest_on(const Polyhedron& solid, const std::function<double(const Vec3&)>& f) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit;
  double largest = 0;
  for (const Triangle& t : solid.triangles())
    for (int i = 0; i < 20; ++i) {
      Vec3 weights(unit(random), unit(random), unit(random));
      if (i % 4 == 0) weights[i % 3] = 0;
      weights /= weights.sum();
      largest = std::max(largest, f(solid.vertices()[t[0]] * weights[0] + solid.vertices()[t[1]] * weights[1] +
                                    solid.vertices()[t[2]] * weights[2]));
    }
  return largest;
}

double distance_to(const Polyhedron& solid, const Vec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto segment = [&](const Vec3& a, const Vec3& b) {
    const double s = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (point - a - s * (b - a)).norm();
  };
  for (const Triangle& t : solid.triangles()) {
    const Vec3 &a = solid.vertices()[t[0]], &b = solid.vertices()[t[1]], &c = solid.vertices()[t[2]];
    nearest = std::min({nearest, segment(a, b), segment(b, c), segment(c, a)});
    const Vec3 n = (b - a).cross(c - a);
    if (n.cross(b - a).dot(point - a) >= 0 && n.cross(c - b).dot(point - b) >= 0 && n.cross(a - c).dot(point - c) >= 0)
      nearest = std::min(nearest, std::abs(n.normalized().dot(point - a)));
  }
  return nearest;
}

const Polyhedron& leaf(const Expression& solid) {
  if (solid.kind() != Expression::Kind::polyhedron) throw std::logic_error("expected a single polyhedron");
  return *solid.polyhedron();
}

}  // namespace starcell::test
