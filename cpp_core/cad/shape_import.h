// OpenCASCADE shapes to solids: what read_cad does after reading. For code that has a shape in hand; includes OCC.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

#include "cad/cad_import.h"

namespace starcell {

/// As read_cad. Triangulations that the shape carries are replaced; its geometry is not touched.
Expression import_shape(const TopoDS_Shape& shape, const std::string& name, double error, Curved curved = Curved::recognised);

}  // namespace starcell
