#include "contouring/relaxed_cells.h"

#include <gtest/gtest.h>

#include <random>

namespace starcell {
namespace {

constexpr std::uint32_t root = 1u << 10;

Cell random_cell(std::mt19937& random) {
  std::uniform_int_distribution<int> level(3, 8);
  const int l = level(random);
  const std::uint32_t size = root >> l;
  std::uniform_int_distribution<std::uint32_t> place(0, (1u << l) - 1);
  return {{place(random) * size, place(random) * size, place(random) * size}, size, l};
}

bool meet(const GridPoint& low, const GridPoint& high, const Cell& c) {
  const GridPoint upper = c.upper();
  for (int k = 0; k < 3; ++k)
    if (low[k] > upper[k] || c.lower[k] > high[k]) return false;
  return true;
}

// Against all cells one by one: cells, faces and edges that share no more than a corner count as well.
TEST(RelaxedCells, TouchIsThatOfClosedBoxes) {
  std::mt19937 random(4);
  RelaxedCells relaxed(root);
  std::vector<Cell> all;
  int touched = 0;
  for (int i = 0; i < 40; ++i) {
    all.push_back(random_cell(random));
    relaxed.add(all.back());
    for (int q = 0; q < 50; ++q) {
      const Cell cell = random_cell(random);
      const Face face = face_of(cell, q % 6);
      Crossing x;
      x.axis = static_cast<std::uint8_t>(q % 3);
      x.low = cell.lower[q % 3], x.high = x.low + cell.size;
      x.i = cell.lower[(q + 1) % 3], x.j = cell.lower[(q + 2) % 3];
      GridPoint low = cell.lower, high = cell.lower;
      high[q % 3] += cell.size;
      const auto any = [&](const GridPoint& a, const GridPoint& b) {
        return std::any_of(all.begin(), all.end(), [&](const Cell& c) { return meet(a, b, c); });
      };
      EXPECT_EQ(relaxed.touch(cell), any(cell.lower, cell.upper()));
      EXPECT_EQ(relaxed.touch(face), any(face.corner(0, 0), face.corner(1, 1)));
      EXPECT_EQ(relaxed.touch(x), any(low, high));
      touched += relaxed.touch(cell);
    }
  }
  EXPECT_GT(touched, 100);
  for (const Cell& c : all) EXPECT_TRUE(relaxed.has(c));
  EXPECT_FALSE(relaxed.has({{0, 0, 0}, root, 0}));
}

TEST(RelaxedCells, NothingTouchesNone) {
  std::mt19937 random(5);
  const RelaxedCells none(root);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(none.touch(random_cell(random)));
}

}  // namespace
}  // namespace starcell
