#include "configuration_space/crossing_links.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "numerics/interval.h"

namespace starcell {
namespace {

bool inside(const Expression& e, const Vec3& x) {
  using Kind = Expression::Kind;
  const auto in = [&](const Expression& operand) { return inside(operand, x); };
  switch (e.kind()) {
    case Kind::region: return e.region()->value(x) < 0;
    case Kind::complement: return !in(e.operands().front());
    case Kind::set_union: return std::any_of(e.operands().begin(), e.operands().end(), in);
    default: return std::all_of(e.operands().begin(), e.operands().end(), in);
  }
}

// How surely the first link and the last one cross, by turns of three points each: > 0 they do.
double crossing(const std::array<double, 3>& l, const Vec3& q) {
  std::array<Eigen::Vector2d, 4> p{Eigen::Vector2d(0, 0)};
  double angle = 0;
  for (int k = 0; k < 3; ++k) {
    angle += q[k];
    p[static_cast<std::size_t>(k) + 1] = p[static_cast<std::size_t>(k)] + l[static_cast<std::size_t>(k)] * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  const auto turn = [&](int i, int j, int k) {
    const Eigen::Vector2d u = p[static_cast<std::size_t>(j)] - p[static_cast<std::size_t>(i)], v = p[static_cast<std::size_t>(k)] - p[static_cast<std::size_t>(i)];
    return u.x() * v.y() - u.y() * v.x();
  };
  return std::min(-turn(0, 1, 2) * turn(0, 1, 3), -turn(2, 3, 0) * turn(2, 3, 1));
}

// Arms of all kinds: each order of lengths, equal ones, ends that pass the base, and every place at which they are flat.
TEST(CrossingLinks, AreWhereTheSegmentsCross) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> whole(-7, 7), small(-0.3, 0.3), length(0.2, 2);
  std::uniform_int_distribution<int> turns(-2, 2);
  std::vector<std::array<double, 3>> arms{{1, 1, 1}, {1, 0.5, 0.5}, {2, 1, 0.5}, {1, 1, 0.5}, {1, 0.5, 1}, {0.5, 1, 1}, {0.5, 1, 0.75}, {1, 1.5, 1}, {0.3, 0.3, 1.7}};
  for (int k = 0; k < 30; ++k) arms.push_back({length(random), length(random), length(random)});
  int crossed = 0;
  for (const auto& l : arms) {
    const Vec3 reach(7, 7, 7);
    const auto set = crossing_links(l, 1, Box3(-reach, reach), 0);
    for (int k = 0; k < 4000; ++k) {
      Vec3 q(whole(random), whole(random), whole(random));
      if (k % 2 == 0) q = {q.x(), turns(random) * M_PI + small(random), turns(random) * M_PI + small(random)};
      const double sure = crossing(l, q);
      if (std::abs(sure) < 1e-9) continue;
      crossed += sure > 0;
      ASSERT_EQ(set && inside(set->set, q), sure > 0) << l[0] << " " << l[1] << " " << l[2] << " at " << q.transpose();
    }
  }
  EXPECT_GT(crossed, 5000);
}

// Made smaller by a move: a point of the whole set has one of the smaller set within the move, and none of that is new.
TEST(CrossingLinks, MoveByNoMoreThanTheySay) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> turned(-7, 7), near(-1, 1);
  const Vec3 reach(7, 7, 7);
  for (const std::array<double, 3>& l : std::vector<std::array<double, 3>>{{1, 1, 1}, {1, 0.8, 0.7}, {0.7, 1, 0.9}, {1, 0.5, 2}}) {
    const double move = 0.01;
    const auto whole = crossing_links(l, 4, Box3(-4 * reach, 4 * reach), 0), less = crossing_links(l, 4, Box3(-4 * reach, 4 * reach), move);
    int lost = 0;
    for (int k = 0; k < 100000; ++k) {
      Vec3 q = 4 * Vec3(0, turned(random), turned(random));
      if (k % 2 == 0) q = Vec3(0, 4 * M_PI + 5 * move * near(random), 4 * M_PI + 5 * move * near(random));
      const bool in = inside(whole->set, q), still = inside(less->set, q);
      ASSERT_FALSE(still && !in);
      if (!in || still) continue;
      ++lost;
      bool reached = false;
      for (int a = 0; a < 180 && !reached; ++a) reached = inside(less->set, q + move * Vec3(0, std::cos(a * M_PI / 90), std::sin(a * M_PI / 90)));
      EXPECT_TRUE(reached) << l[0] << " " << l[1] << " " << l[2] << " at " << q.transpose();
    }
    EXPECT_GT(lost, 20);
  }
}

TEST(CrossingLinks, AreNoneWhereTheMiddleOneIsTooLong) {
  const Vec3 reach(7, 7, 7);
  const auto set = crossing_links({0.4, 2, 0.5}, 1, Box3(-reach, reach), 0);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> whole(-7, 7);
  for (int k = 0; k < 2000; ++k) EXPECT_FALSE(set && inside(set->set, {whole(random), whole(random), whole(random)}));
}

}  // namespace
}  // namespace starcell
