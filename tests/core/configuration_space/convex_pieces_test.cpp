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

// Leaves make up the polygon; every node is its hull: leaves below it, and pockets that reach at most as far as the hull.
TEST(ConvexPieces, MakeUpThePolygon) {
  std::mt19937 random(4);
  for (int k = 0; k < 200; ++k) {
    const Ring ring = random_star(random, 3 + k % 14);
    const PieceTree tree = piece_tree({ring}, "polygon");
    double sum = 0;
    std::vector<char> is_seam(tree.nodes.size(), 0);
    for (const Seam& s : tree.seams) is_seam[s.both] = 1;
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      const PieceNode& node = tree.nodes[n];
      EXPECT_TRUE(is_convex(ring_of(node.hull)));
      for (const ConvexPiece& pocket : node.pockets) EXPECT_TRUE(is_convex(ring_of(pocket)));
      if (node.pockets.empty() && !is_seam[n]) sum += area(ring_of(node.hull));
    }
    EXPECT_NEAR(sum, area(ring), 1e-9) << k;
    for (const Seam& s : tree.seams)
      EXPECT_GE(area(ring_of(tree.nodes[s.both].hull)), area(ring_of(tree.nodes[s.first].hull)) + area(ring_of(tree.nodes[s.second].hull)) - 1e-9);
  }
}

TEST(ConvexPieces, OfAnLAreTwoAndOneSeam) {
  const PieceTree tree = piece_tree({{{0, 0}, {1, 0}, {1, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}}}, "polygon");
  EXPECT_EQ(tree.nodes.size(), 4u);   // the hull, two pieces, and both of them beside the seam
  EXPECT_EQ(tree.seams.size(), 1u);
  EXPECT_EQ(tree.nodes[0].pockets.size(), 1u);
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
