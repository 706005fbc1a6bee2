#include "configuration_space/convex_pieces.h"

#include <gtest/gtest.h>

#include "planar_samples.h"
#include "solids/errors.h"

namespace starcell {
namespace {

using namespace sample;

Ring ring_of(const ConvexPiece& piece) {
  Ring ring;
  for (const PieceCorner& c : piece.corners) ring.push_back({middle(c.x), middle(c.y)});
  return ring;
}

bool is_convex(const Ring& r) {
  for (std::size_t k = 0; k < r.size(); ++k) {
    const Point2 &a = r[k], &b = r[(k + 1) % r.size()], &c = r[(k + 2) % r.size()];
    if ((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) < -1e-12) return false;
  }
  return true;
}

double area_of_leaves(const PieceTree& tree) {
  double sum = 0;
  std::vector<char> is_seam(tree.nodes.size(), 0);
  for (const Seam& s : tree.seams) is_seam[s.both] = 1;
  for (std::size_t n = 0; n < tree.nodes.size(); ++n)
    if (tree.nodes[n].pockets.empty() && !is_seam[n]) sum += area(ring_of(tree.nodes[n].hull));
  return sum;
}

// Leaves make up the polygon; every node is its hull: leaves below it, and pockets that reach at most as far as the hull.
TEST(ConvexPieces, MakeUpThePolygon) {
  std::mt19937 random(4);
  for (int k = 0; k < 200; ++k) {
    const Ring ring = random_star(random, 3 + k % 14);
    const PieceTree tree = piece_tree({ring}, "polygon");
    for (const PieceNode& node : tree.nodes) {
      EXPECT_TRUE(is_convex(ring_of(node.hull)));
      for (const ConvexPiece& pocket : node.pockets) EXPECT_TRUE(is_convex(ring_of(pocket)));
    }
    EXPECT_NEAR(area_of_leaves(tree), area(ring), 1e-9) << k;
    for (const Seam& s : tree.seams)
      EXPECT_GE(area(ring_of(tree.nodes[s.both].hull)), area(ring_of(tree.nodes[s.first].hull)) + area(ring_of(tree.nodes[s.second].hull)) - 1e-9);
  }
}

TEST(ConvexPieces, OfAnLAreTwoAndOneSeam) {
  const PieceTree tree = piece_tree({Ring{{0, 0}, {1, 0}, {1, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}}}, "polygon");
  EXPECT_EQ(tree.nodes.size(), 4u);   // the hull, two pieces, and both of them beside the seam
  EXPECT_EQ(tree.seams.size(), 1u);
  EXPECT_EQ(tree.nodes[0].pockets.size(), 1u);
}

// Leaves lie in what is left of the polygon, and are as large; holes at one height and in one line, and one at a corner's height, too.
TEST(ConvexPieces, LeaveHolesOut) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> turn(0, 6);
  for (int k = 0; k < 60; ++k) {
    std::vector<Ring> holes;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        if ((i + j + k) % 3 != 0) holes.push_back(k % 4 == 0 ? rectangle(0.3 * i - 0.1, 0.3 * j - 0.1, 0.3 * i + 0.1, 0.3 * j + 0.1) : placed(random_star(random, 3 + k % 5, 0.1), 0.3 * i, 0.3 * j, turn(random)));
    for (Ring& hole : holes)
      if (k % 4 != 0)
        for (Point2& p : hole) p[0] *= 0.12, p[1] *= 0.12;
    if (k % 4 != 0)
      for (std::size_t h = 0; h < holes.size(); ++h)
        for (Point2& p : holes[h]) p[0] += 0.4 * static_cast<double>(h % 3), p[1] += 0.4 * static_cast<double>(h / 3);
    const Ring outer = k % 4 == 0 ? rectangle(-0.6, -0.7, 0.6, 0.8) : rectangle(-2, -2, 3, 3);
    const PieceTree tree = piece_tree({PlanarPolygon(outer, holes)}, "polygon");
    double expected = area(outer);
    for (const Ring& hole : holes) expected -= area(hole);
    EXPECT_NEAR(area_of_leaves(tree), expected, 1e-9) << k;
    for (const PieceNode& node : tree.nodes)
      if (node.pockets.empty())
        for (const Ring& hole : holes) {
          Ring shrunk = ring_of(node.hull);   // its corners are rounded
          Point2 m{0, 0};
          for (const Point2& p : shrunk) m[0] += p[0] / static_cast<double>(shrunk.size()), m[1] += p[1] / static_cast<double>(shrunk.size());
          for (Point2& p : shrunk) p = {m[0] + (1 - 1e-9) * (p[0] - m[0]), m[1] + (1 - 1e-9) * (p[1] - m[1])};
          EXPECT_FALSE(overlap(shrunk, hole)) << k;
        }
  }
}

TEST(ConvexPieces, RefuseHolesThatAreNone) {
  const auto refused = [](const std::vector<Ring>& holes, const char* why) {
    try {
      piece_tree({PlanarPolygon(rectangle(0, 0, 4, 4), holes)}, "obstacles");
      ADD_FAILURE() << why;
    } catch (const InvalidSolidError& e) {
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
  };
  refused({rectangle(5, 5, 6, 6)}, "not inside");
  refused({rectangle(3, 3, 5, 5)}, "not inside");
  refused({rectangle(0, 1, 1, 2)}, "not inside");
  refused({rectangle(1, 1, 2, 2), rectangle(2, 1, 3, 2)}, "touches another");
  refused({rectangle(1, 1, 3, 3), rectangle(1.5, 1.5, 2, 2)}, "in another one");
  refused({{{1, 1}, {2, 2}, {2, 1}, {1, 2}}}, "crosses");
}

TEST(ConvexPieces, RefuseWhatIsNoPolygon) {
  const auto refused = [](const Ring& ring, const char* why) {
    try {
      piece_tree({rectangle(0, 0, 1, 1), ring}, "obstacles");
      ADD_FAILURE() << why;
    } catch (const InvalidSolidError& e) {
      EXPECT_NE(std::string(e.what()).find("obstacles: polygon 1"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
  };
  refused({{0, 0}, {1, 0}}, "fewer than three");
  refused({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, "crosses");
  refused({{0, 0}, {1, 0}, {NAN, 1}}, "not finite");
  refused({{0, 0}, {1, 0}, {2, 0}}, "");
}

}  // namespace
}  // namespace starcell
