// Operands that an operation needs as meshes: evaluated and decimated within a share of the error, and named as tessellated.
//
// Guarantees: the mesh is within `error` of the solid, or its provenance says where not; what it touches of itself is passed on as
// contacts. An empty solid, or one of which nothing could be proved, becomes an empty mesh.
#pragma once

#include <algorithm>
#include <chrono>

#include "operations/boolean.h"

namespace starcell {

/// The seconds of a budget are for all that is done on the way, too.
class Clock {
 public:
  explicit Clock(double seconds) : seconds_(seconds) {}
  double left() const { return seconds_ - std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  /// The options with what is left.
  Options rest(Options options) const {
    options.budget.max_seconds = std::max(left(), 0.001);
    return options;
  }

 private:
  double seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Of the error that an operand's mesh may have: contouring's part, the rest is decimation's.
constexpr double contour_share = 0.5;

/// A certified mesh as an operand, in few triangles: what its error leaves over goes to decimation, which takes half of the seconds at
/// most. Throws CancelledError.
PolyhedronPtr thinned(Result mesh, double error, const char* name, const Progress& progress, double seconds);

/// The solid as a polyhedron: itself, or a certified mesh of it within `error`. Throws as evaluate().
PolyhedronPtr operand_mesh(const Expression& solid, double error, const Options& options, const Clock& clock, const char* name);

}  // namespace starcell
