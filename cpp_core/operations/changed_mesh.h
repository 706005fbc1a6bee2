// What simplify() and remesh() have in common: the solid as a mesh, a change of that mesh with a proven bound, float32, and what is then said of it.
//
// A mesh is changed as it is, if it is not asked that large ones be contoured; any other solid is contoured first, within a share of the error.
// Guarantees: the certificate's: same topology, embedded, also in float32, and the two-sided distance from the solid is at most error_bound.
#pragma once

#include <functional>
#include <vector>

#include "operations/boolean.h"

namespace starcell {

struct Changed {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  double bound;   ///< of the two-sided Hausdorff distance from the mesh before
};

/// An isotopy of a closed, embedded mesh, within `most`; the mesh is `off` the solid, at most. Stops where it is once `go_on` (told how much is done, in [0, 1]) says no.
using Change = std::function<Changed(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, double off, const std::function<bool(double)>& go_on)>;

/// Decimation within a share of what it may take (none: the mesh as it is), ended after so many looks to a triangle (IsotopicMesh::work(); 0: none).
Change decimating(double share = 1, std::size_t looks = 0);

/// Changes a result's mesh within `open`, adds to its bound and opens gaps for float32. The places that meet in float32 nonetheless.
std::vector<Box3> change(Result& result, double open, const char* stage, const Change& how, const std::function<bool(double)>& go_on);

/// `stage`: what the change is called while it goes on. A mesh of more than `many` triangles is contoured first, too, if far fewer come of it. Throws as
/// evaluate().
Result changed_mesh(const Expression& solid, const Options& options, const char* stage, const Change& change, std::size_t many = SIZE_MAX);

}  // namespace starcell
