// Offsets, shells, openings and closings: volumes from closed forms, topology on either side of critical widths.
#include "operations/offset.h"

#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

constexpr double pi = std::numbers::pi;

Result offset(const Expression& solid, double distance, double error, double contact = 0) {
  const Prepared p = prepare_offset(solid, distance, with_error(error, contact));
  return evaluate(p.expression, p.options);
}

Result shell(const Expression& solid, double thickness, double error) {
  const Prepared p = prepare_shell(solid, thickness, with_error(error));
  return evaluate(p.expression, p.options);
}

Mesh block(const Vec3& low, const Vec3& high) { return box(low, high); }

// Steiner (1840): V + A r + M r^2 + 4/3 pi r^3; of a box M is pi times the sum of its sides.
double steiner(const Vec3& sides, double r) {
  const double a = sides.x(), b = sides.y(), c = sides.z();
  return a * b * c + 2 * (a * b + b * c + c * a) * r + pi * (a + b + c) * r * r + 4 * pi / 3 * r * r * r;
}

TEST(Offset, OfABoxIsSteinersInEveryRotation) {
  std::mt19937 random(3);
  const Vec3 sides(1, 2, 0.7);
  for (const double r : {0.05, 0.4, 1.5}) {
    const Expression turned_box = solid(turned(block({0, 0, 0}, sides), random_rotation(random), {0.1, 0.2, 0.3}));
    expect_result(offset(turned_box, r, 0.04), solid_ball(), steiner(sides, r), 0.04, "r = " + std::to_string(r));
  }
  const Result inward = offset(solid(turned(block({0, 0, 0}, sides), random_rotation(random))), -0.3, 0.04);
  expect_result(inward, solid_ball(), 0.4 * 1.4 * 0.1, 0.04, "inward");
}

// Flat faces come out flat: nothing but rounding is between the mesh and the inward offset of a box.
TEST(Offset, InwardOfABoxIsABox) {
  const Result r = offset(solid(block({0, 0, 0}, {1, 1, 1})), -0.2, 0.05);
  EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  EXPECT_NEAR(volume(r), 0.216, 1e-6);
}

TEST(Offset, APlateVanishesAtHalfItsThickness) {
  const Expression plate = solid(block({0, 0, 0}, {5, 5, 0.5}));
  for (const double share : {0.98, 1 - 1e-4}) {
    const Result r = offset(plate, -0.25 * share, 0.1, 1e-8);
    EXPECT_EQ(sample::topology(r), solid_ball()) << share;
    EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  }
  for (const double share : {1 + 1e-4, 1.02}) {
    const Result r = offset(plate, -0.25 * share, 0.1, 1e-8);
    EXPECT_TRUE(r.triangles.empty()) << share;
    EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  }
}

TEST(Offset, ASlotClosesAtHalfItsWidth) {
  Expression slotted = solid(block({0, 0, 0}, {3, 3, 1})) - solid(block({1, 1, -1}, {2, 2, 2}));
  EXPECT_EQ(topology(offset(slotted, 0.49, 0.2)), (Topology{1, {1}}));
  EXPECT_EQ(topology(offset(slotted, 0.51, 0.2)), solid_ball());
}

TEST(Offset, OfBallsAndUnionsNeedsNoMesh) {
  const Expression a(CurvedSolid::sphere({0, 0, 0}, 1)), b(CurvedSolid::sphere({4, 0, 0}, 1));
  const Result apart = offset(a | b, 0.9999, 0.2, 1e-7), joined = offset(a | b, 1.0001, 0.2, 1e-7);
  EXPECT_EQ(topology(apart), (Topology{2, {0, 0}}));
  EXPECT_EQ(topology(joined), solid_ball());
  EXPECT_TRUE(joined.certificate.tessellated.empty());
}

// Two cuboids with four planes in common: offset one by one, their surfaces would coincide.
TEST(Offset, OfAUnionWithCommonPlanes) {
  const Expression angle = solid(block({0, 0, 0}, {2, 1, 1})) | solid(block({0, 0, 0}, {1, 2, 1}));
  // Volume 3, faces of 2 * 3 + 8, five convex upright edges of length 1, rims of 2 * 8, ten corners of an eighth of a ball. At the concave
  // edge the walls overlap in a square r^2, and the rims' quarter cylinders in twice the integral of r^2 - z^2.
  const double r = 0.3;
  const double expected = 3 + 14 * r + 5 * pi / 4 * r * r - r * r + 4 * pi * r * r + 5 * pi / 3 * r * r * r - 4.0 / 3 * r * r * r;
  const Result result = offset(angle, r, 0.05);
  EXPECT_EQ(result.certificate.verdict, Verdict::contact);   // as the union's
  EXPECT_EQ(topology(result), solid_ball());
  EXPECT_NEAR(volume(result), expected, 0.01 * expected);
}

// A millionth apart, the union is one solid within the contact tolerance, and so is its erosion: that of the true solids is two.
TEST(Offset, OfAContactIsOne) {
  const Expression both = solid(block({0, 0, 0}, {4, 4, 4})) | solid(block({4 + 1e-6, 0.5, 0.5}, {8, 3, 3}));
  const Result result = offset(both, -0.5, 0.2);
  EXPECT_EQ(result.certificate.verdict, Verdict::contact);
  EXPECT_FALSE(result.certificate.contacts.empty());
}

// Of a convex solid of revolution: its volume, its area times r, its mean curvature's part, the ball's. That of the side is pi times its
// height, that of a rim half its length times the angle that normals turn there.
double steiner(double radius1, double radius2, double height, double r) {
  const double slope = (radius2 - radius1) / height, length = std::sqrt(1 + slope * slope), up = -slope / length;
  const double volume = pi * height * (radius1 * radius1 + radius1 * radius2 + radius2 * radius2) / 3;
  const double area = pi * (radius1 * radius1 + radius2 * radius2 + (radius1 + radius2) * height * length);
  const double curvature = pi * height + pi * radius1 * std::acos(-up) + pi * radius2 * std::acos(up);
  return volume + area * r + curvature * r * r + 4 * pi / 3 * r * r * r;
}

TEST(Offset, OfCylindersAndConesNeedsNoMesh) {
  const Vec3 base(0.1, 0.2, 0.3), axis(1, 2, 3);
  for (const double r : {0.05, 0.3}) {
    const auto expect = [&](const CurvedSolidPtr& s, double expected) {
      const Result result = offset(Expression(s), r, 0.05);
      EXPECT_EQ(result.certificate.verdict, Verdict::exact);
      EXPECT_TRUE(result.certificate.tessellated.empty());
      expect_result(result, solid_ball(), expected, 0.05, "of revolution");
    };
    expect(CurvedSolid::cylinder(base, axis, 1, 2), steiner(1, 1, 2, r));
    expect(CurvedSolid::cone(base, axis, 1, 0.5, 2), steiner(1, 0.5, 2, r));
    expect(CurvedSolid::cone(base, axis, 0.4, 1.1, 1), steiner(0.4, 1.1, 1, r));
    expect(CurvedSolid::cone(base, axis, 1, 0, 2), steiner(1, 0, 2, r));
    expect(CurvedSolid::cone(base, axis, 0, 1, 1.5), steiner(0, 1, 1.5, r));
  }
}

TEST(Offset, WhatHasNoClosedFormIsNamed) {
  const Expression disc(CurvedSolid::cylinder({0.1, 0.2, 0.3}, {1, 2, 3}, 1, 0.5));
  const Result r = offset(disc, 1.2, 0.1);   // tori as thick as that would meet themselves
  ASSERT_EQ(r.certificate.tessellated.size(), 1u);
  EXPECT_GT(r.certificate.tessellated.front().second, 0);
  expect_result(r, solid_ball(), steiner(1, 1, 0.5, 1.2), 0.1, "disc");
}

// Two reflex edges of a block on a plate, and the plate's far side: where their offsets meet, normals along the axes stand against a
// kink whose slopes' box has a corner that none of them is near.
TEST(Offset, ReflexEdgesAboveAPlate) {
  const Expression e = solid(block({0, 0, 0}, {2, 20, 15})) | solid(block({0, 0, 0}, {10, 10, 10}));
  const Result mesh = evaluate(e, with_error(0.1));
  const Result r = offset(Expression(Polyhedron::trusted(mesh.vertices, mesh.triangles)), -1.1, 0.1);
  EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  EXPECT_EQ(topology(r), (Topology{1, {0}}));   // the plate is gone: it is thinner than 2.2
}

// Walls of exactly twice the radius are gone, gaps closed: told as a contact, which is where the sheets would meet.
TEST(Offset, ExactlyCriticalWidths) {
  const auto meshed = [](const Expression& e) {
    const Result mesh = evaluate(e, with_error(0.1));
    return Expression(Polyhedron::trusted(mesh.vertices, mesh.triangles));
  };
  const Expression angle = meshed(solid(block({0, 0, 0}, {20, 2, 15})) | solid(block({0, 0, 0}, {2, 20, 15})));
  const Expression slotted = meshed(solid(block({0, 0, 0}, {20, 20, 10})) - solid(block({9, -1, 4}, {11, 21, 11})));
  const Result eroded = offset(angle, -1, 0.2), closed = offset(slotted, 1, 0.4);
  EXPECT_EQ(eroded.certificate.verdict, Verdict::contact);
  EXPECT_EQ(topology(eroded), (Topology{1, {0}}));       // the bar along the corner is thicker than its walls
  EXPECT_LT(volume(eroded), 2 * 2 * 15);
  EXPECT_LE(eroded.certificate.error_bound, 0.2);
  EXPECT_EQ(closed.certificate.verdict, Verdict::contact);
  EXPECT_EQ(topology(closed), (Topology{1, {0}}));
  ASSERT_FALSE(closed.certificate.contacts.empty());
  const auto& [low, high] = std::pair(closed.certificate.contacts.front().min(), closed.certificate.contacts.front().max());
  EXPECT_LT(low.x(), 10);
  EXPECT_GT(high.x(), 10);
  EXPECT_LT(low.z(), 5);
  EXPECT_GT(high.z(), 9);
  // What is off by more than coordinates lose is told as it is.
  EXPECT_EQ(offset(angle, -1.001, 0.2).certificate.verdict, Verdict::exact);
  const Result thin = offset(angle, -0.99, 0.2);
  EXPECT_EQ(thin.certificate.verdict, Verdict::exact);
  EXPECT_GT(volume(thin), 0.02 * 2 * 15 * 13);
}

// A mesh made on the way that ran out of its budget proves nothing of the result.
TEST(Offset, OfWhatIsNotCertifiedIsNot) {
  const Expression bitten = solid(block({0, 0, 0}, {2, 2, 2})) - Expression(CurvedSolid::sphere({1, 1, 2}, 0.7));
  Options options = with_error(0.1);
  options.budget.max_depth = 4;
  const Prepared prepared = prepare_offset(bitten, 0.2, options);
  Options patient = prepared.options;
  patient.budget = {};
  const Result r = evaluate(prepared.expression, patient);
  EXPECT_EQ(r.certificate.verdict, Verdict::unresolved);
  EXPECT_FALSE(r.certificate.unresolved.empty());
  EXPECT_TRUE(std::isinf(r.certificate.error_bound));
}

// Nor does one that could not be made at all: the result says so, nothing is thrown.
TEST(Offset, OfWhatHasNoMeshIsUnresolved) {
  const Expression both = solid(block({0, 0, 0}, {2, 2, 2})) | Expression(CurvedSolid::sphere({2, 1, 1}, 0.7));
  Options options = with_error(0.01);
  options.budget.max_cells = 20;
  const Prepared prepared = prepare_offset(both, -0.2, options);
  const Result r = evaluate(prepared.expression, prepared.options);
  EXPECT_EQ(r.certificate.verdict, Verdict::unresolved);
  EXPECT_FALSE(r.certificate.unresolved.empty());
  EXPECT_TRUE(std::isinf(r.certificate.error_bound));
}

// A cube one of whose faces has a needle of 1e-13 along its edge, as tessellations of CAD faces do: in double its normal is noise.
TEST(Offset, OfACubeWithANeedle) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 1e-13, 1}};
  const std::vector<Triangle> triangles{{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6},
                                        {3, 0, 4}, {3, 4, 7}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}};
  std::mt19937 random(3);
  const Result result = offset(solid(turned({points, triangles}, random_rotation(random), {0.1, 0.2, 0.3})), 0.25, 0.02);
  EXPECT_EQ(result.certificate.verdict, Verdict::exact);
  const double r = 0.25, expected = 1 + 6 * r + 3 * pi * r * r + 4.0 / 3 * pi * r * r * r;   // Steiner
  EXPECT_NEAR(volume(result), expected, 0.02 * 6 * (1 + 2 * r) * (1 + 2 * r));
}

// An erosion that could not be made is not one that leaves nothing.
TEST(Opening, OfWhatHasNoMeshIsUnresolved) {
  const Expression ring = solid(sample::torus(12, 8));
  for (const auto prepare : {&prepare_opening, &prepare_closing}) {
    Options options = with_error(0.4);
    options.budget.max_cells = 1;
    const Prepared prepared = prepare(ring, 0.2, options);
    Options patient = prepared.options;
    patient.budget = {};
    EXPECT_EQ(evaluate(prepared.expression, patient).certificate.verdict, Verdict::unresolved);
  }
}

// Nothing, as far as is known of two tessellated solids: their deflection is told.
TEST(Offset, OfNothingIsAsFarAsItIsKnown) {
  const auto tessellated = [](const Vec3& low, const Vec3& high) {
    const auto b = block(low, high);
    Provenance provenance;
    provenance.name = "part";
    provenance.deflection = 0.01;
    return Expression(Polyhedron::trusted(b.vertices, b.triangles, provenance));
  };
  const Result result = offset(tessellated({0, 0, 0}, {1, 1, 1}) & tessellated({1.001, 0, 0}, {2, 1, 1}), 0.2, 0.1);
  EXPECT_TRUE(result.triangles.empty());
  ASSERT_EQ(result.certificate.tessellated.size(), 1u);
  EXPECT_GE(result.certificate.tessellated.front().second, 0.01);
  EXPECT_GE(result.certificate.error_bound, 0.01);
}

// Two blocks that are apart have nothing in common, and it does not grow.
TEST(Offset, OfNothingIsNothing) {
  const Expression nothing = solid(block({0, 0, 0}, {1, 1, 1})) & solid(block({3, 0, 0}, {4, 1, 1}));
  for (const double r : {0.2, -0.2}) {
    const Result result = offset(nothing, r, 0.1);
    EXPECT_EQ(result.certificate.verdict, Verdict::exact);
    EXPECT_TRUE(result.triangles.empty());
  }
}

TEST(Offset, RefusesWhatIsNoDistance) {
  const Expression a = solid(block({0, 0, 0}, {1, 1, 1}));
  for (const double distance : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(prepare_offset(a, distance, with_error(0.1)), std::invalid_argument);
    EXPECT_THROW(prepare_shell(a, distance, with_error(0.1)), std::invalid_argument);
    EXPECT_THROW(prepare_opening(a, distance, with_error(0.1)), std::invalid_argument);
  }
  EXPECT_THROW(prepare_closing(a, -1, with_error(0.1)), std::invalid_argument);
}

TEST(Shell, OfABoxHasTwoSides) {
  const Expression a = solid(block({0, 0, 0}, {3, 3, 3}));
  expect_result(shell(a, 0.2, 0.05), {2, {0, 0}}, steiner({3, 3, 3}, 0.2) - 27, 0.05, "outside");
  expect_result(shell(a, -0.2, 0.05), {2, {0, 0}}, 27 - 2.6 * 2.6 * 2.6, 0.05, "inside");
}

// A tray: the cavity has sharp edges, and reaches through the open top.
TEST(Shell, LeavesFacesOpen) {
  const Mesh m = block({0, 0, 0}, {4, 3, 2});
  std::vector<std::int64_t> top;
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (std::all_of(m.triangles[t].begin(), m.triangles[t].end(), [&](std::uint32_t v) { return m.vertices[v].z() == 2; }))
      top.push_back(static_cast<std::int64_t>(t));
  ASSERT_EQ(top.size(), 2u);
  std::mt19937 random(5);
  for (int i = 0; i < 3; ++i) {
    const Expression tray = solid(turned(m, random_rotation(random), {0.1, 0.2, 0.3}));
    const Prepared inside = prepare_shell(tray, -0.3, with_error(0.05), top);
    const Result r = evaluate(inside.expression, inside.options);
    EXPECT_EQ(r.certificate.verdict, Verdict::exact);
    EXPECT_EQ(topology(r), solid_ball());
    EXPECT_NEAR(volume(r), 24 - 3.4 * 2.4 * 1.7, 0.02);
    const Prepared outside = prepare_shell(tray, 0.3, with_error(0.05), top);
    const Result o = evaluate(outside.expression, outside.options);
    EXPECT_EQ(o.certificate.verdict, Verdict::exact);
    EXPECT_EQ(topology(o), solid_ball());
    // Bottom and four sides, quarter cylinders along the bottom's and the upright edges, eighths of a ball at its corners; the rim is
    // rounded about the top's edges: quarter cylinders and quarters of what lies beyond its corners.
    const double r3 = 0.3;
    const double expected = (12 + 14 * 2) * r3 + pi / 4 * r3 * r3 * (14 + 4 * 2) + 4 * pi / 24 * r3 * r3 * r3 * 4 +
                            pi / 4 * r3 * r3 * 14 + 4 * pi / 24 * r3 * r3 * r3 * 4;
    const double over_the_edge = pi / 4 * r3 * r3 * 14;   // over the top's plane, inside its outline: at most that much
    EXPECT_GT(volume(o), expected - 0.1);
    EXPECT_LT(volume(o), expected + over_the_edge + 0.1);
  }
  EXPECT_THROW(prepare_shell(solid(m), -0.3, with_error(0.1), {99}), std::invalid_argument);
  EXPECT_THROW(prepare_shell(solid(m), -0.3, with_error(0.1), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}), std::invalid_argument);
  EXPECT_THROW(prepare_shell(Expression(CurvedSolid::sphere({0, 0, 0}, 1)), -0.3, with_error(0.1), {0}), std::invalid_argument);
}

TEST(Opening, TakesThinFinsAndClosingFillsThinSlots) {
  const Expression fin = solid(block({0, 0, 0}, {3, 3, 2})) | solid(block({1, 1.3, 2}, {2, 1.7, 3}));
  const Prepared open = prepare_opening(fin, 0.4, with_error(0.1));
  const Result opened = evaluate(open.expression, open.options);
  EXPECT_EQ(topology(opened), solid_ball());
  double highest = 0;
  for (const Vec3& p : opened.vertices) highest = std::max(highest, p.z());
  EXPECT_NEAR(highest, 2, 0.1);

  const Expression slotted = solid(block({0, 0, 0}, {3, 3, 1})) - solid(block({1, 1, -1}, {1.6, 2, 2}));
  for (const auto& [radius, genus] : {std::pair{0.4, 0}, std::pair{0.2, 1}}) {
    const Prepared close = prepare_closing(slotted, radius, with_error(0.1));
    const Result closed = evaluate(close.expression, close.options);
    EXPECT_NE(closed.certificate.verdict, Verdict::unresolved);
    EXPECT_EQ(topology(closed), (Topology{1, {genus}})) << radius;
  }
}

}  // namespace
}  // namespace starcell
