// Seeded random pairs of small polyhedra: what holds for every Boolean of any two solids.
#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

struct Pair {
  Mesh a, b;
};

Pair random_pair(std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.7, 0.7);
  std::uniform_int_distribution<int> kind(0, 3);
  const auto one = [&]() -> Mesh {
    switch (kind(random)) {
      case 0: return pebble(random, 2);
      case 1: return pebble(random, 2, 0.6);
      case 2: return torus(12, 6, 1.0, 0.45);
      default: return box({-1, -0.7, -0.5}, {1, 0.7, 0.5});
    }
  };
  Pair p{one(), {}};
  p.a = turned(p.a, random_rotation(random));
  p.b = turned(one(), random_rotation(random), Vec3(shift(random), shift(random), shift(random)));
  return p;
}

// Closed, manifold and embedded whatever the operation, in double and float32; and the certificate counts what is there.
TEST(RandomPairs, EveryResultIsASolid) {
  std::mt19937 random(101);
  for (int i = 0; i < 30; ++i) {
    const Pair p = random_pair(random);
    const Expression a = solid(p.a), b = solid(p.b), e = i % 3 == 0 ? a | b : i % 3 == 1 ? a & b : a - b;
    const double error = i % 2 ? 0.2 : 0.04;
    const Result r = evaluate(e, with_error(error));
    expect_sound(r, "pair " + std::to_string(i));
    EXPECT_EQ(r.certificate.verdict, Verdict::exact) << i;
    EXPECT_LE(r.certificate.error_bound, error) << i;
    const Topology found = topology(r);
    EXPECT_EQ(r.certificate.components, found.components) << i;
    EXPECT_EQ(std::multiset<int>(r.certificate.genus.begin(), r.certificate.genus.end()), found.genus) << i;
  }
}

double area(const Result& r) {
  double sum = 0;
  for (const auto& [a, b, c] : r.triangles)
    sum += 0.5 * (r.vertices[b] - r.vertices[a]).cross(r.vertices[c] - r.vertices[a]).norm();
  return sum;
}

// V(A) + V(B) = V(A or B) + V(A and B). A surface moved by at most d changes the volume by no more than about d times
// its area; twice that allows for the second order.
TEST(RandomPairs, VolumesOfUnionAndIntersectionAddUp) {
  std::mt19937 random(202);
  for (int i = 0; i < 5; ++i) {
    const Pair p = random_pair(random);
    const Expression a = solid(p.a), b = solid(p.b);
    const Result joined = evaluate(a | b, with_error(0.06)), common = evaluate(a & b, with_error(0.06)),
                 cut = evaluate(a - b, with_error(0.06));
    const auto slack = [](const Result& r) { return 2 * r.certificate.error_bound * area(r) + 1e-9; };
    const double va = volume(p.a.vertices, p.a.triangles), vb = volume(p.b.vertices, p.b.triangles);
    EXPECT_NEAR(volume(joined) + volume(common), va + vb, slack(joined) + slack(common)) << i;
    EXPECT_NEAR(volume(cut) + volume(common), va, slack(cut) + slack(common)) << i;
  }
}

TEST(RandomPairs, UnionCommutes) {
  std::mt19937 random(303);
  for (int i = 0; i < 4; ++i) {
    const Pair p = random_pair(random);
    const Result ab = evaluate(solid(p.a) | solid(p.b), with_error(0.1)),
                 ba = evaluate(solid(p.b) | solid(p.a), with_error(0.1));
    EXPECT_EQ(topology(ab), topology(ba)) << i;
    EXPECT_NEAR(volume(ab), volume(ba), 2 * (ab.certificate.error_bound + ba.certificate.error_bound) * area(ab)) << i;
  }
}

TEST(RandomPairs, RotationLeavesTheTopologyAlone) {
  std::mt19937 random(404);
  for (int i = 0; i < 4; ++i) {
    const Pair p = random_pair(random);
    const Topology unturned = topology(evaluate(solid(p.a) - solid(p.b), with_error(0.2)));
    for (int k = 0; k < 2; ++k) {
      const Eigen::Matrix3d rotation = random_rotation(random);
      const Expression e = solid(turned(p.a, rotation)) - solid(turned(p.b, rotation));
      EXPECT_EQ(topology(evaluate(e, with_error(0.2))), unturned) << i;
    }
  }
}

// Topology does not depend on the error: infinity asks for topology alone, and must give the same one.
TEST(RandomPairs, TopologyIsTheSameForEveryError) {
  std::mt19937 random(505);
  for (int i = 0; i < 6; ++i) {
    const Pair p = random_pair(random);
    const Expression e = solid(p.a) | solid(p.b);
    const Result coarse = evaluate(e, with_error(std::numeric_limits<double>::infinity()));
    expect_sound(coarse);
    EXPECT_EQ(coarse.certificate.verdict, Verdict::exact) << i;
    EXPECT_EQ(topology(coarse), topology(evaluate(e, with_error(0.1)))) << i;
  }
}

// A torus alone, turned anyhow, keeps its hole; two linked ones stay two.
TEST(RandomPairs, ToriKeepTheirHoles) {
  std::mt19937 random(606);
  const Mesh ring = torus(24, 10, 2.0, 0.5);
  Eigen::Matrix3d upright = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Matrix3d rotation = random_rotation(random);
    const Expression a = solid(turned(ring, rotation)), b = solid(turned(turned(ring, upright, Vec3(2, 0, 0)), rotation));
    EXPECT_EQ(topology(evaluate(a, with_error(0.1))), (Topology{1, {1}}));
    EXPECT_EQ(topology(evaluate(a | b, with_error(0.1))), (Topology{2, {1, 1}})) << "linked, and they do not touch";
    EXPECT_TRUE(evaluate(a & b, with_error(0.1)).triangles.empty());
  }
}

}  // namespace
}  // namespace starcell
