// Files to OpenCASCADE shapes, by content where the extension does not tell: text BREP, binary BREP, STEP.
//
// Rests on brep_reader.h and step_reader.h.
// Guarantees: a shape that is not null, or a FileError with path and reason.
// Does not guarantee: that the shape is a solid or valid (solid_parts.h looks at that).
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace starcell::cad {

TopoDS_Shape read_shape(const std::string& path);

}  // namespace starcell::cad
