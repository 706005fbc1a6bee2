// Polygons for tests, and whether two of them overlap by CGAL's exact Booleans: nothing that the engine uses.
#pragma once

#include <cmath>
#include <random>

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "configuration_space/convex_pieces.h"

namespace starcell::sample {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPolygon = CGAL::Polygon_2<Exact>;

/// Star-shaped about the origin, with reflex corners in general.
inline Ring random_star(std::mt19937& random, int corners, double smallest = 0.3) {
  std::uniform_real_distribution<double> radius(smallest, 1.0), off(0.1, 0.9);
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double a = 2 * M_PI * (k + off(random)) / corners, r = radius(random);
    ring.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return ring;
}

inline Ring placed(const Ring& ring, double x, double y, double angle) {
  Ring moved;
  for (const Point2& p : ring) moved.push_back({x + std::cos(angle) * p[0] - std::sin(angle) * p[1], y + std::sin(angle) * p[0] + std::cos(angle) * p[1]});
  return moved;
}

inline Ring rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

inline ExactPolygon exact(const Ring& ring) {
  ExactPolygon p;
  for (const Point2& c : ring) p.push_back({c[0], c[1]});
  if (p.is_clockwise_oriented()) p.reverse_orientation();
  return p;
}

/// Do the insides meet?
inline bool overlap(const Ring& a, const Ring& b) { return CGAL::do_intersect(exact(a), exact(b)); }

inline double area(const Ring& ring) { return CGAL::to_double(exact(ring).area()); }

inline double perimeter(const Ring& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) sum += std::hypot(ring[k][0] - ring[(k + 1) % ring.size()][0], ring[k][1] - ring[(k + 1) % ring.size()][1]);
  return sum;
}

}  // namespace starcell::sample
