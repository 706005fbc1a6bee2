// How far two closed polylines are from each other when both are run through at once: a bound of their Fréchet distance.
//
// Rests on this: whatever the speeds, distance between two points that move along segments is greatest at their ends. Points that
// nearly coincide are passed together, what lies between them in proportion to its length.
// Guarantees: an upper bound, and so one of the Hausdorff distance between the cones over both from any common apex. Does not
// guarantee the least one.
#pragma once

#include <vector>

#include "numerics/vector.h"

namespace starcell {

/// Infinite if no point of one is within `same` of a point of the other.
double loop_distance(const std::vector<Vec3>& p, const std::vector<Vec3>& q, double same);

}  // namespace starcell
