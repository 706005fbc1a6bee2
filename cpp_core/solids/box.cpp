// An axis-parallel box: eight corners, twelve triangles, every diagonal on an outer side.
// Corner i has bit 0 for x, bit 1 for y and bit 2 for z; exact, because the given numbers are the coordinates.
// Valid by construction when lower < upper, so nothing has to be validated.
#include "solids/box.h"

#include <stdexcept>

namespace starcell {

PolyhedronPtr make_box(const Vec3& lower, const Vec3& upper) {
  if (!lower.allFinite() || !upper.allFinite()) throw std::invalid_argument("lower and upper must be finite");
  if (!(lower.array() < upper.array()).all()) throw std::invalid_argument("lower must be less than upper in every coordinate");
  std::vector<Vec3> corners(8);
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) corners[i][axis] = ((i >> axis & 1) ? upper[axis] : lower[axis]) + 0.0;  // no -0.0
  return Polyhedron::trusted(std::move(corners), {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}});
}

}  // namespace starcell
