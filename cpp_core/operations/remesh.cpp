#include "operations/remesh.h"

#include <cmath>
#include <stdexcept>

#include "decimation/decimate.h"
#include "operations/changed_mesh.h"
#include "operations/tolerances.h"
#include "remeshing/remesh_surface.h"

namespace starcell {
namespace {

// Edges of a sphere of radius r are off it by a sixth of their square over r: with as many errors, what curves no faster than over four of them is let through.
constexpr double errors_to_an_edge = 5;
// Of the error: what taking folds out may take.
constexpr double unfolding_share = 0.25;

}  // namespace

Result remesh(const Expression& solid, std::optional<double> edge_length, double feature_angle, const Options& options) {
  if (edge_length && !(*edge_length > 0 && std::isfinite(*edge_length))) throw std::invalid_argument("edge_length: must be greater than 0");
  if (!(feature_angle > 0 && feature_angle < 180)) throw std::invalid_argument("feature_angle: must be between 0 and 180 degrees");
  std::size_t sharp = 0, corners = 0;
  const double error = error_for(options, solid.bounding_box());
  const double length = edge_length.value_or(errors_to_an_edge * error);
  Result result = changed_mesh(solid, options, "remeshing", [&](std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, double off, const std::function<bool(double)>& go_on) {
    // Meshes that were computed may lie on themselves, a rounding apart. Cut in pieces such folds would be many crossings in float32.
    Decimated flat = unfold(std::move(vertices), std::move(triangles), unfolding_share * most, go_on);
    Remeshed well = remesh_surface(std::move(flat.vertices), std::move(flat.triangles), {length, most - flat.bound, feature_angle * M_PI / 180, off}, go_on);
    sharp = well.feature_edges;
    corners = well.corners;
    return Changed{std::move(well.vertices), std::move(well.triangles), flat.bound + well.bound};
  });
  result.certificate.statistics["edge_length"] = length;
  result.certificate.statistics["features.edges"] = static_cast<double>(sharp);
  result.certificate.statistics["features.corners"] = static_cast<double>(corners);
  return result;
}

}  // namespace starcell
