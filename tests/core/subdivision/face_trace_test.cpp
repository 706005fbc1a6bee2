// E on single faces, for solids whose cross-section can be read off by eye. The face is x = 4, y and z in [4, 8].
#include "subdivision/face_trace.h"

#include <gtest/gtest.h>

#include "subdivision/scene.h"

namespace starcell {
namespace {

using namespace sample;
using Op = LocalExpression::Op;

struct Traced {
  std::optional<std::vector<Arc>> arcs;
  Statistics statistics;
};

void trace(const std::vector<Mesh>& meshes, Op op, Traced& traced) {
  const Scene scene(meshes, op);
  const CellProblem problem = scene.at({4, 4, 4}, 4);
  RimLines rims(scene.restriction, problem);
  traced.arcs = trace_face(scene.restriction, problem, problem.facets, face_of(problem.cell, 0), {1e-6, 1e-2}, LocalPlanes(), rims, traced.statistics);
}

/// Where on the face's plane an arc starts and ends: (axis, coordinate along it, coordinate of the line).
std::array<double, 2> end_point(const Crossing& x) {
  // axis 1: a line along y at z = i; axis 2: a line along z at y = j (the line's axes are axis+1, axis+2 cyclically).
  return x.axis == 1 ? std::array<double, 2>{x.at, double(x.i)} : std::array<double, 2>{double(x.j), x.at};
}

using Ends = std::array<std::array<double, 2>, 2>;
std::vector<Ends> ends(const std::vector<Arc>& arcs) {
  std::vector<Ends> all;
  for (const Arc& a : arcs) all.push_back({end_point(a.start), end_point(a.end)});
  std::sort(all.begin(), all.end());
  return all;
}

// Arcs have the solid on their right, seen from +x with y to the right and z up. The plate's lower wall is y = 5.25 with the
// solid at larger y, so it runs up; the upper wall y = 6.75 runs down.
TEST(FaceTrace, TwoArcsAcrossAThinWall) {
  Traced t;
  trace({box({1, 5.25, 1}, {31, 6.75, 31})}, Op::set_union, t);
  ASSERT_TRUE(t.arcs);
  EXPECT_EQ(ends(*t.arcs), (std::vector<Ends>{{{{5.25, 4}, {5.25, 8}}}, {{{6.75, 8}, {6.75, 4}}}}));
  EXPECT_EQ(t.statistics.face_link, 1u) << "one solid: F-link decides";
}

// The edge of a box passes through the face: one arc with one corner, which lies on the edge.
TEST(FaceTrace, OneArcAroundAnEdge) {
  Traced t;
  trace({box({1, 1, 1}, {31, 5.25, 6.5})}, Op::set_union, t);
  ASSERT_TRUE(t.arcs);
  ASSERT_EQ(t.arcs->size(), 1u);
  const Arc& arc = t.arcs->front();
  EXPECT_EQ(end_point(arc.start), (std::array<double, 2>{4, 6.5})) << "solid on the right: in from the left side";
  EXPECT_EQ(end_point(arc.end), (std::array<double, 2>{5.25, 4}));
  ASSERT_EQ(arc.bends.size(), 1u);
  EXPECT_NEAR((arc.bends[0] - Vec3(4, 5.25, 6.5)).norm(), 0, 1e-12);
  ASSERT_EQ(arc.surfaces.size(), 2u);
  EXPECT_NE(arc.surfaces[0], arc.surfaces[1]);
}

/// Twice the area that the curve goes round counter-clockwise, seen from +x.
double turned_area(const Arc& curve) {
  double sum = 0;
  for (std::size_t k = 0; k < curve.bends.size(); ++k) {
    const Vec3 &p = curve.bends[k], &q = curve.bends[(k + 1) % curve.bends.size()];
    sum += p.y() * q.z() - p.z() * q.y();
  }
  return sum;
}

void expect_closed(const Traced& t, double area) {
  ASSERT_TRUE(t.arcs);
  ASSERT_EQ(t.arcs->size(), 1u);
  const Arc& curve = t.arcs->front();
  EXPECT_TRUE(curve.closed);
  EXPECT_EQ(curve.bends.size(), 4u);
  EXPECT_EQ(curve.surfaces.size(), 4u);
  EXPECT_NEAR(turned_area(curve), -2 * area, 1e-12) << "solid on the right: clockwise";
}

// A bar inside the face's outline leaves a closed curve.
TEST(FaceTrace, ABarsSectionIsAClosedCurve) {
  Traced t;
  trace({box({1, 5.25, 5.25}, {31, 6.75, 6.75})}, Op::set_union, t);
  expect_closed(t, 1.5 * 1.5);
}

TEST(FaceTrace, NoFacetsNoArcs) {
  Traced t;
  trace({box({12.5, 12.5, 12.5}, {31, 31, 31})}, Op::set_union, t);
  ASSERT_TRUE(t.arcs);
  EXPECT_TRUE(t.arcs->empty());
}

// Two plates cross in the face. Their union has a cross for a section: four arcs, each with a corner.
TEST(FaceTrace, CrossingPlatesJoinedGiveFourCorners) {
  Traced t;
  trace({box({1, 5.25, 1}, {31, 6.75, 31}), box({1, 1, 5.5}, {31, 31, 6.5})}, Op::set_union, t);
  ASSERT_TRUE(t.arcs);
  EXPECT_EQ(t.arcs->size(), 4u);
  for (const Arc& arc : *t.arcs) EXPECT_EQ(arc.bends.size(), 1u);
  EXPECT_EQ(ends(*t.arcs), (std::vector<Ends>{{{{4, 6.5}, {5.25, 8}}},
                                              {{{5.25, 4}, {4, 5.5}}},
                                              {{{6.75, 8}, {8, 6.5}}},
                                              {{{8, 5.5}, {6.75, 4}}}}))
      << "solid on the right everywhere";
}

// Their intersection is a bar: a closed curve, found by F-planes.
TEST(FaceTrace, CrossingPlatesIntersectedAreClosed) {
  Traced t;
  trace({box({1, 5.25, 1}, {31, 6.75, 31}), box({1, 1, 5.5}, {31, 31, 6.5})}, Op::intersection, t);
  expect_closed(t, 1.5 * 1.0);
  EXPECT_EQ(t.statistics.face_planes, 1u);
}

// An edge of a bar lies in the other's wall y = 6: three lines through one point, which no arrangement can order. Below
// z = 6 the tilted bar's section is a wedge that only touches the wall from outside.
TEST(FaceTrace, ThreeLinesThroughAPointAreSectors) {
  Mesh wedge = box({1, 0, 0}, {31, 3, 3});
  for (Vec3& p : wedge.vertices) p = {p.x(), 6 - 0.8 * p.y() - 0.6 * p.z(), 6 + 0.6 * p.y() - 0.8 * p.z()};
  std::reverse(wedge.triangles.begin(), wedge.triangles.end());
  for (Triangle& t : wedge.triangles) std::swap(t[1], t[2]);
  Traced t;
  trace({box({1, 6, 1}, {31, 31, 31}), wedge}, Op::set_union, t);
  ASSERT_TRUE(t.arcs);
  EXPECT_GT(t.statistics.face_cone, 0u);
  ASSERT_EQ(t.arcs->size(), 2u) << "inside joins only across a line: the wall's arc and the wedge's";
  for (const Arc& arc : *t.arcs) EXPECT_TRUE(arc.concurrent && arc.contact);
}

// Two boxes share the wall y = 6: neither side of it is outside, so their union has no arc there.
TEST(FaceTrace, ASharedWallIsNoPartOfTheUnion) {
  Traced t;
  trace({box({1, 1, 1}, {31, 6, 31}), box({1, 6, 1}, {31, 31, 31})}, Op::set_union, t);
  ASSERT_TRUE(t.arcs);
  EXPECT_TRUE(t.arcs->empty());
}

TEST(FaceTrace, ASharedWallIsNoPartOfTheIntersection) {
  Traced t;
  trace({box({1, 1, 1}, {31, 6, 31}), box({1, 6, 1}, {31, 31, 31})}, Op::intersection, t);
  ASSERT_TRUE(t.arcs);
  EXPECT_TRUE(t.arcs->empty());
}

// Bars below left and above right of an edge they share: four sectors around (6, 6), two of them inside. Inside joins only
// across a face (DESIGN §4), so each bar keeps its own arc, and both know of the contact.
TEST(FaceTrace, EdgeContactsKeepTheirSheetsApart) {
  Traced t;
  trace({box({1, 1, 1}, {31, 6, 6}), box({1, 6, 6}, {31, 31, 31})}, Op::set_union, t);
  ASSERT_TRUE(t.arcs);
  EXPECT_EQ(ends(*t.arcs), (std::vector<Ends>{{{{4, 6}, {6, 4}}}, {{{8, 6}, {6, 8}}}}));
  for (const Arc& arc : *t.arcs) {
    EXPECT_TRUE(arc.contact);
    EXPECT_FALSE(arc.bends.empty());
  }
}

}  // namespace
}  // namespace starcell
