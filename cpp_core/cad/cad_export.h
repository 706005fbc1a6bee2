// Closed meshes to CAD files: the other door of the folder cad/, without OpenCASCADE's headers.
//
// Computes: the solid of mesh_to_solid.h in a file, by the extension: .bin (FreeCAD's Shape.importBinary; every coordinate
// exactly) or .brep, .brp (OpenCASCADE's text, 15 digits).
// Guarantees: a file that was not written completely is an error.
#pragma once

#include <optional>
#include <string>

#include "solids/polyhedron.h"

namespace starcell {

/// `tolerance`: model units, for what counts as flat and straight; none: 1e-9 of the mesh's largest side.
/// Returns the number of faces. Throws InvalidSolidError, FileError, std::invalid_argument for a negative tolerance or an
/// unknown extension.
std::size_t write_solid(const Polyhedron& mesh, const std::string& path, std::optional<double> tolerance);

}  // namespace starcell
