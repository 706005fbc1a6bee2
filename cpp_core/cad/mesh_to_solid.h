// A closed triangle mesh as a CAD solid: planar regions as single faces, straight edges, shared vertices and edges.
//
// Rests on planar_faces.h for the polygons and on BRep_Builder for the shape: nothing is sewn, so the time grows with the
// number of faces only. Outer shells become solids, cavities inner shells of the solid around them.
// Guarantees: the shape is valid to BRepCheck_Analyzer. Closed shells, shared edges and their places in the faces are so by
// construction, as the mesh is closed and embedded; each polygon is checked, and those that fail are left as single triangles.
// Vertices are the mesh's own, bit by bit; the surface moved by at most the tolerance, not at all where nothing was merged.
#pragma once

#include <TopoDS_Shape.hxx>

#include "solids/polyhedron.h"

namespace starcell::cad {

struct MeshSolid {
  TopoDS_Shape shape;  ///< a solid, or a compound of several
  std::size_t faces = 0;
};

/// `tolerance`: model units, for what counts as flat and straight. Throws InvalidSolidError if no valid solid comes of it.
MeshSolid mesh_to_solid(const Polyhedron& mesh, double tolerance);

}  // namespace starcell::cad
