// Edges are found by a counting sort of the half-edges by their smaller vertex, then a sort by the larger one inside
// each bucket: 8 bytes a half-edge, no hashing, and the order, hence "the first", is that of the vertices.
// Half-edge 3t+k runs from corner k to corner k+1 of triangle t.
#include "solids/connectivity.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>

namespace starcell {
namespace {

constexpr int next(int k) { return k == 2 ? 0 : k + 1; }

struct HalfEdges {
  std::vector<std::uint32_t> begin;  // of every vertex's bucket; one more at the end
  std::vector<std::uint64_t> items;  // larger vertex << 32 | half-edge, sorted within a bucket
};

HalfEdges sorted_half_edges(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  HalfEdges edges;
  edges.begin.assign(vertex_count + 1, 0);
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++edges.begin[std::min(t[k], t[next(k)])];
  std::uint32_t sum = 0;
  for (std::uint32_t& b : edges.begin) b = sum += b;  // ends now; filling backwards turns them into begins
  edges.items.resize(sum);
  for (std::size_t t = triangles.size(); t-- > 0;)
    for (int k = 2; k >= 0; --k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][next(k)]);
      edges.items[--edges.begin[low]] = std::uint64_t(high) << 32 | (3 * t + k);
    }
  tbb::parallel_for(std::size_t(0), vertex_count, [&](std::size_t v) {
    std::sort(edges.items.begin() + edges.begin[v], edges.items.begin() + edges.begin[v + 1]);
  });
  return edges;
}

std::uint32_t half_edge(std::uint64_t item) { return static_cast<std::uint32_t>(item); }
std::uint32_t larger_vertex(std::uint64_t item) { return static_cast<std::uint32_t>(item >> 32); }

void note(Defect& defect, std::string where) {
  if (defect.count++ == 0) defect.first = std::move(where);
}

// The triangles around vertex v that can be reached from triangle t through shared edges.
std::size_t fan_size(const std::vector<Triangle>& triangles, const std::vector<Triangle>& neighbours, std::uint32_t v,
                     std::uint32_t start) {
  std::size_t size = 1;
  for (int direction = 0; direction < 2; ++direction) {
    const auto corner = [&](std::uint32_t t) { return triangles[t][0] == v ? 0 : triangles[t][1] == v ? 1 : 2; };
    std::uint32_t t = start;
    int k = corner(t);
    int edge = direction == 0 ? k : next(next(k));  // the edge to leave through: one of the two at v
    for (;;) {
      const std::uint32_t hinge = triangles[t][edge] == v ? triangles[t][next(edge)] : triangles[t][edge];
      t = neighbours[t][edge];
      if (t == start) return size;  // all the way round
      if (t == kNoTriangle) break;
      ++size;
      k = corner(t);
      edge = triangles[t][next(k)] == hinge ? next(next(k)) : k;  // not back through the hinge; orientation may differ
    }
  }
  return size;
}

void find_pinched_vertices(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                           const std::vector<char>& on_bad_edge, Connectivity& result) {
  std::vector<std::uint32_t> valence(vertices.size(), 0), some_triangle(vertices.size(), kNoTriangle);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t v : triangles[t]) {
      ++valence[v];
      some_triangle[v] = static_cast<std::uint32_t>(t);
    }
  std::vector<char> pinched(vertices.size(), 0);
  tbb::parallel_for(std::size_t(0), vertices.size(), [&](std::size_t v) {
    if (valence[v] == 0 || on_bad_edge[v]) return;
    pinched[v] = fan_size(triangles, result.neighbours, static_cast<std::uint32_t>(v), some_triangle[v]) != valence[v];
  });
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (pinched[v]) note(result.non_manifold_vertices, place(vertices[v]));
}

}  // namespace

std::string place(const Vec3& point) {
  std::string text = "(";
  for (int axis = 0; axis < 3; ++axis) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, point[axis], std::chars_format::general, 6).ptr;
    text.append(axis == 0 ? "" : ", ").append(digits, end);
  }
  return text + ")";
}

Connectivity connect(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  Connectivity result;
  result.neighbours.assign(triangles.size(), {kNoTriangle, kNoTriangle, kNoTriangle});
  std::vector<char> on_bad_edge(vertices.size(), 0);
  {
    const HalfEdges edges = sorted_half_edges(vertices.size(), triangles);
    const auto apex = [&](std::uint32_t h) { return triangles[h / 3][(h % 3 + 2) % 3]; };
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      for (std::uint32_t i = edges.begin[v], end; i < edges.begin[v + 1]; i = end) {
        const std::uint32_t w = larger_vertex(edges.items[i]);
        for (end = i + 1; end < edges.begin[v + 1] && larger_vertex(edges.items[end]) == w;) ++end;
        if (end - i == 1) {
          note(result.open_edges, result.open_edges.count ? "" : place(vertices[v]) + "-" + place(vertices[w]));
          continue;
        }
        const std::uint32_t g = half_edge(edges.items[i]), h = half_edge(edges.items[i + 1]);
        if (end - i == 2) {
          result.neighbours[g / 3][g % 3] = h / 3;
          result.neighbours[h / 3][h % 3] = g / 3;
        } else {
          on_bad_edge[v] = on_bad_edge[w] = 1;
          note(result.non_manifold_edges, result.non_manifold_edges.count ? "" : place(vertices[v]) + "-" + place(vertices[w]));
        }
        // A doubled facet is counted once, at the edge between its two smallest vertices.
        for (std::uint32_t a = i + 1; a < end; ++a)
          for (std::uint32_t b = i; b < a; ++b) {
            const std::uint32_t third = apex(half_edge(edges.items[a]));
            if (third < w || third != apex(half_edge(edges.items[b]))) continue;
            note(result.doubled_facets, place(vertices[v]));
            break;
          }
      }
    }
  }
  find_pinched_vertices(vertices, triangles, on_bad_edge, result);
  return result;
}

}  // namespace starcell
