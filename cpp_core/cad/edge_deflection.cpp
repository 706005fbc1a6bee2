#include "cad/edge_deflection.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>

namespace starcell::cad {
namespace {

constexpr int steps = 8;  ///< a segment; even, so that its middle is a sample

Vec3 to_vec3(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * ab).norm();
}

bool has_curve(const TopoDS_Edge& edge) {
  double first, last;
  return !BRep_Tool::Curve(edge, first, last).IsNull();
}

/// Lines and circles: their samples contain the farthest point.
bool samples_are_exact(const TopoDS_Edge& edge) {
  if (!has_curve(edge)) return false;
  const GeomAbs_CurveType type = BRepAdaptor_Curve(edge).GetType();
  return type == GeomAbs_Line || type == GeomAbs_Circle;
}

}  // namespace

bool is_straight(const TopoDS_Edge& edge) { return has_curve(edge) && BRepAdaptor_Curve(edge).GetType() == GeomAbs_Line; }

double curve_deflection(const EdgeNodes& edge, const std::vector<Vec3>& vertices) {
  if (!has_curve(edge.edge) || edge.parameters.size() != edge.vertices.size()) return 0;
  const BRepAdaptor_Curve curve(edge.edge);
  double worst = 0;
  for (std::size_t i = 0; i + 1 < edge.vertices.size(); ++i)
    for (int k = 0; k <= steps; ++k) {
      const double t = edge.parameters[i] + (edge.parameters[i + 1] - edge.parameters[i]) * k / steps;
      worst = std::max(
          worst, distance_to_segment(to_vec3(curve.Value(t)), vertices[edge.vertices[i]], vertices[edge.vertices[i + 1]]));
    }
  return worst * (samples_are_exact(edge.edge) ? 1.0 : sampling_margin);
}

double strip_deflection(const TopoDS_Edge& edge, const EdgeNodes& nodes, const FaceMesh& face, bool elementary,
                        const std::vector<Vec3>& vertices) {
  double first, last;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face.face, first, last);
  if (curve.IsNull() || nodes.parameters.size() != nodes.vertices.size()) return 0;
  const BRepAdaptor_Surface surface(face.face, Standard_False);
  double worst = 0;
  for (std::size_t i = 0; i + 1 < nodes.vertices.size(); ++i) {
    const double from = nodes.parameters[i], to = nodes.parameters[i + 1];
    const gp_XY begin = curve->Value(from).XY(), end = curve->Value(to).XY();
    for (int k = 0; k <= steps; ++k) {
      const double s = double(k) / steps;
      const gp_XY on_curve = curve->Value(from + (to - from) * s).XY();
      const gp_XY on_chord = begin * (1 - s) + end * s;
      for (const double blend : {0.0, 0.5, 1.0}) {
        const gp_XY uv = on_curve * (1 - blend) + on_chord * blend;
        worst = std::max(worst, distance_to_segment(to_vec3(surface.Value(uv.X(), uv.Y())), vertices[nodes.vertices[i]],
                                                    vertices[nodes.vertices[i + 1]]));
      }
    }
  }
  return worst * (elementary && samples_are_exact(nodes.edge) ? 1.0 : sampling_margin);
}

}  // namespace starcell::cad
