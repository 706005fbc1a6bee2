// BREP files to shapes: text, and binary in both of its layouts.
//
// Rests on BRepTools and BinTools_ShapeSet. After the set of shapes, binary files say which of them is meant:
// BinTools::Write adds 9 bytes (orientation, index from the end, location), FreeCAD's exportBinary three integers
// (shape, location, orientation). The number of bytes left tells them apart.
// OpenCASCADE's readers check little: reading on past the end of the text is made an error here (they would wait there
// for ever), and what they return is walked for values that no shape has (nulls, orientations, dimensions).
// Guarantees: a well-formed shape or a FileError.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace starcell::cad {

TopoDS_Shape read_text_brep(const std::string& bytes, const std::string& path);
TopoDS_Shape read_binary_brep(const std::string& bytes, const std::string& path);

}  // namespace starcell::cad
