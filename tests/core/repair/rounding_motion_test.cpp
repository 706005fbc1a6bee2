#include "repair/rounding_motion.h"

#include <gtest/gtest.h>

namespace starcell {
namespace {

using FT = ExactKernel::FT;

const std::function<void()> never = [] {};

// Corners at thirds, which doubles do not have; its tip at the given height.
void add_tetrahedron(ExactSurface& surface, const FT& foot, const FT& tip) {
  const auto at = static_cast<std::uint32_t>(surface.points.size());
  const FT third = FT(1) / FT(3);
  surface.points.insert(surface.points.end(), {{0, 0, foot}, {third, 0, foot}, {0, third, foot}, {third / 7, third / 7, tip}});
  const bool up = tip > foot;
  for (Triangle t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}}) {
    if (!up) std::swap(t[1], t[2]);
    surface.triangles.push_back({at + t[0], at + t[1], at + t[2]});
  }
}

std::vector<Vec3> rounded(const ExactSurface& surface) {
  std::vector<Vec3> places;
  for (const ExactPoint& p : surface.points) places.emplace_back(CGAL::to_double(p.x().exact()), CGAL::to_double(p.y().exact()), CGAL::to_double(p.z().exact()));
  return places;
}

TEST(RoundingMotion, OfWhatHasRoomIsProved) {
  ExactSurface surface;
  add_tetrahedron(surface, 0, FT(1) / FT(3));
  add_tetrahedron(surface, FT(-1) / FT(7), FT(-1) / FT(3));
  EXPECT_TRUE(not_proved_to_keep(surface, rounded(surface), never).empty());
}

// So flat that floating point has no say: the exact polynomials do.
TEST(RoundingMotion, OfWhatIsThinIsProvedExactly) {
  ExactSurface surface;
  add_tetrahedron(surface, 0, FT(1e-30));
  EXPECT_TRUE(not_proved_to_keep(surface, rounded(surface), never).empty());
}

// Two feet a 10^-30th apart that doubles bring together, and a tip that they take through its foot.
TEST(RoundingMotion, WhatItJoinsOrTurnsOverIsNotProved) {
  const FT tiny(1e-30);
  ExactSurface apart;
  add_tetrahedron(apart, FT(1) + tiny, 2);
  add_tetrahedron(apart, 1, 0);
  EXPECT_FALSE(not_proved_to_keep(apart, rounded(apart), never).empty());
  ExactSurface turned;
  add_tetrahedron(turned, FT(1) / FT(3), FT(1) / FT(3) + tiny);
  EXPECT_FALSE(not_proved_to_keep(turned, rounded(turned), never).empty());
}

}  // namespace
}  // namespace starcell
