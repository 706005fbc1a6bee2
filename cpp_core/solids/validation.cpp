// The order of the checks is that of their needs: finite numbers, then combinatorics, then geometry, then sides. Later
// checks still run after an earlier one has failed wherever they make sense, so that one message names every defect.
#include "solids/validation.h"

#include "solids/connectivity.h"
#include "solids/errors.h"
#include "solids/orientation.h"
#include "solids/self_intersection.h"

namespace starcell {
namespace {

class Report {
 public:
  void add(const Defect& defect, const char* one, const char* many, bool more_than = false) {
    if (defect.count == 0) return;
    text_ += text_.empty() ? "" : ", ";
    text_ += (more_than ? "more than " : "") + std::to_string(defect.count) + " " + (defect.count == 1 ? one : many);
    if (!defect.first.empty()) text_ += (defect.count == 1 ? " (at " : " (the first at ") + defect.first + ")";
  }
  void add(const SelfIntersections& found) {
    add(found.zero_area, "zero-area triangle, which makes it self-intersect", "zero-area triangles, which make it self-intersect");
    add(found.pairs, "pair of triangles that intersect", "pairs of triangles that intersect", !found.all_found);
  }
  void throw_if_any(const char* remedy) const {
    if (!text_.empty()) throw InvalidSolidError("The mesh is not a closed solid: " + text_ + "; " + remedy + ".");
  }

 private:
  std::string text_;
};

Defect not_finite(const std::vector<Vec3>& vertices) {
  Defect defect;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (!vertices[v].allFinite() && defect.count++ == 0) defect.first = place(vertices[v]);
  return defect;
}

}  // namespace

std::vector<Triangle> validate(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, std::size_t degenerate) {
  if (triangles.empty())
    throw InvalidSolidError(degenerate == 0 ? "The mesh is empty: it has no triangles."
                                            : "The mesh is empty: each of its triangles is degenerate (repeats a vertex).");
  Report report;
  const Defect infinite = not_finite(vertices);
  report.add(infinite, "vertex that is not finite", "vertices that are not finite");

  Connectivity mesh = connect(vertices, triangles);
  report.add(mesh.open_edges, "open edge", "open edges");
  report.add(mesh.non_manifold_edges, "non-manifold edge", "non-manifold edges");
  report.add(mesh.non_manifold_vertices, "non-manifold vertex", "non-manifold vertices");
  report.add(mesh.doubled_facets, "doubled facet, which is not manifold", "doubled facets, which are not manifold");
  if (!mesh.closed_manifold() && degenerate > 0)
    report.add({degenerate, ""}, "degenerate triangle that repeats a vertex", "degenerate triangles that repeat a vertex");

  const Shells shells = orient_consistently(vertices, triangles, mesh.neighbours);
  report.add(shells.non_orientable, "component that has no inside (not orientable)", "components that have no inside (not orientable)");
  if (infinite.count == 0) {
    const TriangleHierarchy hierarchy(vertices, triangles);
    report.add(find_self_intersections(vertices, triangles, hierarchy));
    report.throw_if_any("close and separate them or use Repair");
    orient_outward(vertices, triangles, mesh.neighbours, shells, hierarchy);
  }
  report.throw_if_any("correct the numbers first");
  return std::move(mesh.neighbours);
}

void validate_image(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, std::vector<Triangle>& neighbours) {
  Report report;
  report.add(not_finite(vertices), "moved vertex that is not finite", "moved vertices that are not finite");
  report.throw_if_any("use a smaller scale");
  const TriangleHierarchy hierarchy(vertices, triangles);
  report.add(find_self_intersections(vertices, triangles, hierarchy));
  report.throw_if_any("rounding of the moved vertices has made it so, so move it less far or scale it less");
  const Shells shells = orient_consistently(vertices, triangles, neighbours);
  orient_outward(vertices, triangles, neighbours, shells, hierarchy);
}

}  // namespace starcell
