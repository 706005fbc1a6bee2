// The mesh while it is made: triangles remember the plane they lie on, if they are known to lie on one.
#pragma once

#include <cstdint>
#include <vector>

#include "solids/polyhedron.h"
#include "subdivision/trace.h"

namespace starcell {

struct SurfaceMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> surface;   ///< per triangle: the plane that carries it, or no_surface
};

/// Rounds to float32, as FreeCAD's mesh does. (Through volatile: g++ 12 may drop a plain round trip.)
inline double to_float(double x) {
  volatile float rounded = static_cast<float>(x);
  return static_cast<double>(rounded);
}
inline Vec3 to_float(const Vec3& p) { return {to_float(p.x()), to_float(p.y()), to_float(p.z())}; }

}  // namespace starcell
