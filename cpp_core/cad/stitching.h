// One watertight mesh from the triangulations of a solid's faces.
//
// Computes: which nodes of different faces are one vertex, from topology alone: the i-th node on an edge is the same in
// every face at that edge, an edge's ends are its TopoDS_Vertex, all nodes of a degenerated edge (a pole) are its one
// vertex. Positions are never compared, so no two sheets of a thin wall are ever welded.
// Guarantees: every vertex of the result stands for one topological place; an edge whose discretisations differ
// between faces is an InvalidSolidError. Triangles that collapse at poles and tiny edges are dropped.
// Does not guarantee: closed, manifold, embedded; Polyhedron::make decides that.
#pragma once

#include <TopoDS_Edge.hxx>
#include <cstdint>
#include <vector>

#include "cad/face_meshes.h"
#include "solids/polyhedron.h"

namespace starcell::cad {

/// An edge's nodes in the order of its curve.
struct EdgeNodes {
  TopoDS_Edge edge;  ///< forward
  std::vector<double> parameters;
  std::vector<std::uint32_t> vertices;
};

struct StitchedMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> cad_face;                     ///< per triangle: FaceMesh::number
  std::vector<std::vector<std::uint32_t>> node_vertices;  ///< per face and node (from 0): its vertex
  std::vector<EdgeNodes> edges;                           ///< without poles
};

/// Throws InvalidSolidError naming the faces that have no triangulation, or the edges that do not fit.
StitchedMesh stitch(const std::vector<FaceMesh>& faces);

}  // namespace starcell::cad
