#include "cad/consistency.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <array>
#include <cmath>

namespace starcell::cad {
namespace {

constexpr double largest_gap = 0.01;        ///< of the solid's size
constexpr double largest_parameter = 1e12;  ///< beyond, neighbouring doubles are apart

bool in_range(double first, double last) {
  return std::abs(first) < largest_parameter && std::abs(last) < largest_parameter && first < last;
}

class Edge {
 public:
  Edge(const TopoDS_Edge& edge, double size) : edge_(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD))), oriented_(edge) {
    std::array<TopoDS_Vertex, 2> ends;
    TopExp::Vertices(edge_, ends[0], ends[1]);
    bounded_ = !ends[0].IsNull() && !ends[1].IsNull();
    allowed_ = largest_gap * size;
    for (int k = 0; k < 2 && bounded_; ++k) {
      ends_[k] = BRep_Tool::Pnt(ends[k]);
      allowed_ = std::max(allowed_, 10 * BRep_Tool::Tolerance(ends[k]));
    }
    allowed_ = std::max(allowed_, 10 * BRep_Tool::Tolerance(edge));
  }

  std::string check(const TopoDS_Face& face, const BRepAdaptor_Surface& surface) const {
    if (!bounded_) return "an edge without end vertices";
    double first, last;
    if (!BRep_Tool::Degenerated(edge_)) {
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge_, first, last);
      if (curve.IsNull()) return "an edge without a curve";
      if (!in_range(first, last)) return "an edge with an invalid range";
      if (apart(curve->Value(first), curve->Value(last))) return "an edge that does not end at its vertices";
    }
    const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(oriented_, face, first, last);
    if (image.IsNull()) return "an edge without a curve on its face";
    if (!in_range(first, last)) return "an edge with an invalid range";
    const gp_Pnt2d from = image->Value(first), to = image->Value(last);
    return apart(surface.Value(from.X(), from.Y()), surface.Value(to.X(), to.Y())) ? "an edge that leaves its face" : "";
  }

 private:
  bool apart(const gp_Pnt& first, const gp_Pnt& last) const {
    return !(ends_[0].Distance(first) <= allowed_ && ends_[1].Distance(last) <= allowed_);  // catches NaN, too
  }

  TopoDS_Edge edge_, oriented_;
  std::array<gp_Pnt, 2> ends_;
  bool bounded_ = false;
  double allowed_ = 0;
};

}  // namespace

std::string inconsistency(const TopoDS_Solid& solid, double size) {
  int number = 0;
  for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    if (face.Orientation() != TopAbs_FORWARD && face.Orientation() != TopAbs_REVERSED) continue;
    ++number;
    const BRepAdaptor_Surface surface(face, Standard_False);
    for (TopExp_Explorer walk(face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); walk.More(); walk.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(walk.Current());
      if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
      if (const std::string defect = Edge(edge, size).check(face, surface); !defect.empty())
        return "face " + std::to_string(number) + " has " + defect;
    }
  }
  return {};
}

}  // namespace starcell::cad
