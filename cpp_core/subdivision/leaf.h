// An accepted cell: everything that contouring needs, and what was proved of E in it.
#pragma once

#include <array>
#include <limits>
#include <memory>

#include "subdivision/cell_problem.h"
#include "subdivision/trace.h"

namespace starcell {

/// Names a corner of a sheet's polygon by the three planes through it, ascending: surfaces, or sides of the cell.
using CornerName = std::array<std::uint32_t, 3>;

/// The label of a cell's side, as face_of() numbers them; above all surfaces.
constexpr std::uint32_t side_label(int side) { return UINT32_MAX - 7 + static_cast<std::uint32_t>(side); }

/// What a sheet has of one plane: a flat region, its rim's cycles counter-clockwise about E's outward normal.
struct FlatPart {
  struct Corner {
    CornerName name;
    std::uint32_t edge;   ///< label of the plane or side along which the rim goes on
    Vec3 place;
  };
  std::uint32_t surface = 0;
  std::vector<std::vector<Corner>> cycles;
};

/// E's logic on the surfaces of a graph: their senses (+1: E's outward normal is the function's gradient), and membership
/// (bit a of `value`) for the sides a that a point is on (bit i: negative side of surface i).
struct GraphLogic {
  std::vector<std::shared_ptr<const Surface>> surfaces;   ///< as the cell has them
  std::vector<int> senses;
  std::uint64_t value = 0;
};

/// One component of E in the cell, and why what replaces it is near it. A disk, but for flats.
struct Sheet {
  enum class Shape {
    planar,   ///< on one plane: any fan on the plane is E
    crease,   ///< on two planes: a fan from a point of their common line is E
    corner,   ///< on planes through one point `apex` of the cell: the fan from it is E
    flats,    ///< exactly these flat parts
    slab,     ///< a graph over the plane across `direction`, between heights low and high
    graph,    ///< seen along `direction` on its `surfaces`, with room of `high` around it; `apex` serves with a deviation of `low`
    loose,    ///< no more is known than that it lies in the cell
  };
  Shape shape = Shape::loose;
  std::vector<std::uint32_t> surfaces;   ///< planar, crease, corner: the planes, ascending; graph: its surfaces
  Vec3 apex = Vec3::Zero();
  Vec3 direction = Vec3::Zero();
  double low = 0, high = 0;
  double near = std::numeric_limits<double>::infinity();   ///< graph: E's part and the fan from `apex` over `polygon` are within this
  std::vector<Vec3> polygon;             ///< of each other
  std::vector<Crossing> crossings;       ///< crossings (line and surface) that belong to it; empty for a cell's only sheet
  std::vector<FlatPart> flats;           ///< shape flats only
  bool disk = true;                      ///< false: flats alone can stand for it, and several of the cell's loops may bound it
  bool level = false;                    ///< crease: all its facets face one side of surfaces[0], so it is a graph over it
  std::shared_ptr<const GraphLogic> graph;  ///< shape graph only
  bool contact = false;
};

struct Leaf {
  CellProblem problem;
  std::array<std::vector<Arc>, 6> arcs;   ///< per side, as face_of() numbers them
  std::vector<Sheet> sheets;
  bool resolved = true;
  bool contact = false;
  std::uint32_t number = UINT32_MAX;      ///< contouring's name for it, once it has one
};

}  // namespace starcell
