// Which solids a shape consists of.
//
// Computes: every solid of a compound or compsolid, placed; a closed shell outside any solid becomes one.
// Guarantees: throws InvalidSolidError for faces that bound no volume: faces outside any shell, open shells (with the
// number of free edges), a shape without faces. Loose wires, edges and vertices are no solids and are passed over.
#pragma once

#include <TopoDS_Solid.hxx>
#include <string>
#include <vector>

namespace starcell::cad {

struct SolidPart {
  TopoDS_Solid solid;
  std::string name;
};

/// `name` is the model's name; of several parts each gets its number appended.
std::vector<SolidPart> solid_parts(const TopoDS_Shape& shape, const std::string& name);

/// "a solid", "a compound of 3 shells": what a message calls the shape.
std::string describe(const TopoDS_Shape& shape);

}  // namespace starcell::cad
