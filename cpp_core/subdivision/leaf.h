// An accepted cell: everything that contouring needs, and what was proved of E in it.
#pragma once

#include <array>
#include <memory>

#include "subdivision/cell_problem.h"
#include "subdivision/trace.h"

namespace starcell {

/// One disk of E in the cell, and why a fan over its loop is near it.
struct Sheet {
  enum class Shape {
    planar,   ///< on one plane: any fan on the plane is E
    crease,   ///< on two planes: a fan from a point of their common line is E
    corner,   ///< on planes through one point `apex` of the cell: the fan from it is E
    slab,     ///< a graph over the plane across `direction`, between heights low and high
    loose,    ///< no more is known than that it lies in the cell
  };
  Shape shape = Shape::loose;
  std::vector<std::uint32_t> surfaces;   ///< planar, crease, corner: the planes, ascending
  Vec3 apex = Vec3::Zero();
  Vec3 direction = Vec3::Zero();
  double low = 0, high = 0;
  std::vector<Crossing> crossings;       ///< crossings (line and surface) that belong to this sheet
  bool contact = false;
};

struct Leaf {
  CellProblem problem;
  std::array<std::vector<Arc>, 6> arcs;   ///< per side, as face_of() numbers them
  std::vector<Sheet> sheets;
  bool resolved = true;
  bool contact = false;
};

}  // namespace starcell
