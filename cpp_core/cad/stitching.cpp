#include "cad/stitching.h"

#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <limits>
#include <numeric>

#include "solids/errors.h"

namespace starcell::cad {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Disjoint sets of places; the smallest member represents its set, so the outcome depends on no order.
class Places {
 public:
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// An edge of the solid while it is being stitched: its nodes' places, known once the first face has shown them.
struct EdgePlaces {
  TopoDS_Edge edge;
  std::vector<std::uint32_t> places;
  std::vector<double> parameters;
};

class Stitcher {
 public:
  explicit Stitcher(const std::vector<FaceMesh>& faces) : faces_(faces) {}

  StitchedMesh run() {
    for (const FaceMesh& face : faces_) require_triangulation(face);
    add_vertices();
    add_nodes();
    for (std::size_t f = 0; f < faces_.size(); ++f) stitch_boundary(f);
    return collect();
  }

 private:
  static void require_triangulation(const FaceMesh& mesh) {
    if (mesh.triangulation.IsNull() || mesh.triangulation->NbTriangles() == 0)
      throw InvalidSolidError("OpenCASCADE cannot triangulate " + describe(mesh));
  }

  /// Places 0 ... n-1 are the solid's vertices.
  void add_vertices() {
    for (const FaceMesh& mesh : faces_) TopExp::MapShapes(mesh.face, TopAbs_VERTEX, vertices_);
    for (int i = 1; i <= vertices_.Extent(); ++i) {
      places_.add();
      positions_.push_back(BRep_Tool::Pnt(TopoDS::Vertex(vertices_(i))));
    }
  }

  void add_nodes() {
    for (const FaceMesh& mesh : faces_) {
      first_node_.push_back(static_cast<std::uint32_t>(places_.size()));
      for (int i = 1; i <= mesh.triangulation->NbNodes(); ++i) {
        places_.add();
        positions_.push_back(mesh.triangulation->Node(i).Transformed(mesh.placement.Transformation()));
      }
    }
  }

  void stitch_boundary(std::size_t f) {
    const FaceMesh& mesh = faces_[f];
    for (TopExp_Explorer walk(mesh.face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); walk.More(); walk.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(walk.Current());
      if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
      const Handle(Poly_PolygonOnTriangulation)& polygon =
          BRep_Tool::PolygonOnTriangulation(edge, mesh.original, mesh.placement);
      if (polygon.IsNull()) throw InvalidSolidError("OpenCASCADE left an edge of " + describe(mesh) + " without nodes");
      std::vector<std::uint32_t> nodes;
      for (int i = 1; i <= polygon->NbNodes(); ++i) {
        const int node = polygon->Node(i);
        if (node < 1 || node > mesh.original->NbNodes())
          throw InvalidSolidError("OpenCASCADE numbered the nodes of " + describe(mesh) + " wrongly");
        nodes.push_back(first_node_[f] + static_cast<std::uint32_t>(node) - 1);
      }
      stitch_edge(edge, nodes, *polygon, mesh);
    }
  }

  void stitch_edge(const TopoDS_Edge& edge, const std::vector<std::uint32_t>& nodes,
                   const Poly_PolygonOnTriangulation& polygon, const FaceMesh& mesh) {
    TopoDS_Vertex first, last;
    TopExp::Vertices(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), first, last);
    if (first.IsNull() || last.IsNull()) throw InvalidSolidError("an edge of " + describe(mesh) + " has no end vertices");
    const auto place = [&](const TopoDS_Vertex& v) { return static_cast<std::uint32_t>(vertices_.FindIndex(v)) - 1; };
    if (BRep_Tool::Degenerated(edge)) {
      for (const std::uint32_t node : nodes) places_.unite(node, place(first));
      return;
    }
    const std::size_t index = static_cast<std::size_t>(edge_index_.Add(edge)) - 1;
    if (index == edges_.size()) {
      edges_.push_back({TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), nodes, {}});
      places_.unite(nodes.front(), place(first));
      places_.unite(nodes.back(), place(last));
      if (polygon.HasParameters())
        for (int i = 1; i <= polygon.NbNodes(); ++i) edges_.back().parameters.push_back(polygon.Parameter(i));
    }
    const std::vector<std::uint32_t>& known = edges_[index].places;
    if (known.size() != nodes.size())
      throw InvalidSolidError("an edge of " + describe(mesh) + " has " + std::to_string(nodes.size()) + " nodes there but " +
                              std::to_string(known.size()) + " in its other face");
    for (std::size_t i = 0; i < nodes.size(); ++i) places_.unite(known[i], nodes[i]);
  }

  std::uint32_t vertex_of(std::uint32_t place, StitchedMesh& mesh) {
    const std::uint32_t root = places_.find(place);
    if (number_[root] == none) {
      number_[root] = static_cast<std::uint32_t>(mesh.vertices.size());
      const gp_Pnt& p = positions_[root];
      mesh.vertices.emplace_back(p.X(), p.Y(), p.Z());
    }
    return number_[root];
  }

  StitchedMesh collect() {
    StitchedMesh mesh;
    number_.assign(places_.size(), none);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Poly_Triangulation& triangulation = *faces_[f].triangulation;
      std::vector<std::uint32_t>& nodes = mesh.node_vertices.emplace_back();
      for (int i = 0; i < triangulation.NbNodes(); ++i)
        nodes.push_back(vertex_of(first_node_[f] + static_cast<std::uint32_t>(i), mesh));
      const bool reversed = faces_[f].face.Orientation() == TopAbs_REVERSED;
      for (int i = 1; i <= triangulation.NbTriangles(); ++i) {
        int a, b, c;
        triangulation.Triangle(i).Get(a, b, c);
        if (reversed) std::swap(b, c);
        const Triangle t{nodes[a - 1], nodes[b - 1], nodes[c - 1]};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        mesh.triangles.push_back(t);
        mesh.cad_face.push_back(faces_[f].number);
      }
    }
    for (EdgePlaces& edge : edges_) {
      EdgeNodes& nodes = mesh.edges.emplace_back();
      nodes.edge = edge.edge;
      nodes.parameters = std::move(edge.parameters);
      for (const std::uint32_t place : edge.places) nodes.vertices.push_back(vertex_of(place, mesh));
    }
    return mesh;
  }

  const std::vector<FaceMesh>& faces_;
  TopTools_IndexedMapOfShape vertices_;
  TopTools_IndexedMapOfShape edge_index_;
  std::vector<EdgePlaces> edges_;
  Places places_;
  std::vector<gp_Pnt> positions_;          ///< per place
  std::vector<std::uint32_t> first_node_;  ///< per face: the place of its first node
  std::vector<std::uint32_t> number_;      ///< per representative place: vertex of the result
};

}  // namespace

StitchedMesh stitch(const std::vector<FaceMesh>& faces) { return Stitcher(faces).run(); }

}  // namespace starcell::cad
