// The Python module `starcell`. A concept a file: exceptions, solids, expressions, certificate, operations, configuration spaces, inspection, penetration depth.
#include "bindings.h"

PYBIND11_MODULE(starcell, module) {
  using namespace starcell::python;
  module.doc() =
      "StarCell: meshes of solids with a certificate of their topology and of their distance to the true surface.\n\n"
      "Units are the model's (mm in FreeCAD), angles radians. Arrays come out as numpy (points: shape (n, 3) float64, "
      "triangles: (m, 3) int32) and go in as numpy or nested sequences. Method: G. Varadhan's thesis, cited as T§.";
  module.attr("__version__") = STARCELL_VERSION;
  bind_exceptions(module);
  bind_certificate(module);
  bind_solids(module);
  bind_curved_solids(module);
  bind_operations(module);
  bind_configuration_space(module);
  bind_inspection(module);
  bind_penetration_depth(module);
}
