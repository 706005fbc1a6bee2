// Binary BREP in both of its layouts.
//
// Rests on BinTools_ShapeSet, which writes the body of either. What follows it says which shape of the set is meant:
// BinTools::Write adds 9 bytes (orientation, index from the end, location), FreeCAD's exportBinary three integers
// (shape, location, orientation). The number of bytes left tells them apart.
// Guarantees: every index is checked against the set before use. Throws FileError.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace starcell::cad {

TopoDS_Shape read_binary_brep(const std::string& bytes, const std::string& path);

}  // namespace starcell::cad
