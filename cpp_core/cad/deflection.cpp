#include "cad/deflection.h"

#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include "cad/edge_deflection.h"
#include "cad/elementary_surface.h"
#include "cad/free_form_deflection.h"

namespace starcell::cad {
namespace {

constexpr double exact_below = 1e-9;  ///< of the solid's size, for planar solids

std::vector<std::array<Vec3, 3>> triangles_of(int face, const StitchedMesh& mesh) {
  std::vector<std::array<Vec3, 3>> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.cad_face[t] == face) {
      const Triangle& c = mesh.triangles[t];
      found.push_back({mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]});
    }
  return found;
}

class Measurement {
 public:
  Measurement(const std::vector<FaceMesh>& faces, const StitchedMesh& mesh) : faces_(faces), mesh_(mesh) {
    for (const EdgeNodes& edge : mesh.edges) edges_.Add(edge.edge);
  }

  Deflection run() {
    for (const EdgeNodes& edge : mesh_.edges) {
      const bool straight = is_straight(edge.edge);
      polyhedral_ = polyhedral_ && straight;
      note(curve_deflection(edge, mesh_.vertices), straight ? "a straight edge" : "a curved edge");
    }
    for (std::size_t f = 0; f < faces_.size(); ++f) measure_face(f);
    Box3 box;
    for (const Vec3& v : mesh_.vertices) box.extend(v);
    if (polyhedral_ && worst_.value <= exact_below * longest_side(box)) return {};
    return worst_;
  }

 private:
  void note(double value, const std::string& where) {
    if (value > worst_.value) worst_ = {value, where};
  }

  void measure_face(std::size_t f) {
    const FaceMesh& face = faces_[f];
    const auto known = ElementarySurface::of(face.face);
    if (known) {
      // A plane's vertices decide whether the solid is exact; elsewhere a bound below what is already known is idle.
      const double enough = known->is_plane() ? 0 : worst_.value;
      note(known->largest_distance(triangles_of(face.number, mesh_), enough), describe(face));
      if (known->is_plane()) return;
    } else {
      note(free_form_deflection(face, mesh_.node_vertices[f], mesh_.vertices), describe(face));
    }
    polyhedral_ = false;
    for (TopExp_Explorer walk(face.face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); walk.More(); walk.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(walk.Current());
      if (const int index = edges_.FindIndex(edge); index > 0)
        note(strip_deflection(edge, mesh_.edges[index - 1], face, known.has_value(), mesh_.vertices),
             "an edge of " + describe(face));
    }
  }

  const std::vector<FaceMesh>& faces_;
  const StitchedMesh& mesh_;
  TopTools_IndexedMapOfShape edges_;
  bool polyhedral_ = true;
  Deflection worst_;
};

}  // namespace

Deflection measure_deflection(const std::vector<FaceMesh>& faces, const StitchedMesh& mesh) {
  return Measurement(faces, mesh).run();
}

}  // namespace starcell::cad
