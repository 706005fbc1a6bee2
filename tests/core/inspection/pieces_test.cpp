// Which parts of a solid an erosion splits or loses, and which a dilation joins.
#include "inspection/pieces.h"

#include <gtest/gtest.h>

#include "operations/offset.h"
#include "operations/results.h"
#include "solids/box.h"

namespace starcell {
namespace {

using namespace sample;

PolyhedronPtr polyhedron(Result r) { return Polyhedron::trusted(std::move(r.vertices), std::move(r.triangles)); }

PolyhedronPtr mesh_of(const Expression& e) { return polyhedron(evaluate(e, with_error(0.05))); }

PolyhedronPtr offset(const PolyhedronPtr& a, double r) {
  const Prepared p = prepare_offset(Expression(a), r, with_error(0.3));
  return polyhedron(evaluate(p.expression, p.options));
}

// A dumbbell with a plate 0.5 thick, a rod of 0.6 beside it, and a cube within a hollow cube: the sizes say which is which.
Expression four_parts() {
  const Expression dumbbell = Expression(make_box({0, 0, 0}, {4, 4, 4})) | Expression(make_box({3, 0, 1}, {9, 4, 1.5})) | Expression(make_box({8, 0, 0}, {12, 4, 4}));
  const Expression rod = Expression(make_box({0, 10, 0}, {10, 10.6, 0.6}));
  const Expression hollow = Expression(make_box({20, 0, 0}, {30, 10, 10})) - Expression(make_box({21, 1, 1}, {29, 9, 9}));
  return dumbbell | rod | hollow | Expression(make_box({24, 4, 4}, {26, 6, 6}));
}

// Volumes: hollow cube 488, dumbbell 136, cube 8, rod 3.6. Only the dumbbell falls apart, the rod is gone.
TEST(Pieces, OfAnErosion) {
  const PolyhedronPtr whole = mesh_of(four_parts());
  EXPECT_EQ(count_pieces(*whole, *offset(whole, -0.35)), (std::vector<int>{1, 2, 1, 0}));
}

TEST(Pieces, OfWhatIsAsItWas) {
  const PolyhedronPtr whole = mesh_of(four_parts());
  EXPECT_EQ(count_pieces(*whole, *offset(whole, -0.1)), (std::vector<int>{1, 1, 1, 1}));
}

// The cube is 2 from its hollow, the rod 6 from the dumbbell, and the dumbbell 8 from the hollow cube.
TEST(Pieces, ADilationJoins) {
  const PolyhedronPtr whole = mesh_of(four_parts());
  EXPECT_EQ(count_pieces(*offset(whole, 1), *whole), (std::vector<int>{1, 1, 1, 1}));
  EXPECT_EQ(count_pieces(*offset(whole, 4.1), *whole), (std::vector<int>{4}));
  EXPECT_EQ(count_pieces(*offset(whole, 3.5), *whole), (std::vector<int>{2, 2}));
}

TEST(Pieces, NestedPartsAreToldApart) {
  const PolyhedronPtr whole = mesh_of(four_parts());
  const PolyhedronPtr cube = make_box({24.5, 4.5, 4.5}, {25.5, 5.5, 5.5});
  EXPECT_EQ(count_pieces(*whole, *cube), (std::vector<int>{0, 0, 1, 0}));
}

TEST(Pieces, WhatIsOutsideOrInACavityDoesNotCount) {
  const PolyhedronPtr whole = mesh_of(four_parts());
  EXPECT_EQ(count_pieces(*whole, *make_box({40, 0, 0}, {41, 1, 1})), (std::vector<int>{0, 0, 0, 0}));
  EXPECT_EQ(count_pieces(*whole, *make_box({22, 2, 2}, {23, 3, 3})), (std::vector<int>{0, 0, 0, 0}));
}

}  // namespace
}  // namespace starcell
