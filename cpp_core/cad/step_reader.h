// STEP files to shapes.
//
// Rests on STEPControl_Reader. It translates entities whose own parts could not be read as if they were whole, and
// follows null references: so files with broken lines, dangling references, or geometry and topology with unreadable
// parameters are refused before translation. Bad names, colours, units of angle and the like occur in good files and
// are passed over.
// Guarantees: a shape, or a FileError that names the entity's type and OpenCASCADE's complaint. Lengths come out in mm.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace starcell::cad {

TopoDS_Shape read_step(const std::string& bytes, const std::string& path);

}  // namespace starcell::cad
