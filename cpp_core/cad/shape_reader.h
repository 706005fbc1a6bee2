// Files to OpenCASCADE shapes, by content where the extension does not tell: text BREP, binary BREP, STEP.
//
// Rests on BRepTools, BinTools and STEPControl. Binary BREP comes in two layouts that differ in their last bytes only:
// BinTools::Write ends with orientation (1 byte), shape and location index; FreeCAD's exportBinary with three integers.
// Guarantees: a shape that is not null, or a FileError with path and reason.
// Does not guarantee: that the shape is a solid or valid (solid_parts.h looks at that).
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace starcell::cad {

TopoDS_Shape read_shape(const std::string& path);

}  // namespace starcell::cad
