// The faces of one solid, each with its own triangulation, all edges discretised once.
//
// Rests on BRepMesh_IncrementalMesh: it discretises every edge of the solid once and puts these nodes into the
// triangulation of each face at the edge, where Poly_PolygonOnTriangulation lists them in order.
// Guarantees: sequential, so deterministic; every boundary face of the solid is there or its failure is reported.
// Does not guarantee: that neighbouring triangulations fit (stitching.h checks) or their accuracy (deflection.h).
#pragma once

#include <Poly_Triangulation.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Solid.hxx>
#include <string>
#include <vector>

namespace starcell::cad {

struct Resolution {
  double length;  ///< linear deflection that BRepMesh is asked for, model units
  double angle;   ///< its angular deflection, radians
};

struct FaceMesh {
  TopoDS_Face face;                          ///< placed, with its orientation in the solid
  int number = 0;                            ///< 1-based among the solid's boundary faces
  Handle(Poly_Triangulation) triangulation;  ///< in the face's own coordinates; null if BRepMesh failed
  Handle(Poly_Triangulation) original;       ///< as BRepMesh made it: the edges list its nodes, which both have first
  TopLoc_Location placement;                 ///< from there to the model
};

/// `solid` is meshed in place: earlier triangulations are discarded.
std::vector<FaceMesh> mesh_faces(const TopoDS_Solid& solid, const Resolution& resolution);

/// "face 12 (cylinder)": what a message calls a face.
std::string describe(const FaceMesh& face);

}  // namespace starcell::cad
