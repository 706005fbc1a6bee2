// The exact boundary of what triangles wind about, against counted cubes: random boxes on whole numbers meet in every degenerate way.
#include "repair/exact_arrangement.h"

#include <queue>
#include <random>
#include <set>

#include "operations/results.h"
#include "repair/flat_points.h"
#include "repair/pulled_apart.h"

namespace starcell {
namespace {

using namespace sample;
using Cube = std::array<int, 3>;

const auto never = [] {};

// Six times the volume, exactly.
ExactKernel::FT six_volumes(const ExactSurface& s) {
  ExactKernel::FT sum = 0;
  for (const Triangle& t : s.triangles) sum += CGAL::determinant(s.points[t[0]] - CGAL::ORIGIN, s.points[t[1]] - CGAL::ORIGIN, s.points[t[2]] - CGAL::ORIGIN);
  return sum;
}

void expect_balanced(const ExactSurface& s) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> excess;
  for (const Triangle& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) excess[std::minmax(t[k], t[(k + 1) % 3])] += t[k] < t[(k + 1) % 3] ? 1 : -1;
  EXPECT_TRUE(std::all_of(excess.begin(), excess.end(), [](const auto& edge) { return edge.second == 0; }));
}

struct Heap {
  Mesh boxes;
  std::set<Cube> cubes;
};

Heap random_heap(std::mt19937& random, int count) {
  std::uniform_int_distribution<int> at(0, 4), size(1, 3);
  Heap heap;
  Mesh all;
  for (int b = 0; b < count; ++b) {
    const Cube low{at(random), at(random), at(random)}, high{low[0] + size(random), low[1] + size(random), low[2] + size(random)};
    all = joined({all, box(Vec3(low[0], low[1], low[2]), Vec3(high[0], high[1], high[2]))});
    for (int x = low[0]; x < high[0]; ++x)
      for (int y = low[1]; y < high[1]; ++y)
        for (int z = low[2]; z < high[2]; ++z) heap.cubes.insert({x, y, z});
  }
  // Boxes on whole numbers share vertices: the chain has them once.
  std::map<std::array<double, 3>, std::uint32_t> number;
  for (const Triangle& t : all.triangles) {
    Triangle corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = all.vertices[t[k]];
      const auto [it, fresh] = number.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(heap.boxes.vertices.size()));
      if (fresh) heap.boxes.vertices.push_back(p);
      corners[k] = it->second;
    }
    heap.boxes.triangles.push_back(corners);
  }
  return heap;
}

// Pieces of cubes that are joined across faces, and pieces of the rest that are joined across faces, edges or corners: the first have an outer
// surface each, the bounded ones of the second a cavity each.
int surfaces_of(const std::set<Cube>& cubes) {
  std::set<Cube> left = cubes, rest;
  for (int x = -1; x < 9; ++x)
    for (int y = -1; y < 9; ++y)
      for (int z = -1; z < 9; ++z)
        if (!cubes.count({x, y, z})) rest.insert({x, y, z});
  const auto pieces = [](std::set<Cube> some, int reach) {
    int count = 0;
    while (!some.empty()) {
      ++count;
      std::queue<Cube> next;
      next.push(*some.begin());
      some.erase(some.begin());
      while (!next.empty()) {
        const Cube c = next.front();
        next.pop();
        for (int x = -1; x <= 1; ++x)
          for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
              if (std::abs(x) + std::abs(y) + std::abs(z) <= reach && some.erase({c[0] + x, c[1] + y, c[2] + z})) next.push({c[0] + x, c[1] + y, c[2] + z});
      }
    }
    return count;
  };
  return pieces(left, 1) + pieces(rest, 3) - 1;
}

TEST(ExactArrangement, OfBoxesOnWholeNumbersIsWhatTheirCubesAre) {
  std::mt19937 random(5);
  for (int k = 0; k < 30; ++k) {
    const Heap heap = random_heap(random, 1 + k % 6);
    ExactSurface surface = boundary_of_winding(heap.boxes.vertices, heap.boxes.triangles, never);
    expect_balanced(surface);
    EXPECT_EQ(six_volumes(surface), static_cast<int>(6 * heap.cubes.size())) << k;
    const std::size_t before = surface.triangles.size();
    take_out_flat_points(surface, static_cast<std::uint32_t>(heap.boxes.vertices.size()), never);
    expect_balanced(surface);
    EXPECT_LE(surface.triangles.size(), before);
    EXPECT_EQ(six_volumes(surface), static_cast<int>(6 * heap.cubes.size())) << k;
  }
}

TEST(ExactArrangement, PulledApartJoinsInsidesAcrossFacesOnly) {
  std::mt19937 random(6);
  int touching = 0;
  for (int k = 0; k < 30; ++k) {
    const Heap heap = random_heap(random, 2 + k % 5);
    ExactSurface surface = boundary_of_winding(heap.boxes.vertices, heap.boxes.triangles, never);
    take_out_flat_points(surface, static_cast<std::uint32_t>(heap.boxes.vertices.size()), never);
    const PolyhedronPtr solid = pulled_apart(surface, 1e-3, never);
    ASSERT_TRUE(solid) << k;
    touching += !solid->provenance().contacts.empty();
    EXPECT_EQ(solid->provenance().moved > 0, !solid->provenance().contacts.empty());
    Result r;
    r.vertices = solid->vertices();
    r.triangles = solid->triangles();
    EXPECT_EQ(topology(r).components, surfaces_of(heap.cubes)) << k;
    EXPECT_NEAR(volume(r), static_cast<double>(heap.cubes.size()), 1e-3 * area(r)) << k;
  }
  EXPECT_GT(touching, 3);   // or nothing was tried
}

// A mesh wound twice about the same, and one wound about backward: once, and nothing.
TEST(ExactArrangement, CountsHowOftenAndWhichWay) {
  const Mesh unit = box({0, 0, 0}, {1, 1, 1});
  Mesh twice = unit;
  twice.triangles.insert(twice.triangles.end(), unit.triangles.begin(), unit.triangles.end());
  EXPECT_EQ(six_volumes(boundary_of_winding(twice.vertices, twice.triangles, never)), 6);
  const Mesh back = flipped(unit);
  EXPECT_TRUE(boundary_of_winding(back.vertices, back.triangles, never).triangles.empty());
  Mesh both = unit;
  both.triangles.insert(both.triangles.end(), back.triangles.begin(), back.triangles.end());
  EXPECT_TRUE(boundary_of_winding(both.vertices, both.triangles, never).triangles.empty());
}

TEST(ExactArrangement, CanBeCalledOff) {
  std::mt19937 random(7);
  const Heap heap = random_heap(random, 6);
  struct Enough {};
  int asked = 0;
  EXPECT_THROW(boundary_of_winding(heap.boxes.vertices, heap.boxes.triangles, [&] { if (++asked > 2) throw Enough(); }), Enough);
}

}  // namespace
}  // namespace starcell
