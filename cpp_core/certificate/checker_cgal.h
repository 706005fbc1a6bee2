// What the checker asks of CGAL's Polygon_mesh_processing. CGAL's exceptions become answers with a reason.
#pragma once

#include <string>

#include "certificate/certificate_file.h"
#include "certificate/checker.h"

namespace starcell::checker {

struct Finding {
  Answer answer = Answer::unknown;
  std::string detail;
};

/// No two triangles meet except in what they share, and none is degenerate: exact. For a mesh without manifold_defect().
Finding embedded(const StoredMesh& mesh);

/// Embedded, and every shell is oriented so that the mesh bounds a volume.
Finding bounds_a_volume(const StoredMesh& mesh);

/// The vertices as float32 numbers, in doubles again.
StoredMesh rounded_to_float32(const StoredMesh& mesh);

struct ExactBoolean {
  bool known = false;
  std::string reason;  ///< if not known
  StoredMesh mesh;     ///< its exact vertices rounded to double, its combinatorics as they are
};

/// The boundary of the expression, by corefinement with exact constructions. The operands must bound volumes.
ExactBoolean exact_boolean(const CertificateFile& file);

/// The largest distance of a vertex of one mesh to the other mesh, either way; neither is empty.
double vertex_distance(const StoredMesh& a, const StoredMesh& b);

/// The two-sided Hausdorff distance up to `precision`; neither is empty. Throws what CGAL throws.
double hausdorff_distance(const StoredMesh& a, const StoredMesh& b, double precision);

}  // namespace starcell::checker
