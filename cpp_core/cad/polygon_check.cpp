#include "cad/polygon_check.h"

#include <algorithm>

namespace starcell::cad {
namespace {

using Vec2 = Eigen::Vector2d;

struct Segment {
  std::uint32_t from, to;
  Vec2 a, b, low, high;
};

double distance(const Vec2& p, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const double t = std::clamp((p - s.a).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
  return (p - s.a - t * along).norm();
}

double side(const Vec2& a, const Vec2& b, const Vec2& p) { return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x(); }

bool cross(const Segment& s, const Segment& t) {
  return side(s.a, s.b, t.a) * side(s.a, s.b, t.b) < 0 && side(t.a, t.b, s.a) * side(t.a, t.b, s.b) < 0;
}

bool keep_apart(const Segment& s, const Segment& t, double clearance) {
  if (((s.low - t.high).array() > clearance).any() || ((t.low - s.high).array() > clearance).any()) return true;
  if (cross(s, t)) return false;
  const auto touches = [](const Segment& u, std::uint32_t v) { return u.from == v || u.to == v; };
  return (touches(s, t.from) || distance(t.a, s) > clearance) && (touches(s, t.to) || distance(t.b, s) > clearance) &&
         (touches(t, s.from) || distance(s.a, t) > clearance) && (touches(t, s.to) || distance(s.b, t) > clearance);
}

}  // namespace

bool is_simple(const PlanarFace& face, const std::vector<Vec3>& vertices, double clearance) {
  const Vec3 u = face.normal.unitOrthogonal(), v = face.normal.cross(u);
  const auto flat = [&](std::uint32_t i) { return Vec2(u.dot(vertices[i] - face.point), v.dot(vertices[i] - face.point)); };
  std::vector<Segment> segments;
  for (const auto& loop : face.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t from = loop[i], to = loop[i + 1 < loop.size() ? i + 1 : 0];
      const Vec2 a = flat(from), b = flat(to);
      segments.push_back({from, to, a, b, a.cwiseMin(b), a.cwiseMax(b)});
    }
  std::sort(segments.begin(), segments.end(), [](const Segment& s, const Segment& t) { return s.low.x() < t.low.x(); });
  std::vector<const Segment*> active;
  for (const Segment& s : segments) {
    std::erase_if(active, [&](const Segment* t) { return t->high.x() + clearance < s.low.x(); });
    for (const Segment* t : active)
      if (!keep_apart(s, *t, clearance)) return false;
    active.push_back(&s);
  }
  return true;
}

}  // namespace starcell::cad
