// The same solid in well-shaped triangles (T§3.12.2): its mesh, remeshed (remeshing/remesh_surface.h).
//
// Sharp edges of the mesh stay where they are, but for slivers' (remeshing/features.h) and folds of less than 2.6 degrees, which are taken out
// first, within a quarter of the error (unfold() in decimation/decimate.h). Guarantees: the certificate's, as changed_mesh.h says. Does not guarantee: angles.
#pragma once

#include <optional>

#include "operations/boolean.h"

namespace starcell {

/// Of an edge at which the surface turns by more than this it is said that it is sharp, in degrees.
constexpr double default_feature_angle = 40;

/// `edge_length`: of most edges; without it, what the error lets a smooth surface have. Throws as evaluate(), and std::invalid_argument for a length that is not greater than 0
/// or an angle that is not between 0 and 180 degrees.
Result remesh(const Expression& solid, std::optional<double> edge_length, double feature_angle, const Options& options);

}  // namespace starcell
