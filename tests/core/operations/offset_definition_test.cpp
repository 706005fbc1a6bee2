// Offsets against their definition, measured by CGAL on the meshes alone: distances from the result to the solid, and from points at
// exactly the distance asked for, with nothing nearer, to the result. And Steiner's formula for random convex polyhedra.
#include <gtest/gtest.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "operations/offset.h"
#include "operations/results.h"
#include "solids/box.h"

namespace starcell {
namespace {

using namespace sample;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

// Far more where a long check asks for it.
int many(int usually) {
  const char* wanted = std::getenv("STARCELL_POINTS");
  return wanted ? std::atoi(wanted) : usually;
}

class Surface {
 public:
  Surface(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
    const auto point = [&](std::uint32_t v) { return Kernel::Point_3(vertices[v].x(), vertices[v].y(), vertices[v].z()); };
    for (const Triangle& t : triangles) triangles_.emplace_back(point(t[0]), point(t[1]), point(t[2]));
    tree_.insert(triangles_.begin(), triangles_.end());
  }
  double distance(const Vec3& p) const { return std::sqrt(tree_.squared_distance(Kernel::Point_3(p.x(), p.y(), p.z()))); }

 private:
  Triangles triangles_;
  Tree tree_;
};

PolyhedronPtr mesh_of(const Expression& e) {
  Result r = evaluate(e, with_error(0.05));
  return Polyhedron::trusted(std::move(r.vertices), std::move(r.triangles));
}

Result offset(const PolyhedronPtr& solid, double r, double error) {
  const Prepared p = prepare_offset(Expression(solid), r, with_error(error));
  return evaluate(p.expression, p.options);
}

Vec3 random_point(std::mt19937& random, const std::vector<Vec3>& v, const Triangle& t) {
  std::exponential_distribution<double> weight;
  const Vec3 w(weight(random), weight(random), weight(random));
  return (w[0] * v[t[0]] + w[1] * v[t[1]] + w[2] * v[t[2]]) / w.sum();
}

struct Sampled {
  Vec3 foot, normal;
};

// Feet with a direction that may lead to an offset's point: of faces their normals, of edges and vertices directions between those.
Sampled random_foot(std::mt19937& random, const Polyhedron& solid) {
  const auto normal = [&](std::uint32_t t) {
    const auto& c = solid.triangles()[t];
    return Vec3((solid.vertices()[c[1]] - solid.vertices()[c[0]]).cross(solid.vertices()[c[2]] - solid.vertices()[c[0]]).normalized());
  };
  const auto pick = [&](std::size_t n) { return static_cast<std::uint32_t>(std::uniform_int_distribution<std::size_t>(0, n - 1)(random)); };
  std::uniform_real_distribution<double> part(0, 1);
  const std::uint32_t t = pick(solid.triangles().size());
  const Triangle& corners = solid.triangles()[t];
  const int kind = static_cast<int>(pick(3)), k = static_cast<int>(pick(3));
  if (kind == 0) return {random_point(random, solid.vertices(), corners), normal(t)};
  const Vec3 &a = solid.vertices()[corners[k]], &b = solid.vertices()[corners[(k + 1) % 3]];
  const double w = part(random);
  if (kind == 1) return {a + part(random) * (b - a), (w * normal(t) + (1 - w) * normal(solid.neighbours()[t][k])).normalized()};
  const std::uint32_t next = solid.neighbours()[t][k], last = solid.neighbours()[t][(k + 2) % 3];
  const double u = part(random), x = part(random);
  return {a, (u * normal(t) + w * normal(next) + x * normal(last)).normalized()};
}

void expect_definition(const PolyhedronPtr& solid, double r, double error, unsigned seed, const char* name) {
  const Result result = offset(solid, r, error);
  ASSERT_EQ(result.certificate.verdict, Verdict::exact) << name;
  const double bound = result.certificate.error_bound * (1 + 1e-9);
  EXPECT_LE(bound, error * (1 + 1e-9)) << name;
  const Surface from(solid->vertices(), solid->triangles()), to(result.vertices, result.triangles);
  std::mt19937 random(seed);
  double worst = 0;
  for (int i = 0; i < many(5000); ++i) {
    const Triangle& t = result.triangles[std::uniform_int_distribution<std::size_t>(0, result.triangles.size() - 1)(random)];
    worst = std::max(worst, std::abs(from.distance(random_point(random, result.vertices, t)) - std::abs(r)));
  }
  EXPECT_LE(worst, bound) << name << ": result to definition";
  int found = 0;
  worst = 0;
  for (int i = 0; found < many(5000) && i < 100 * many(5000); ++i) {
    const Sampled s = random_foot(random, *solid);
    const Vec3 p = s.foot + r * s.normal;
    if (std::abs(from.distance(p) - std::abs(r)) > 1e-9) continue;   // something is nearer
    ++found;
    worst = std::max(worst, to.distance(p));
  }
  EXPECT_EQ(found, many(5000)) << name;
  EXPECT_LE(worst, bound) << name << ": definition to result";
}

TEST(OffsetDefinition, BothWays) {
  const auto b = [](Vec3 low, Vec3 high) { return Expression(make_box(low, high)); };
  const PolyhedronPtr bracket = mesh_of((b({0, 0, 0}, {8, 5, 2}) | b({0, 0, 0}, {2, 5, 7}) | b({5, 1, 1}, {7, 3, 5})) - b({3, 2, -1}, {4, 4, 3}));
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.topLeftCorner<3, 3>() = Eigen::AngleAxisd(0.6, Vec3(2, -1, 1).normalized()).toRotationMatrix();
  const PolyhedronPtr turned = bracket->transformed(map);
  for (const double r : {0.6, -0.35}) {
    expect_definition(bracket, r, 0.05, 1, "bracket");
    expect_definition(turned, r, 0.05, 2, "turned bracket");
  }
}

PolyhedronPtr random_hull(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<Kernel::Point_3> points;
  const int n = std::uniform_int_distribution<int>(6, 30)(random);
  for (int i = 0; i < n; ++i) points.emplace_back(3 * normal(random), 2 * normal(random), normal(random));
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const auto v : hull.vertices()) vertices.emplace_back(hull.point(v).x(), hull.point(v).y(), hull.point(v).z());
  for (const auto f : hull.faces()) {
    Triangle t{};
    int k = 0;
    for (const auto v : hull.vertices_around_face(hull.halfedge(f))) t[k++] = v.idx();
    triangles.push_back(t);
  }
  return Polyhedron::make(std::move(vertices), std::move(triangles));
}

struct Measure {
  double volume = 0, area = 0, mean = 0;   // mean: the integral of mean curvature, half the sum of lengths times exterior angles
};

Measure measure(const Polyhedron& solid) {
  Measure m;
  const auto& v = solid.vertices();
  const auto area_vector = [&](std::uint32_t t) {
    const Triangle& c = solid.triangles()[t];
    return Vec3(0.5 * (v[c[1]] - v[c[0]]).cross(v[c[2]] - v[c[0]]));
  };
  for (std::uint32_t t = 0; t < solid.triangles().size(); ++t) {
    const Triangle& c = solid.triangles()[t];
    m.volume += v[c[0]].dot(v[c[1]].cross(v[c[2]])) / 6;
    m.area += area_vector(t).norm();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t other = solid.neighbours()[t][k];
      const Vec3 a = area_vector(t), b = area_vector(other);
      m.mean += 0.25 * (v[c[(k + 1) % 3]] - v[c[k]]).norm() * std::atan2(a.cross(b).norm(), a.dot(b));   // every edge comes twice
    }
  }
  return m;
}

// V + A r + M r^2 + 4/3 pi r^3, within the bound times the area of the offset, A + 2 M r + 4 pi r^2, and a little for its thickness.
TEST(OffsetDefinition, SteinersFormulaOfRandomConvexPolyhedra) {
  std::mt19937 random(11);
  for (int i = 0; i < 50; ++i) {
    const PolyhedronPtr hull = random_hull(random);
    const double r = std::uniform_real_distribution<double>(0.2, 2)(random);
    const Result result = offset(hull, r, 0.2);
    ASSERT_EQ(result.certificate.verdict, Verdict::exact) << i;
    EXPECT_EQ(topology(result), (Topology{1, {0}})) << i;
    const Measure m = measure(*hull);
    const double expected = m.volume + m.area * r + m.mean * r * r + 4 * std::numbers::pi / 3 * r * r * r;
    const double area = m.area + 2 * m.mean * r + 4 * std::numbers::pi * r * r;
    EXPECT_NEAR(volume(result), expected, 1.1 * result.certificate.error_bound * area) << i;
  }
}

// An opening opened again, and a closing closed again, are what they were, within both bounds: by volume, and by distance.
TEST(OffsetDefinition, OpeningAndClosingAreIdempotent) {
  const auto b = [](Vec3 low, Vec3 high) { return Expression(make_box(low, high)); };
  const PolyhedronPtr bracket = mesh_of(b({0, 0, 0}, {8, 5, 2}) | b({0, 0, 0}, {2, 5, 7}));
  for (const auto prepare : {&prepare_opening, &prepare_closing}) {
    const auto once = [&](const PolyhedronPtr& solid) {
      const Prepared p = prepare(Expression(solid), 0.5, with_error(0.4));
      return evaluate(p.expression, p.options);
    };
    const Result first = once(bracket);
    ASSERT_NE(first.certificate.verdict, Verdict::unresolved);
    const Result second = once(Polyhedron::trusted(first.vertices, first.triangles));
    ASSERT_NE(second.certificate.verdict, Verdict::unresolved);
    const Surface a(first.vertices, first.triangles), c(second.vertices, second.triangles);
    // Each is within its bound of an opening, and what it is an opening of differs by the first's bound at most. (Not true of every
    // solid: what is about as thin as the ball is wide may go.)
    const double most = 2 * (first.certificate.error_bound + second.certificate.error_bound);
    for (const Vec3& p : second.vertices) EXPECT_LE(a.distance(p), most);
    for (const Vec3& p : first.vertices) EXPECT_LE(c.distance(p), most);
    EXPECT_EQ(topology(first), topology(second));
  }
}

}  // namespace
}  // namespace starcell
