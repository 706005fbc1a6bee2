// Making polyhedra: checked from any mesh, unchecked from a proven one, and as the image of another.
#include "solids/polyhedron.h"

#include <stdexcept>
#include <utility>

#include "solids/affine_map.h"
#include "solids/connectivity.h"
#include "solids/validation.h"
#include "solids/welding.h"

namespace starcell {
namespace {

void require_indices_in_range(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  // Half-edges and vertices are numbered with 32 bits, the last number being "none".
  constexpr std::size_t kMost = (kNoTriangle - 1) / 3;
  if (triangles.size() > kMost || vertex_count > kMost)
    throw std::invalid_argument("triangles and vertices must not be more than " + std::to_string(kMost) + " each");
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t v : triangles[t])
      if (v >= vertex_count)
        throw std::invalid_argument("triangles: triangle " + std::to_string(t) + " has vertex index " + std::to_string(v) +
                                    ", but there are only " + std::to_string(vertex_count) + " vertices");
}

Box3 box_of(const std::vector<Vec3>& vertices) {
  Box3 box;
  for (const Vec3& p : vertices) box.extend(p);
  return box;
}

}  // namespace

PolyhedronPtr Polyhedron::make(std::vector<Vec3> vertices, std::vector<Triangle> triangles, Provenance provenance) {
  require_indices_in_range(vertices.size(), triangles);
  if (!provenance.cad_face.empty() && provenance.cad_face.size() != triangles.size())
    throw std::invalid_argument("provenance: cad_face must have one entry a triangle, or none");
  const std::size_t degenerate = weld(vertices, triangles, provenance.cad_face);
  vertices.shrink_to_fit();
  const std::shared_ptr<Polyhedron> made(new Polyhedron);
  made->neighbours_ = validate(vertices, triangles, degenerate);
  made->vertices_ = std::move(vertices);
  made->triangles_ = std::move(triangles);
  made->provenance_ = std::move(provenance);
  made->box_ = box_of(made->vertices_);
  return made;
}

PolyhedronPtr Polyhedron::trusted(std::vector<Vec3> vertices, std::vector<Triangle> triangles, Provenance provenance) {
  const std::shared_ptr<Polyhedron> made(new Polyhedron);
  made->neighbours_ = connect(vertices, triangles).neighbours;
  made->vertices_ = std::move(vertices);
  made->triangles_ = std::move(triangles);
  made->provenance_ = std::move(provenance);
  made->box_ = box_of(made->vertices_);
  return made;
}

PolyhedronPtr Polyhedron::transformed(const Eigen::Matrix4d& map) const {
  require_affine(map);
  const std::shared_ptr<Polyhedron> image(new Polyhedron(*this));
  const Eigen::Matrix3d linear = map.topLeftCorner<3, 3>();
  const Vec3 shift = map.topRightCorner<3, 1>();
  for (Vec3& p : image->vertices_) p = ((linear * p + shift).array() + 0.0).matrix();  // + 0.0: no -0.0
  validate_image(image->vertices_, image->triangles_, image->neighbours_);
  for (auto* boxes : {&image->provenance_.unresolved, &image->provenance_.contacts})
    for (Box3& box : *boxes) box = box.transformed(Eigen::Affine3d(map));
  const double stretch = linear.jacobiSvd().singularValues()[0];  // the most that there is
  image->provenance_.deflection *= stretch;
  image->provenance_.moved *= stretch;
  image->box_ = box_of(image->vertices_);
  return image;
}

}  // namespace starcell
