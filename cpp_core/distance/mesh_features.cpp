#include "distance/mesh_features.h"

#include <algorithm>
#include <cmath>

#include <boost/multiprecision/cpp_int.hpp>

#include "numerics/predicates.h"

namespace starcell {
namespace {

constexpr double rounding = 2.3e-16;
// Normals that differ by less are one: what a cap leaves out then is far below any bound that matters.
constexpr double flat_angle = 4e-12;

void widen(Cap& cap, const MeshFeatures::Face& face) { cap.radius = std::max(cap.radius, (face.normal - cap.axis).norm() + face.loss + 1e-12); }

// A needle's cross product loses all its digits in double; from there on it is computed exactly.
constexpr double needle_loss = 1e-12;

// (b - a) x (c - a), each component to rounding; scaled alike so that none is too small for a double.
Vec3 exact_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  using Exact = boost::multiprecision::cpp_rational;
  std::array<Exact, 3> p, q, n;
  for (int k = 0; k < 3; ++k) p[k] = Exact(b[k]) - Exact(a[k]), q[k] = Exact(c[k]) - Exact(a[k]);
  Exact largest = 0;
  for (int k = 0; k < 3; ++k) {
    n[k] = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
    if (abs(n[k]) > largest) largest = abs(n[k]);
  }
  Vec3 result = Vec3::Zero();
  if (largest == 0) return result;
  for (int k = 0; k < 3; ++k) result[k] = Exact(n[k] / largest).convert_to<double>();
  return result;
}

}  // namespace

MeshFeatures::MeshFeatures(PolyhedronPtr solid) : solid_(std::move(solid)) {
  const Box3& box = solid_->bounding_box();
  scale_ = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  make_faces();
  make_edges();
  make_vertices();
  make_planes();
}

void MeshFeatures::make_faces() {
  faces.resize(solid_->triangles().size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    Face& face = faces[f];
    for (std::size_t k = 0; k < 3; ++k) face.corners[k] = solid_->vertices()[solid_->triangles()[f][k]];
    face.middle = (face.corners[0] + face.corners[1] + face.corners[2]) / 3;
    face.radius = 0;
    for (const Vec3& p : face.corners) face.radius = std::max(face.radius, (p - face.middle).norm() * (1 + 8 * rounding));
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = corner(f, (k + 1) % 3) - corner(f, k);
      face.length[k] = edge.norm();
      face.along[k] = edge / face.length[k];
    }
    const Vec3 n = (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0));
    const double area = n.norm();
    face.normal = area > 0 ? Vec3(n / area) : Vec3::UnitX();
    // The product's terms are no larger than the two edges', and lose as much.
    face.loss = area > 0 ? 32 * rounding * face.length[0] * face.length[2] / area : 2;
    if (face.loss > needle_loss)
      if (const Vec3 exact = exact_normal(face.corners[0], face.corners[1], face.corners[2]); exact.norm() > 0)
        face.normal = exact.normalized(), face.loss = 8 * rounding;
    for (int k = 0; k < 3; ++k) face.inward[k] = face.normal.cross(face.along[k]).normalized();
  }
}

void MeshFeatures::make_edges() {
  const auto& triangles = solid_->triangles();
  const auto& points = solid_->vertices();
  edge_of.resize(triangles.size());
  for (std::uint32_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t g = solid_->neighbours()[f][k];
      const std::uint32_t a = triangles[f][k], b = triangles[f][(k + 1) % 3];
      if (g < f) {   // made from the other side, where it runs from b to a
        std::size_t l = 0;
        while (triangles[g][l] != b || triangles[g][(l + 1) % 3] != a) ++l;
        edge_of[f][k] = edge_of[g][l];
        continue;
      }
      Edge e{a, b, {f, g}, faces[f].along[k], Bend::flat, faces[f].normal.dot(faces[g].normal), {}};
      std::size_t apex = 0;
      while (triangles[g][apex] == a || triangles[g][apex] == b) ++apex;
      const Vec3& other = points[triangles[g][apex]];
      const double apart = (faces[f].normal - faces[g].normal).norm();
      if (apart > flat_angle) {
        const int above = side(corner(f, 0), corner(f, 1), corner(f, 2), other);
        e.bend = above == 0 ? Bend::flat : above > 0 ? Bend::concave : Bend::convex;
      }
      const Vec3 sum = faces[f].normal + faces[g].normal;
      if (sum.norm() > 1e-9) {
        e.cap = {sum.normalized(), 0};
        widen(e.cap, faces[f]);
        widen(e.cap, faces[g]);
      } else {
        e.cap.axis = Vec3::Zero();   // a knife's edge: no cap, and no side to tell by it
      }
      edge_of[f][k] = static_cast<std::uint32_t>(edges.size());
      edges.push_back(e);
    }
}

void MeshFeatures::make_planes() {
  plane_of.assign(faces.size(), UINT32_MAX);
  std::vector<std::uint32_t> front;
  for (std::uint32_t seed = 0; seed < faces.size(); ++seed) {
    if (plane_of[seed] != UINT32_MAX) continue;
    const auto plane = static_cast<std::uint32_t>(first_on_plane.size());
    first_on_plane.push_back(seed);
    plane_of[seed] = plane;
    front.assign(1, seed);
    while (!front.empty()) {
      const std::uint32_t f = front.back();
      front.pop_back();
      for (const std::uint32_t id : edge_of[f]) {
        const Edge& e = edges[id];
        const std::uint32_t g = e.faces[0] == f ? e.faces[1] : e.faces[0];
        if (e.bend == Bend::flat && plane_of[g] == UINT32_MAX) plane_of[g] = plane, front.push_back(g);
      }
    }
  }
}

void MeshFeatures::make_vertices() {
  const auto& triangles = solid_->triangles();
  vertices.resize(solid_->vertices().size());
  first_about.assign(vertices.size() + 1, 0);
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) ++first_about[v + 1];
  for (std::size_t v = 0; v < vertices.size(); ++v) first_about[v + 1] += first_about[v];
  faces_about.resize(3 * triangles.size());
  std::vector<std::uint32_t> next(first_about.begin(), first_about.end() - 1);
  for (std::uint32_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = triangles[f][k];
      faces_about[next[v]++] = f;
      const double angle = std::acos(std::clamp(-faces[f].along[k].dot(faces[f].along[(k + 2) % 3]), -1.0, 1.0));
      vertices[v].pseudo_normal += angle * faces[f].normal;
    }
  for (const Edge& e : edges)
    for (const std::uint32_t v : {e.a, e.b})
      if (e.bend != Bend::flat) vertices[v].bend = vertices[v].bend == Bend::flat || vertices[v].bend == e.bend ? e.bend : Bend::saddle;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    Vertex& vertex = vertices[v];
    if (vertex.bend == Bend::flat || !(vertex.pseudo_normal.norm() > 1e-9)) continue;
    vertex.cap = {vertex.pseudo_normal.normalized(), 0};
    for (std::uint32_t i = first_about[v]; i < first_about[v + 1]; ++i) widen(vertex.cap, faces[faces_about[i]]);
  }
}

}  // namespace starcell
