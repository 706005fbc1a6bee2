#include "cad/well_formed.h"

#include <BRep_CurveRepresentation.hxx>
#include <BRep_ListIteratorOfListOfCurveRepresentation.hxx>
#include <BRep_TEdge.hxx>
#include <BRep_TFace.hxx>
#include <BRep_TVertex.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_TShape.hxx>
#include <cmath>
#include <unordered_set>

namespace starcell::cad {
namespace {

constexpr int deepest = 10'000;  ///< nesting of compounds

class Walk {
 public:
  std::string run(const TopoDS_Shape& shape, int depth) {
    if (shape.IsNull()) return "a part that is missing";
    if (shape.Orientation() < TopAbs_FORWARD || shape.Orientation() > TopAbs_EXTERNAL) return "an invalid orientation";
    if (depth > deepest) return "a part that contains itself";
    if (!seen_.insert(shape.TShape().get()).second) return {};
    if (std::string defect = geometry(shape); !defect.empty()) return defect;
    for (TopoDS_Iterator parts(shape, Standard_False, Standard_False); parts.More(); parts.Next()) {
      const TopoDS_Shape& part = parts.Value();
      if (part.IsNull()) return "a part that is missing";
      if (shape.ShapeType() != TopAbs_COMPOUND && part.ShapeType() <= shape.ShapeType())
        return "a part that is larger than the whole";
      if (std::string defect = run(part, depth + 1); !defect.empty()) return defect;
    }
    return {};
  }

 private:
  static std::string geometry(const TopoDS_Shape& shape) {
    switch (shape.ShapeType()) {
      case TopAbs_FACE: {
        const auto face = Handle(BRep_TFace)::DownCast(shape.TShape());
        return face.IsNull() || face->Surface().IsNull() ? "a face without a surface" : "";
      }
      case TopAbs_EDGE: {
        const auto edge = Handle(BRep_TEdge)::DownCast(shape.TShape());
        if (edge.IsNull()) return "an edge without geometry";
        BRep_ListIteratorOfListOfCurveRepresentation curves(edge->Curves());
        for (; curves.More(); curves.Next())
          if (curves.Value().IsNull() || (curves.Value()->IsCurve3D() && curves.Value()->Curve3D().IsNull() &&
                                          !edge->Degenerated() && edge->Curves().Extent() == 1))
            return "an edge without a curve";
        return edge->Tolerance() >= 0 ? "" : "an edge with an invalid tolerance";
      }
      case TopAbs_VERTEX: {
        const auto vertex = Handle(BRep_TVertex)::DownCast(shape.TShape());
        if (vertex.IsNull()) return "a vertex without a point";
        const gp_Pnt& p = vertex->Pnt();
        return std::isfinite(p.X() + p.Y() + p.Z()) ? "" : "a vertex that is not finite";
      }
      default: return {};
    }
  }

  std::unordered_set<const TopoDS_TShape*> seen_;
};

}  // namespace

std::string malformation(const TopoDS_Shape& shape) { return Walk().run(shape, 0); }

}  // namespace starcell::cad
