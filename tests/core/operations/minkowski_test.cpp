// Sums and erosions: closed forms, sums of convex parts united by the Boolean engine, algebra, thin tunnels.
#include "operations/minkowski.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

using Prepare = Prepared (*)(const Expression&, const Expression&, const Options&);

Result run(Prepare prepare, const Expression& a, const Expression& b, double error, double contact = 0) {
  const Prepared p = prepare(a, b, with_error(error, contact));
  return evaluate(p.expression, p.options);
}

Result sum(const Mesh& a, const Mesh& b, double error) { return run(&prepare_minkowski_sum, solid(a), solid(b), error); }

/// The hull of all sums of vertices: the sum of two convex solids (CGAL).
Expression convex_sum(const Mesh& a, const Mesh& b) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> sums;
  for (const Vec3& p : a.vertices)
    for (const Vec3& q : b.vertices) sums.emplace_back(p.x() + q.x(), p.y() + q.y(), p.z() + q.z());
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(sums.begin(), sums.end(), hull);
  Mesh mesh;
  std::map<std::uint32_t, std::uint32_t> index;
  for (const auto v : hull.vertices()) {
    index[v] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(hull.point(v).x(), hull.point(v).y(), hull.point(v).z());
  }
  for (const auto f : hull.faces()) {
    Triangle t{};
    int k = 0;
    for (const auto v : hull.vertices_around_face(hull.halfedge(f))) t[k++] = index[v];
    mesh.triangles.push_back(t);
  }
  return solid(mesh);
}

/// Boxes whose union is the solid.
using Parts = std::vector<std::pair<Vec3, Vec3>>;
const Parts ell{{{0, 0, 0}, {2, 1, 1}}, {{0, 0, 0}, {1, 2, 1}}};
const Parts frame{{{0, 0, 0}, {3, 1, 1}}, {{0, 2, 0}, {3, 3, 1}}, {{0, 0, 0}, {1, 3, 1}}, {{2, 0, 0}, {3, 3, 1}}};
const Parts two{{{0, 0, 0}, {1, 1, 1}}, {{3, 0, 0}, {4, 1, 1}}};

Mesh mesh_of(const Parts& parts, const Eigen::Matrix3d& rotation, const Vec3& shift) {
  std::vector<Expression> boxes;
  for (const auto& [low, high] : parts) boxes.push_back(solid(box(low, high)));
  const Result r = evaluate(Expression::set_union(boxes), with_error(0.01));
  return turned({r.vertices, r.triangles}, rotation, shift);
}

Mesh l_shape() { return mesh_of(ell, Eigen::Matrix3d::Identity(), Vec3::Zero()); }

// (A1 u A2 ...) + B is the union of Ai + B, and each of those the hull of its vertices' sums: another way to the same solid.
TEST(MinkowskiSum, IsTheUnionOfTheSumsOfConvexParts) {
  std::mt19937 random(5);
  const std::vector<std::pair<Parts, Parts>> pairs{{ell, ell}, {frame, ell}, {two, frame}, {frame, {{{0, 0, 0}, {0.3, 0.2, 0.5}}}}, {two, {{{0, 0, 0}, {0.05, 0.05, 4}}}}};
  for (const auto& [a, b] : pairs)
    for (int turn = 0; turn < 2; ++turn) {
      const Eigen::Matrix3d ra = random_rotation(random), rb = random_rotation(random);
      const Vec3 sa(1, -7, 2), sb(5, 3, -4);
      std::vector<Expression> sums;
      for (const auto& [alow, ahigh] : a)
        for (const auto& [blow, bhigh] : b) sums.push_back(convex_sum(turned(box(alow, ahigh), ra, sa), turned(box(blow, bhigh), rb, sb)));
      const Result expected = evaluate(Expression::set_union(sums), with_error(1e-3));
      const Result r = sum(mesh_of(a, ra, sa), mesh_of(b, rb, sb), 0.05);
      const std::string what = std::to_string(a.size()) + " and " + std::to_string(b.size()) + " boxes";
      EXPECT_EQ(r.certificate.verdict, Verdict::exact);
      expect_sound(r, what);
      EXPECT_EQ(topology(r), topology(expected)) << what;
      // Either mesh is off by its own bound at most.
      EXPECT_NEAR(volume(r), volume(expected), r.certificate.error_bound * area(r) + expected.certificate.error_bound * area(expected) + 1e-9) << what;
    }
}

// Every plane in the sum of boxes is shared by a dozen candidates, and the origin is nowhere near (ANCHORS: volumes 8, 16, 729).
TEST(MinkowskiSum, OfAlignedBoxesAnywhere) {
  const Mesh unit = box({0, 0, 0}, {1, 1, 1}), far = box({10, 0, 0}, {11, 1, 1});
  const Result cubes = sum(unit, far, 0.05);
  expect_result(cubes, solid_ball(), 8, 1e-9, "cube + cube");
  EXPECT_EQ(cubes.triangles.size(), 12u);
  expect_result(sum(l_shape(), far, 0.05), solid_ball(), 16, 1e-9, "L + cube");
  const Result eroded = run(&prepare_erosion, solid(box({0, 0, 0}, {10, 10, 10})), solid(box({5, 3, -2}, {6, 4, -1})), 0.05);
  expect_result(eroded, solid_ball(), 729, 1e-9, "cube eroded");
  EXPECT_NEAR(eroded.vertices.front().x(), eroded.vertices.front().x() < 0 ? -5 : 4, 1e-9);
}

TEST(MinkowskiSum, CommutesAndFollowsTranslations) {
  std::mt19937 random(8);
  const Mesh a = turned(torus(8, 5, 2.0, 0.6), random_rotation(random)), b = turned(l_shape(), random_rotation(random));
  const Result one = sum(a, b, 0.05), other = sum(b, a, 0.05), far = sum(moved(a, {11, -20, 7}), b, 0.05);
  expect_sound(one);
  for (const Result* r : {&other, &far}) {
    EXPECT_EQ(topology(*r), topology(one));
    EXPECT_NEAR(volume(*r), volume(one), 1e-6);
  }
}

Mesh plate_with_hole() { return mesh_of(frame, Eigen::Matrix3d::Identity(), Vec3::Zero()); }

// A hole of side 1 is open to all cubes that are smaller, by however little.
TEST(MinkowskiSum, TunnelsCloseWhereTheyShould) {
  for (const auto& [side, genus] : {std::pair(1 - 1e-4, 1), std::pair(1 + 1e-4, 0)}) {
    const Result r = run(&prepare_minkowski_sum, solid(plate_with_hole()), solid(box({0, 0, 0}, {side, side, side})), 0.1, 1e-7);
    EXPECT_NE(r.certificate.verdict, Verdict::unresolved);
    expect_sound(r);
    EXPECT_EQ(topology(r), (Topology{1, {genus}})) << side;
  }
}

// However thin, a tunnel is one piece of a cell: few cells, and no more triangles than its walls need, in any rotation.
TEST(MinkowskiSum, ThinTunnelsAreCheapInAnyRotation) {
  std::mt19937 random(14);
  for (const double gap : {1e-2, 1e-4}) {
    const Eigen::Matrix3d rotation = random_rotation(random);
    const double side = 1 - gap;
    const Result r = run(&prepare_minkowski_sum, solid(turned(plate_with_hole(), rotation)), solid(turned(box({0, 0, 0}, {side, side, side}), rotation)), 0.1, 1e-7);
    EXPECT_EQ(r.certificate.verdict, Verdict::exact);
    expect_result(r, {1, {1}}, (std::pow(3 + side, 2) - gap * gap) * (1 + side), 1e-7, std::to_string(gap));
    EXPECT_EQ(r.triangles.size(), 32u);
    EXPECT_LT(r.certificate.statistics.at("cells"), 3000);
  }
}

// What rounding cannot tell apart is no proof of its topology: a gap, a tunnel or a neck of 0 or 1e-12 is a contact.
TEST(MinkowskiSum, OfAnExactFitIsAContact) {
  const Expression unit = solid(box({0, 0, 0}, {1, 1, 1}));
  for (const double gap : {0.0, 1e-13, 1e-12}) {
    const Mesh apart = joined({box({0, 0, 0}, {1, 1, 1}), box({2 + gap, 0, 0}, {3, 1, 1})});
    EXPECT_EQ(sum(apart, box({0, 0, 0}, {1, 1, 1}), 0.05).certificate.verdict, Verdict::contact) << gap;
    const Expression hole = solid(box({0, 0, 0}, {3, 3, 1})) - solid(box({1, 1, -1}, {2 + gap, 2 + gap, 2}));
    const Result plate = evaluate(hole, with_error(0.01));
    EXPECT_EQ(run(&prepare_minkowski_sum, solid(Mesh{plate.vertices, plate.triangles}), unit, 0.05).certificate.verdict, Verdict::contact) << gap;
    const Expression neck = Expression::set_union({solid(box({0, 0, 0}, {3, 3, 3})), solid(box({2.5, 1, 1}, {7.5, 2 + gap, 2 + gap})), solid(box({7, 0, 0}, {10, 3, 3}))});
    const Result dumbbell = evaluate(neck, with_error(0.01));
    EXPECT_EQ(run(&prepare_erosion, solid(Mesh{dumbbell.vertices, dumbbell.triangles}), unit, 0.05).certificate.verdict, Verdict::contact) << gap;
  }
  const Mesh wider = joined({box({0, 0, 0}, {1, 1, 1}), box({2 + 1e-9, 0, 0}, {3, 1, 1})});
  const Result two = sum(wider, box({0, 0, 0}, {1, 1, 1}), 0.05);
  EXPECT_EQ(two.certificate.verdict, Verdict::exact);
  EXPECT_EQ(two.certificate.components, 2);
}

// A cavity stays as long as what is added fits into it with room to move.
TEST(MinkowskiSum, KeepsCavities) {
  const Mesh hollow = joined({box({0, 0, 0}, {3, 3, 3}), flipped(box({1, 1, 1}, {2, 2, 2}))});
  const Result r = sum(hollow, box({0, 0, 0}, {0.4, 0.4, 0.4}), 0.05);
  EXPECT_EQ(topology(r), (Topology{2, {0, 0}}));
  EXPECT_NEAR(volume(r), std::pow(3.4, 3) - std::pow(0.6, 3), 1e-6);
  EXPECT_EQ(topology(sum(hollow, box({0, 0, 0}, {1.2, 1.2, 1.2}), 0.05)), solid_ball());
}

TEST(MinkowskiSum, OfManyFacets) {
  std::mt19937 random(6);
  const Mesh ring = torus(24, 12, 2.0, 0.7), ball = turned(sphere(2, 0.5), random_rotation(random));
  const double error = 0.06;
  const Result r = sum(ring, ball, error);
  // Between the sums of what the meshes are inscribed in and circumscribed about: a torus of minor radius 1.2 at most.
  const double most = 2 * std::numbers::pi * std::numbers::pi * 2.0 * 1.2 * 1.2;
  EXPECT_NE(r.certificate.verdict, Verdict::unresolved);
  EXPECT_LE(r.certificate.error_bound, error);
  expect_sound(r);
  EXPECT_EQ(topology(r), (Topology{1, {1}}));
  EXPECT_GT(volume(r), 0.8 * most);
  EXPECT_LT(volume(r), most);
}

TEST(Erosion, IsWhereTheElementFits) {
  const Mesh cube = box({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3});
  // The frame's bars are 1 thick: 0.4 are left, and its outline shrinks by 0.3 on every side, its hole grows by as much.
  const Result r = run(&prepare_erosion, solid(plate_with_hole()), solid(cube), 0.05);
  expect_result(r, {1, {1}}, (2.4 * 2.4 - 1.6 * 1.6) * 0.4, 1e-9, "frame");
  const Result gone = run(&prepare_erosion, solid(plate_with_hole()), solid(box({0, 0, 0}, {1.1, 1.1, 1.1})), 0.05);
  EXPECT_EQ(gone.certificate.verdict, Verdict::exact);
  EXPECT_TRUE(gone.triangles.empty());
  // In a rotation of both.
  std::mt19937 random(3);
  const Eigen::Matrix3d rotation = random_rotation(random);
  const Result turned_both = run(&prepare_erosion, solid(turned(plate_with_hole(), rotation)), solid(turned(cube, rotation)), 0.05);
  expect_result(turned_both, {1, {1}}, (2.4 * 2.4 - 1.6 * 1.6) * 0.4, 1e-9, "frame, turned");
}

// A bar of 0.2 at the side of a cube of 2 goes where a cube of 0.5 is to fit, and the cube stays as it was.
TEST(Morphology, OpeningAndClosingWithACube) {
  const Expression part = solid(box({0, 0, 0}, {2, 2, 2})) | solid(box({2, 0.9, 0.9}, {3, 1.1, 1.1}));
  const Expression element = solid(box({0, 0, 0}, {0.5, 0.5, 0.5}));
  const Result opened = run(&prepare_opening, part, element, 0.05);
  expect_result(opened, solid_ball(), 8, 0.05, "opening");
  const Expression slotted = solid(box({0, 0, 0}, {2, 2, 2})) - solid(box({0.9, -1, 1}, {1.1, 3, 3}));
  const Result closed = run(&prepare_closing, slotted, element, 0.05);
  expect_result(closed, solid_ball(), 8, 0.05, "closing");
}

TEST(MinkowskiSum, WithABallIsAnOffset) {
  const Expression one(CurvedSolid::sphere({1, 2, 3}, 1)), other(CurvedSolid::sphere({4, 5, 6}, 2));
  const Result r = run(&prepare_minkowski_sum, one, other, 0.05);
  EXPECT_TRUE(r.certificate.tessellated.empty());
  expect_result(r, solid_ball(), 36 * std::numbers::pi, 0.05, "two balls");
}

TEST(MinkowskiSum, NamesWhatItMeshed) {
  const Expression ring(CurvedSolid::torus(Vec3::Zero(), Vec3::UnitZ(), 2, 0.5));
  const Result r = run(&prepare_minkowski_sum, ring, solid(box({0, 0, 0}, {0.3, 0.3, 0.3})), 0.1);
  ASSERT_EQ(r.certificate.tessellated.size(), 1u);
  EXPECT_EQ(r.certificate.tessellated.front().first, "mesh of the first solid");
  EXPECT_LE(r.certificate.error_bound, 0.1);
  EXPECT_EQ(topology(r), (Topology{1, {1}}));
}

TEST(MinkowskiSum, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(9);
  const Mesh a = turned(torus(9, 6, 2.0, 0.7), random_rotation(random)), b = turned(pebble(random, 1), random_rotation(random));
  const Prepared p = prepare_minkowski_sum(solid(a), solid(b), with_error(0.05));
  Options alone = p.options;
  alone.threads = 1;
  EXPECT_TRUE(identical(evaluate(p.expression, p.options), evaluate(p.expression, alone)));
}

TEST(MinkowskiSum, SaysWhatABudgetLeftOpen) {
  std::mt19937 random(9);
  Options options = with_error(0.02);
  options.budget.max_cells = 40;
  const Prepared p = prepare_minkowski_sum(solid(turned(torus(9, 6), random_rotation(random))), solid(pebble(random, 1)), options);
  const Result r = evaluate(p.expression, p.options);
  EXPECT_EQ(r.certificate.verdict, Verdict::unresolved);
  EXPECT_EQ(bad_edges(r), 0u);
}

// An L of n x n squares without a quarter, two triangles a square, a wall below each side.
Mesh gridded_l(int n, double side) {
  Mesh m;
  const auto holds = [n](int i, int j) { return i >= 0 && j >= 0 && i < n && j < n && (2 * i < n || 2 * j < n); };
  std::map<std::array<int, 3>, std::uint32_t> index;
  const auto at = [&](int i, int j, int k) {
    const auto [it, fresh] = index.emplace(std::array<int, 3>{i, j, k}, static_cast<std::uint32_t>(m.vertices.size()));
    if (fresh) m.vertices.emplace_back(i * side / n, j * side / n, k);
    return it->second;
  };
  const auto quad = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) { m.triangles.push_back({p, q, r}), m.triangles.push_back({p, r, s}); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (!holds(i, j)) continue;
      quad(at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1));
      quad(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
      const std::array<std::array<int, 2>, 4> corners{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}}, beside{{{i, j - 1}, {i + 1, j}, {i, j + 1}, {i - 1, j}}};
      for (int k = 0; k < 4; ++k) {
        const auto &p = corners[k], &q = corners[(k + 1) % 4];
        if (!holds(beside[k][0], beside[k][1])) quad(at(p[0], p[1], 0), at(q[0], q[1], 0), at(q[0], q[1], 1), at(p[0], p[1], 1));
      }
    }
  return m;
}

// Faces of many facets are covered by the sum of their hulls, which reaches over the notch where nothing of the sum is.
TEST(MinkowskiSum, OfFinelyMeshedFacesIsThatOfCoarseOnes) {
  std::mt19937 random(19);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix3d rotation = k == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random_rotation(random);
    const auto plates = [&](int n, int m) { return sum(turned(gridded_l(n, 4), rotation), turned(gridded_l(m, 1), rotation), 0.1); };
    const Result fine = plates(20, 14), coarse = plates(2, 2);
    EXPECT_NE(fine.certificate.verdict, Verdict::unresolved);
    EXPECT_EQ(topology(fine), (Topology{1, {0}}));
    // [0, 5] x [0, 2.5], [0, 4.5] x [0, 3] and the same turned: 20.5; twice as high.
    EXPECT_NEAR(volume(coarse.vertices, coarse.triangles), 41, 1e-6);
    EXPECT_NEAR(volume(fine.vertices, fine.triangles), 41, 1e-6);
  }
}

// Time may end before there is anything to contour: then the whole sum is open.
TEST(MinkowskiSum, SaysWhenTimeEndsBeforeAnyFacetIsMade) {
  std::mt19937 random(9);
  Options options = with_error(0.02);
  options.budget.max_seconds = 1e-3;
  const Mesh ring = turned(torus(60, 40), random_rotation(random));
  const Prepared p = prepare_minkowski_sum(solid(ring), solid(ring), options);
  EXPECT_NE(p.expression.kind(), Expression::Kind::sum);
  const Result r = evaluate(p.expression, p.options);
  EXPECT_EQ(r.certificate.verdict, Verdict::unresolved);
  ASSERT_EQ(r.certificate.unresolved.size(), 1u);
  EXPECT_TRUE(r.triangles.empty());
}

}  // namespace
}  // namespace starcell
