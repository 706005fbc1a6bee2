// What the CAD tests measure with, independent of the code under test: volumes, Euler characteristics, distances.
#pragma once

#include <functional>
#include <random>

#include "expression/expression.h"

namespace starcell::test {

double volume(const Polyhedron& solid);
int euler_characteristic(const Polyhedron& solid);

/// A function's largest value over random points of the mesh, corners and edges included.
double largest_on(const Polyhedron& solid, const std::function<double(const Vec3&)>& f);

/// The distance from a point to the nearest triangle, by looking at all of them.
double distance_to(const Polyhedron& solid, const Vec3& point);

/// The polyhedron of an expression that is one leaf.
const Polyhedron& leaf(const Expression& solid);

}  // namespace starcell::test
