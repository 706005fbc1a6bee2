// Welding through an open-addressing hash table of vertex numbers: linear time, 8 to 16 bytes a vertex.
#include "solids/welding.h"

#include <bit>
#include <cstring>
#include <limits>

namespace starcell {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::uint64_t hash_of(const Vec3& p) {
  std::uint64_t h = 0;
  for (int axis = 0; axis < 3; ++axis) {
    h ^= std::bit_cast<std::uint64_t>(p[axis]);
    h *= 0x9e3779b97f4a7c15ull;  // 2^64 / golden ratio: spreads the few differing bits of regular coordinates
    h ^= h >> 32;
  }
  return h * 0xd6e8feb86659fd93ull;
}

// Bits, not ==, so that a NaN (refused later, with its place) is equal to itself here.
bool same_bits(const Vec3& p, const Vec3& q) { return std::memcmp(p.data(), q.data(), 3 * sizeof(double)) == 0; }

// For every vertex the number of the first vertex with the same coordinates.
std::vector<std::uint32_t> first_copies(const std::vector<Vec3>& vertices) {
  const std::size_t slots = std::bit_ceil(2 * vertices.size() + 1);
  const int shift = 64 - std::countr_zero(slots);
  std::vector<std::uint32_t> table(slots, kNone), first(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    std::size_t slot = shift == 64 ? 0 : hash_of(vertices[v]) >> shift;
    while (table[slot] != kNone && !same_bits(vertices[table[slot]], vertices[v])) slot = (slot + 1) & (slots - 1);
    if (table[slot] == kNone) table[slot] = v;
    first[v] = table[slot];
  }
  return first;
}

}  // namespace

std::size_t weld(std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, std::vector<std::int32_t>& labels) {
  for (Vec3& p : vertices) p.array() += 0.0;  // -0.0 + 0.0 is 0.0
  std::vector<std::uint32_t> number = first_copies(vertices);

  std::vector<char> used(vertices.size(), 0);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle corners = {number[triangles[t][0]], number[triangles[t][1]], number[triangles[t][2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::uint32_t v : corners) used[v] = 1;
    if (!labels.empty()) labels[kept] = labels[t];
    triangles[kept++] = corners;
  }
  const std::size_t removed = triangles.size() - kept;
  triangles.resize(kept);
  if (!labels.empty()) labels.resize(kept);

  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (!used[v]) continue;
    vertices[count] = vertices[v];
    number[v] = count++;
  }
  vertices.resize(count);
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = number[v];
  return removed;
}

}  // namespace starcell
