// An expression's mesh in few triangles: contoured in most of the error, decimated in the rest (T§3.12.2; decimation/decimate.h).
//
// Contouring makes as many triangles as its cells need, most of them far nearer to the surface than asked for. Decimation may take as much as
// contouring took, and no more than is left: what is known to rounding stays as it is, flat sides with their corners among it.
// Guarantees: those of evaluate(): decimation is an isotopy, and its distance is in the bound.
#pragma once

#include <functional>

#include "operations/boolean.h"

namespace starcell {

/// Throws as evaluate(). `contoured`, if given, is told the mesh before it is decimated.
Result evaluate_in_few(const Expression& expression, const Options& options, const std::function<void(const Result&)>& contoured = {});

}  // namespace starcell
