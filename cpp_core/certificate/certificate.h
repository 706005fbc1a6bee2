// What was proved of a result. Every field is either proved by the run that filled it or measured on the mesh itself.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "numerics/vector.h"

namespace starcell {

enum class Verdict {
  exact,       ///< A is isotopic to the true boundary E, and H(A, E) <= error_bound
  contact,     ///< as exact, for an input moved by at most the contact tolerance
  unresolved,  ///< a budget ran out; A is closed, manifold and embedded, the open cells are listed
};

const char* to_string(Verdict verdict);

struct Certificate {
  Verdict verdict = Verdict::exact;
  double error_bound = 0.0;                                   ///< everything included
  double requested_error = 0.0;
  double contact_tolerance = 0.0;
  int components = 0;                                         ///< connected components of the mesh
  std::vector<int> genus;                                     ///< per component, largest volume first
  int euler_characteristic = 0;
  std::vector<std::pair<std::string, double>> tessellated;    ///< operands approximated on the way in, measured deflection
  std::vector<Box3> contacts;
  std::vector<Box3> unresolved;
  std::map<std::string, double> statistics;                   ///< leaves, cells, max_depth, seconds.*, guard_tests.*, triangles
};

}  // namespace starcell
