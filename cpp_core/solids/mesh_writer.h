// Triangle meshes to files: OFF and OBJ as text with every digit, STL and PLY binary. PLY keeps doubles, STL is float32.
// Guarantees: OFF, OBJ and PLY read back bit-identical. An error leaves whatever file stood there before.
#pragma once

#include <filesystem>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

/// Chooses the format by the extension, any case. Throws std::invalid_argument for another one, FileError.
void write_mesh(const std::filesystem::path& path, const std::vector<Vec3>& vertices,
                const std::vector<Triangle>& triangles);

}  // namespace starcell
