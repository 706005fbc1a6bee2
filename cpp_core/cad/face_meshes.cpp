#include "cad/face_meshes.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

namespace starcell::cad {
namespace {

bool has_surface(const TopoDS_Face& face) {
  TopLoc_Location placement;
  return !BRep_Tool::Surface(face, placement).IsNull();
}

}  // namespace

std::vector<FaceMesh> mesh_faces(const TopoDS_Solid& solid, const Resolution& resolution) {
  BRepTools::Clean(solid, Standard_True);
  IMeshTools_Parameters parameters;
  parameters.Deflection = parameters.DeflectionInterior = resolution.length;
  parameters.Angle = parameters.AngleInterior = resolution.angle;
  parameters.MinSize = std::max(0.01 * resolution.length, 1e-6);
  parameters.InParallel = Standard_False;
  parameters.Relative = Standard_False;
  BRepMesh_IncrementalMesh mesher(solid, parameters);

  std::vector<FaceMesh> faces;
  for (TopExp_Explorer walk(solid, TopAbs_FACE); walk.More(); walk.Next()) {
    const TopoDS_Face& face = TopoDS::Face(walk.Current());
    if (face.Orientation() != TopAbs_FORWARD && face.Orientation() != TopAbs_REVERSED) continue;
    FaceMesh mesh;
    mesh.face = face;
    mesh.number = static_cast<int>(faces.size()) + 1;
    if (has_surface(face)) mesh.triangulation = mesh.original = BRep_Tool::Triangulation(face, mesh.placement);
    faces.push_back(mesh);
  }
  return faces;
}

std::string describe(const FaceMesh& mesh) {
  static const char* const kinds[] = {"plane",
                                      "cylinder",
                                      "cone",
                                      "sphere",
                                      "torus",
                                      "Bezier surface",
                                      "B-spline surface",
                                      "surface of revolution",
                                      "extruded surface",
                                      "offset surface",
                                      "surface"};
  const std::string number = "face " + std::to_string(mesh.number);
  if (!has_surface(mesh.face)) return number + " (without a surface)";
  return number + " (" + kinds[BRepAdaptor_Surface(mesh.face, Standard_False).GetType()] + ")";
}

}  // namespace starcell::cad
