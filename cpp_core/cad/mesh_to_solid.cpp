#include "cad/mesh_to_solid.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Precision.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax3.hxx>
#include <gp_Lin.hxx>
#include <gp_Pln.hxx>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "cad/planar_faces.h"
#include "cad/polygon_check.h"
#include "solids/connectivity.h"
#include "solids/errors.h"

namespace starcell::cad {
namespace {

constexpr int attempts = 4;
constexpr std::size_t many_loops = 64;  ///< OpenCASCADE compares the wires of a face each with each

gp_Pnt point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
gp_Dir direction(const Vec3& d) { return {d.x(), d.y(), d.z()}; }

/// Twice the area that the loop encloses, seen from outside; holes are negative.
double enclosed(const std::vector<std::uint32_t>& loop, const Vec3& normal, const std::vector<Vec3>& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += (p[loop[i]] - p[loop[0]]).cross(p[loop[i + 1]] - p[loop[0]]);
  return sum.dot(normal);
}

/// The tolerance that a face's edges need: it covers their distance from the face's plane.
double reach(const PlanarFace& face) { return Precision::Confusion() + 1.01 * face.away; }

/// Faces with common vertices and edges, in the order of the polygons.
class FaceBuilder {
 public:
  FaceBuilder(const Polyhedron& mesh, const std::vector<PlanarFace>& polygons)
      : mesh_(mesh), polygons_(polygons), vertices_(mesh.vertices().size()), reach_(vertices_.size(), 0) {
    for (std::uint32_t f = 0; f < polygons_.size(); ++f)
      over_edges(f, [&](std::uint32_t a, std::uint32_t b) {
        Edge& edge = edges_[key(a, b)];
        edge.reach = std::max(edge.reach, reach(polygons_[f]));
        ++(a < b ? edge.forward : edge.backward);
        reach_[a] = std::max(reach_[a], reach(polygons_[f]));
      });
  }

  /// Null if the polygon is none: no outer loop, or edges that are not shared by two.
  TopoDS_Face face(std::uint32_t f) {
    const PlanarFace& polygon = polygons_[f];
    std::vector<std::size_t> order(polygon.loops.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto is_outer = [&](std::size_t i) { return enclosed(polygon.loops[i], polygon.normal, mesh_.vertices()) > 0; };
    const auto holes = std::stable_partition(order.begin(), order.end(), is_outer);
    bool shared = holes - order.begin() == 1;
    over_edges(f, [&](std::uint32_t a, std::uint32_t b) {
      const Edge& edge = edges_[key(a, b)];
      shared = shared && edge.forward == 1 && edge.backward == 1;
    });
    if (!shared) return {};
    TopoDS_Face face;
    const gp_Ax3 frame(point(polygon.point), direction(polygon.normal), direction(polygon.normal.unitOrthogonal()));
    builder_.MakeFace(face, new Geom_Plane(gp_Pln(frame)), Precision::Confusion());
    for (const std::size_t i : order) builder_.Add(face, wire(polygon.loops[i]));
    return face;
  }

 private:
  struct Edge {
    double reach = 0;
    int forward = 0, backward = 0;  ///< uses in each direction
    TopoDS_Edge shape;
  };

  template <class Visit>
  void over_edges(std::uint32_t f, Visit&& visit) const {
    for (const auto& loop : polygons_[f].loops)
      for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
  }
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b); }

  TopoDS_Wire wire(const std::vector<std::uint32_t>& loop) {
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
      builder_.Add(wire, edge(a, b).Oriented(a < b ? TopAbs_FORWARD : TopAbs_REVERSED));
    }
    wire.Closed(Standard_True);
    return wire;
  }

  const TopoDS_Edge& edge(std::uint32_t a, std::uint32_t b) {
    Edge& edge = edges_[key(a, b)];
    if (edge.shape.IsNull()) {
      const auto [low, high] = std::minmax(a, b);
      const Vec3 &p = mesh_.vertices()[low], along = mesh_.vertices()[high] - p;
      builder_.MakeEdge(edge.shape, new Geom_Line(gp_Lin(point(p), direction(along))), edge.reach);
      builder_.Add(edge.shape, vertex(low).Oriented(TopAbs_FORWARD));
      builder_.Add(edge.shape, vertex(high).Oriented(TopAbs_REVERSED));
      builder_.Range(edge.shape, 0, along.norm());
    }
    return edge.shape;
  }

  const TopoDS_Vertex& vertex(std::uint32_t v) {
    if (vertices_[v].IsNull()) builder_.MakeVertex(vertices_[v], point(mesh_.vertices()[v]), reach_[v]);
    return vertices_[v];
  }

  const Polyhedron& mesh_;
  const std::vector<PlanarFace>& polygons_;
  BRep_Builder builder_;
  std::vector<TopoDS_Vertex> vertices_;
  std::vector<double> reach_;  ///< tolerance of a vertex
  std::unordered_map<std::uint64_t, Edge> edges_;
};

/// The edge-connected parts of the mesh, which are outer shells or cavities, and which solid each belongs to.
class Shells {
 public:
  explicit Shells(const Polyhedron& mesh) : mesh_(mesh), of_(mesh.triangles().size(), kNoTriangle) {
    for (std::uint32_t first = 0; first < of_.size(); ++first)
      if (of_[first] == kNoTriangle) flood(first);
  }

  std::size_t count() const { return parts_.size(); }
  std::uint32_t of(std::uint32_t triangle) const { return of_[triangle]; }
  bool is_cavity(std::size_t s) const { return parts_[s].volume < 0; }

  /// The smallest shell around a cavity that is none itself.
  std::size_t around(std::size_t cavity) const {
    std::size_t best = cavity;
    const Vec3& p = mesh_.vertices()[mesh_.triangles()[parts_[cavity].triangles[0]][0]];
    for (std::size_t s = 0; s < parts_.size(); ++s)
      if (!is_cavity(s) && (best == cavity || parts_[s].volume < parts_[best].volume) && parts_[s].box.contains(p) &&
          winds_round(s, p))
        best = s;
    return best;
  }

 private:
  struct Part {
    std::vector<std::uint32_t> triangles;
    Box3 box;
    double volume = 0;
  };

  const Vec3& at(std::uint32_t t, std::size_t k) const { return mesh_.vertices()[mesh_.triangles()[t][k]]; }

  void flood(std::uint32_t first) {
    Part part;
    part.triangles.push_back(first);
    of_[first] = static_cast<std::uint32_t>(parts_.size());
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      const std::uint32_t t = part.triangles[i];
      for (std::size_t k = 0; k < 3; ++k) part.box.extend(at(t, k));
      part.volume += (at(t, 0) - at(first, 0)).dot((at(t, 1) - at(first, 0)).cross(at(t, 2) - at(first, 0))) / 6;
      for (const std::uint32_t other : mesh_.neighbours()[t])
        if (of_[other] == kNoTriangle) {
          of_[other] = of_[first];
          part.triangles.push_back(other);
        }
    }
    parts_.push_back(std::move(part));
  }

  /// By the solid angle under which the shell is seen from p (A. Van Oosterom and J. Strackee, 1983): 4 pi inside, else 0.
  bool winds_round(std::size_t s, const Vec3& p) const {
    double angle = 0;
    for (const std::uint32_t t : parts_[s].triangles) {
      const Vec3 a = at(t, 0) - p, b = at(t, 1) - p, c = at(t, 2) - p;
      const double x = a.norm(), y = b.norm(), z = c.norm();
      angle += 2 * std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
    }
    return angle > 2 * std::numbers::pi;
  }

  const Polyhedron& mesh_;
  std::vector<std::uint32_t> of_;
  std::vector<Part> parts_;
};

TopoDS_Shape assembled(const std::vector<TopoDS_Face>& faces, const std::vector<PlanarFace>& polygons, const Shells& shells) {
  const BRep_Builder builder;
  std::vector<TopoDS_Shell> surfaces(shells.count());
  for (TopoDS_Shell& shell : surfaces) builder.MakeShell(shell);
  for (std::size_t f = 0; f < faces.size(); ++f) builder.Add(surfaces[shells.of(polygons[f].triangles[0])], faces[f]);
  std::vector<TopoDS_Solid> solids(shells.count());
  for (const bool cavities : {false, true})  // the outer shell comes first in its solid
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      if (shells.is_cavity(s) != cavities) continue;
      surfaces[s].Closed(Standard_True);
      TopoDS_Solid& solid = solids[cavities ? shells.around(s) : s];
      if (solid.IsNull()) builder.MakeSolid(solid);
      builder.Add(solid, surfaces[s]);
    }
  std::erase_if(solids, [](const TopoDS_Solid& solid) { return solid.IsNull(); });
  if (solids.size() == 1) return solids.front();
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Solid& solid : solids) builder.Add(all, solid);
  return all;
}

/// Its edges and vertices lie in the face by construction, within their tolerances: only polygons can be wrong, and triangles
/// only if they are slivers.
bool is_valid(const TopoDS_Face& face, const PlanarFace& polygon, const Polyhedron& mesh) {
  const bool triangle = polygon.loops.size() == 1 && polygon.loops[0].size() == 3;
  if (triangle || polygon.loops.size() > many_loops) {
    if (is_simple(polygon, mesh.vertices(), 4 * reach(polygon))) return true;
  }
  return BRepCheck_Analyzer(face).IsValid();
}

}  // namespace

MeshSolid mesh_to_solid(const Polyhedron& mesh, double tolerance) {
  if (mesh.triangles().empty()) throw InvalidSolidError("The mesh is empty: there is nothing to make a solid of.");
  const Shells shells(mesh);
  std::vector<char> alone(mesh.triangles().size(), 0);
  std::string where;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::vector<PlanarFace> polygons = planar_faces(mesh, tolerance, alone);
    FaceBuilder builder(mesh, polygons);
    std::vector<TopoDS_Face> faces;
    std::vector<std::uint32_t> bad;
    for (std::uint32_t f = 0; f < polygons.size(); ++f) {
      faces.push_back(builder.face(f));
      if (faces.back().IsNull()) bad.push_back(f);
    }
    if (bad.empty()) {
      for (std::uint32_t f = 0; f < polygons.size(); ++f)
        if (!is_valid(faces[f], polygons[f], mesh)) bad.push_back(f);
      if (bad.empty()) return {assembled(faces, polygons, shells), faces.size()};
    }
    bool changed = false;
    for (const std::uint32_t f : bad) {
      where = place(mesh.vertices()[mesh.triangles()[polygons[f].triangles[0]][0]]);
      for (const std::uint32_t t : polygons[f].triangles) {
        changed = changed || (polygons[f].triangles.size() > 1 && !alone[t]);
        alone[t] = 1;
      }
    }
    if (!changed) break;
  }
  throw InvalidSolidError("The mesh makes no valid CAD solid: OpenCASCADE rejects a face near " + where +
                          ". Facets thinner than its tolerance of 1e-7 do this; raise the tolerance, or scale the mesh up.");
}

}  // namespace starcell::cad
