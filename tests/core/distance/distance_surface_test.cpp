// Enclosures of distance surfaces against distance computed again here: by brute force over triangles, its sign by the winding number.
#include "distance/offset_solid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "operations/results.h"
#include "solids/point_distance.h"

namespace starcell {
namespace {

using namespace sample;

// The solid angle of all triangles over 4 pi (van Oosterom & Strackee 1983): 1 inside, 0 outside.
bool is_inside(const Polyhedron& solid, const Vec3& x) {
  double sum = 0;
  for (const Triangle& t : solid.triangles()) {
    const Vec3 a = solid.vertices()[t[0]] - x, b = solid.vertices()[t[1]] - x, c = solid.vertices()[t[2]] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum > 3.14159265;
}

double signed_distance(const Polyhedron& solid, const Vec3& x) {
  double d = std::numeric_limits<double>::infinity();
  for (const Triangle& t : solid.triangles()) d = std::min(d, to_triangle(x, solid.vertices()[t[0]], solid.vertices()[t[1]], solid.vertices()[t[2]]));
  return is_inside(solid, x) ? -d : d;
}

// Two cuboids that meet in an L, with a notch: convex, concave and flat edges, saddle vertices.
Mesh bracket() {
  const std::vector<std::pair<double, double>> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0.6, 2}, {0.6, 1.6}, {0.4, 1.6}, {0.4, 2}, {0, 2}};
  const auto n = static_cast<std::uint32_t>(outline.size());
  Mesh m;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline) m.vertices.emplace_back(x, y, z);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    m.triangles.push_back({i, j, n + j});
    m.triangles.push_back({i, n + j, n + i});
  }
  const std::vector<Triangle> top{{0, 1, 3}, {1, 2, 3}, {0, 3, 7}, {3, 6, 7}, {3, 4, 6}, {4, 5, 6}, {0, 7, 8}, {0, 8, 9}};
  for (const Triangle& t : top) m.triangles.push_back({n + t[0], n + t[1], n + t[2]}), m.triangles.push_back({t[0], t[2], t[1]});
  return m;
}

struct Sampled {
  PolyhedronPtr solid;
  double offset;
  std::vector<std::uint32_t> faces = {};   // if any: without sign, from these alone
};

double distance_of(const Sampled& s, const Vec3& x) {
  if (s.faces.empty()) return signed_distance(*s.solid, x);
  double d = std::numeric_limits<double>::infinity();
  for (const std::uint32_t f : s.faces) {
    const Triangle& t = s.solid->triangles()[f];
    d = std::min(d, to_triangle(x, s.solid->vertices()[t[0]], s.solid->vertices()[t[1]], s.solid->vertices()[t[2]]));
  }
  return d;
}

std::vector<Sampled> solids(std::mt19937& random) {
  const Mesh turned_bracket = turned(bracket(), random_rotation(random), {0.2, -0.3, 0.1}), stone = pebble(random, 2);
  // Hardly rough: saddles everywhere, all of whose normals lie in narrow caps.
  std::uniform_real_distribution<double> little(1, 1.004);
  const Mesh rough = star_shape(3, [&](const Vec3&) { return little(random); });
  std::vector<Sampled> result;
  for (const double offset : {0.3, 0.07, -0.07, -0.2}) {
    result.push_back({make(turned_bracket), offset});
    result.push_back({make(stone), offset});
    result.push_back({make(rough), offset});
    if (offset < 0) continue;
    for (const Mesh* mesh : {&turned_bracket, &stone}) {
      result.push_back({make(*mesh), offset});
      for (std::uint32_t f = 0; f < mesh->triangles.size(); ++f)
        if (random() % 3 > 0) result.back().faces.push_back(f);
    }
  }
  return result;
}

// A chain of boxes, each in the one before, down to one near the offset: as a cell comes by its surface.
struct Place {
  SmoothSurfacePtr surface;
  Box3 box;
};

Place descend(const Sampled& s, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const OffsetSolidPtr solid = s.faces.empty() ? OffsetSolid::make(s.solid, s.offset) : OffsetSolid::about_faces(s.solid, s.faces, s.offset);
  Place p{solid->surface(), Box3(s.solid->bounding_box().min() - Vec3::Constant(0.5), s.solid->bounding_box().max() + Vec3::Constant(0.5))};
  for (int level = 0; level < 12; ++level) {
    if (auto next = p.surface->restricted(p.box)) p.surface = std::move(next);
    if (p.box.sizes().maxCoeff() < 0.02 + 0.3 * unit(random)) break;
    Box3 best = p.box;
    double least = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 4; ++trial) {   // the half that is nearest to the offset, more or less
      const Vec3 low = p.box.min() + Vec3(unit(random), unit(random), unit(random)).cwiseProduct(0.5 * p.box.sizes());
      const Box3 half(low, low + 0.5 * p.box.sizes());
      const double off = std::abs(distance_of(s, half.center()) - s.offset);
      if (off < least) least = off, best = half;
    }
    p.box = best;
  }
  if (auto next = p.surface->restricted(p.box)) p.surface = std::move(next);
  return p;
}

Vec3 point_in(const Box3& box, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  return box.min() + Vec3(unit(random), unit(random), unit(random)).cwiseProduct(box.sizes());
}

bool holds(const Interval& x, double value, double slack = 1e-12) { return x.lower() - slack <= value && value <= x.upper() + slack; }

TEST(DistanceSurface, ExpansionsEncloseTheDistance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int smooth = 0, looked = 0;
  for (const Sampled& s : solids(random))
    for (int i = 0; i < 60; ++i) {
      const Place place = descend(s, random);
      // Some box inside it.
      const Vec3 a = point_in(place.box, random), b = point_in(place.box, random);
      const Box3 box(a.cwiseMin(b), a.cwiseMax(b));
      Expansion e;
      {
        const Rounding rounding;
        e = place.surface->expand(box.center(), 0.5 * box.sizes());
      }
      ++looked;
      smooth += e.smooth;
      const double at_center = distance_of(s, box.center()) - s.offset;
      ASSERT_TRUE(holds(e.value, at_center)) << e.value.lower() << ' ' << at_center << ' ' << e.value.upper();
      for (int k = 0; k < 20; ++k) {
        const Vec3 p = point_in(box, random), q = point_in(box, random), r = point_in(box, random);
        const double f = distance_of(s, p) - s.offset, g = distance_of(s, q) - s.offset, h = distance_of(s, r) - s.offset;
        const Vec3 u = (q - p).normalized(), w(unit(random), unit(random), unit(random));
        const Vec3 middle = (w.x() * p + w.y() * q + w.z() * r) / w.sum();
        const double inside = distance_of(s, middle) - s.offset, interpolated = (w.x() * f + w.y() * g + w.z() * h) / w.sum();
        Interval range, slope, excess, refined;
        {
          const Rounding rounding;
          range = e.range(), slope = e.along(u), excess = e.excess(p, q, r);
          refined = e.excess(p, q, r, Interval(std::min({f, g, h}), std::max({f, g, h})));
        }
        ASSERT_TRUE(holds(range, f)) << f << " in " << range.lower() << ' ' << range.upper();
        // Between two points the distance rises by what it rises on the way.
        ASSERT_TRUE(holds(slope, (g - f) / (q - p).norm(), 1e-9)) << (g - f) / (q - p).norm() << " in " << slope.lower() << ' ' << slope.upper();
        ASSERT_TRUE(holds(excess, interpolated - inside)) << interpolated - inside << " in " << excess.lower() << ' ' << excess.upper();
        ASSERT_TRUE(holds(refined, interpolated - inside)) << interpolated - inside << " in " << refined.lower() << ' ' << refined.upper();
      }
    }
  EXPECT_GT(smooth, looked / 4) << "the second-order enclosures were hardly tested";
}

// A cell that is restricted sees the same sign in every part's least, or greatest, as the distance has.
TEST(DistanceSurface, PartsMakeUpTheWhole) {
  std::mt19937 random(2);
  int several = 0;
  for (const Sampled& s : solids(random))
    for (int i = 0; i < 60; ++i) {
      const Place place = descend(s, random);
      if (!place.surface->simple()) continue;
      const auto parts = place.surface->parts();
      several += parts.size() > 1;
      for (int k = 0; k < 20 && !parts.empty(); ++k) {
        const Vec3 p = point_in(place.box, random);
        const double expected = distance_of(s, p) - s.offset;
        if (std::abs(expected) < 1e-10) continue;
        int below = 0;
        for (const auto& part : parts) below += part->sign(p) < 0;
        const bool inside = place.surface->least_of_parts() ? below > 0 : below == static_cast<int>(parts.size());
        ASSERT_EQ(inside, expected < 0) << expected << " with " << parts.size() << " parts";
      }
    }
  EXPECT_GT(several, 10);
}

TEST(OffsetSolid, RefusesDistancesThatAreNone) {
  const PolyhedronPtr solid = make(bracket());
  for (const double distance : {0.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(OffsetSolid::make(solid, distance), std::invalid_argument);
  for (const double radius : {0.0, -0.1, std::nan("")}) EXPECT_THROW(OffsetSolid::about_faces(solid, {0}, radius), std::invalid_argument);
  EXPECT_THROW(OffsetSolid::about_faces(solid, {}, 0.1), std::invalid_argument);
  EXPECT_THROW(OffsetSolid::about_faces(solid, {1, 1000}, 0.1), std::invalid_argument);
  EXPECT_TRUE(OffsetSolid::make(solid, -3)->bounding_box().isEmpty());
}

}  // namespace
}  // namespace starcell
