#include "operations/operand_mesh.h"

#include "decimation/decimate.h"
#include "solids/errors.h"

namespace starcell {
namespace {

// Of the seconds that are left when it begins: decimation's at most.
constexpr double decimation_share = 0.5;

}  // namespace

// Distances from few large triangles that bend one way are smoother than from many small ones that bend both ways, as contouring leaves
// them.
PolyhedronPtr thinned(Result mesh, double error, const char* name, const Progress& progress, double seconds) {
  const Clock patience(decimation_share * seconds);
  const auto go_on = [&](double) {
    if (progress && !progress(0.99, "decimating")) throw CancelledError("The run was cancelled.");
    return patience.left() > 0;
  };
  Provenance provenance;
  provenance.name = name;
  provenance.unresolved = std::move(mesh.certificate.unresolved);
  provenance.contacts = std::move(mesh.certificate.contacts);   // how far it was moved off them is counted in its bound
  const double bound = std::min(mesh.certificate.error_bound, error);   // what is more than asked for is at the unresolved places
  provenance.deflection = bound;
  if (mesh.triangles.empty()) return Polyhedron::trusted({}, {}, std::move(provenance));
  Decimated few = decimate(std::move(mesh.vertices), std::move(mesh.triangles), error - bound, go_on);
  provenance.deflection += few.bound;
  return Polyhedron::trusted(std::move(few.vertices), std::move(few.triangles), std::move(provenance));
}

PolyhedronPtr operand_mesh(const Expression& solid, double error, const Options& options, const Clock& clock, const char* name) {
  if (solid.kind() == Expression::Kind::polyhedron) return solid.polyhedron();
  Options inner = clock.rest(options);
  inner.error = contour_share * error;
  inner.contact.reset();
  Result mesh = evaluate(solid, inner);
  return thinned(std::move(mesh), error, name, options.progress, clock.left());
}

}  // namespace starcell
