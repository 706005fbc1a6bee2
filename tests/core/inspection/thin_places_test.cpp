// Thin places: spokes, clusters and their boxes, on solids whose walls are known.
#include "inspection/thin_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "operations/results.h"
#include "solids/box.h"
#include "solids/errors.h"

namespace starcell {
namespace {

using namespace sample;

PolyhedronPtr mesh_of(const Expression& e) {
  Result r = evaluate(e, with_error(0.05));
  Provenance provenance;
  provenance.deflection = r.certificate.error_bound;
  return Polyhedron::trusted(std::move(r.vertices), std::move(r.triangles), std::move(provenance));
}

// Two blocks of 4 x 4 x 4, joined by a plate 0.5 thick.
Expression dumbbell() {
  return Expression(make_box({0, 0, 0}, {4, 4, 4})) | Expression(make_box({3, 0, 1}, {9, 4, 1.5})) | Expression(make_box({8, 0, 0}, {12, 4, 4}));
}

TEST(ThinPlaces, APlateBetweenTwoBlocks) {
  const ThinPlaces found = find_thin_places(*mesh_of(dumbbell()), 1, ThinSide::wall);
  ASSERT_EQ(found.places.size(), 1u);
  EXPECT_NEAR(found.places[0].thickness, 0.5, 1e-6);
  // The plate shows between the blocks: x from 4 to 8, to within a spacing.
  const Box3& box = found.places[0].box;
  EXPECT_NEAR(box.min()[0], 4, found.spacing);
  EXPECT_NEAR(box.max()[0], 8, found.spacing);
  EXPECT_NEAR(box.min()[1], 0, found.spacing);
  EXPECT_NEAR(box.max()[1], 4, found.spacing);
  EXPECT_NEAR(box.min()[2], 1, 1e-6);
  EXPECT_NEAR(box.max()[2], 1.5, 1e-6);
  for (const Spoke& s : found.places[0].spokes) EXPECT_NEAR(s.length(), 0.5, 1e-6);
}

TEST(ThinPlaces, NoneAtItsOwnThickness) {
  EXPECT_TRUE(find_thin_places(*mesh_of(dumbbell()), 0.49, ThinSide::wall).places.empty());
  EXPECT_FALSE(find_thin_places(*mesh_of(dumbbell()), 0.51, ThinSide::wall).places.empty());
}

// A block's edges and corners are as thin as can be, and no walls.
TEST(ThinPlaces, EdgesAreNone) {
  EXPECT_TRUE(find_thin_places(*make_box({0, 0, 0}, {10, 10, 10}), 9.9, ThinSide::wall).places.empty());
}

TEST(ThinPlaces, TwoWallsAreTwoPlaces_TheThinnerFirst) {
  const Expression both = Expression(make_box({0, 0, 0}, {10, 10, 10})) | Expression(make_box({-4, 4, 4}, {1, 6, 4.6})) | Expression(make_box({9, 4, 4}, {14, 6, 4.3}));
  const ThinPlaces found = find_thin_places(*mesh_of(both), 1, ThinSide::wall);
  ASSERT_EQ(found.places.size(), 2u);
  EXPECT_NEAR(found.places[0].thickness, 0.3, 1e-6);
  EXPECT_NEAR(found.places[1].thickness, 0.6, 1e-6);
  EXPECT_GT(found.places[0].box.min()[0], 9);
  EXPECT_LT(found.places[1].box.max()[0], 1);
}

TEST(ThinPlaces, ASlotIsAGap) {
  const Expression slotted = Expression(make_box({0, 0, 0}, {10, 10, 10})) - Expression(make_box({4, -1, 3}, {4.8, 11, 11}));
  const PolyhedronPtr mesh = mesh_of(slotted);
  const ThinPlaces gaps = find_thin_places(*mesh, 1, ThinSide::gap);
  ASSERT_EQ(gaps.places.size(), 1u);
  EXPECT_NEAR(gaps.places[0].thickness, 0.8, 1e-6);
  EXPECT_NEAR(gaps.places[0].box.min()[2], 3, gaps.spacing);
  EXPECT_NEAR(gaps.places[0].box.max()[2], 10, gaps.spacing);
  EXPECT_TRUE(find_thin_places(*mesh, 1, ThinSide::wall).places.empty());
  EXPECT_TRUE(find_thin_places(*mesh, 0.79, ThinSide::gap).places.empty());
}

// A tube's wall from its outside along the normal: the difference of the radii, less what facets flatten.
TEST(ThinPlaces, ARoundWall) {
  const Expression tube = Expression(CurvedSolid::cylinder({0, 0, 0}, {0, 0, 1}, 5, 8)) - Expression(CurvedSolid::cylinder({0, 0, -1}, {0, 0, 1}, 4.4, 10));
  const ThinPlaces found = find_thin_places(*mesh_of(tube), 1, ThinSide::wall);
  ASSERT_EQ(found.places.size(), 1u);
  EXPECT_NEAR(found.places[0].thickness, 0.6, 0.1);   // both sides are within 0.05
  EXPECT_NEAR(found.places[0].box.sizes()[2], 8, 0.6);
}

TEST(ThinPlaces, AnyPositionFindsTheSame) {
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.topLeftCorner<3, 3>() = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  map.topRightCorner<3, 1>() = Vec3(100, -50, 20);
  const PolyhedronPtr mesh = mesh_of(dumbbell());
  const ThinPlaces here = find_thin_places(*mesh, 1, ThinSide::wall), there = find_thin_places(*mesh->transformed(map), 1, ThinSide::wall);
  ASSERT_EQ(there.places.size(), 1u);
  EXPECT_NEAR(there.places[0].thickness, here.places[0].thickness, 1e-9);
  EXPECT_EQ(there.places[0].spokes.size(), here.places[0].spokes.size());
}

TEST(ThinPlaces, RefusesWhatIsNoThickness) {
  for (const double thickness : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(find_thin_places(*make_box({0, 0, 0}, {1, 1, 1}), thickness, ThinSide::wall), std::invalid_argument);
}

TEST(ThinPlaces, EndsWhenAsked) {
  EXPECT_THROW(find_thin_places(*make_box({0, 0, 0}, {1, 1, 1}), 0.1, ThinSide::wall, [] { return false; }), CancelledError);
}

}  // namespace
}  // namespace starcell
