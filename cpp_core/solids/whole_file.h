// Writing a file whole or not at all: beside its destination first, then renamed.
#pragma once

#include <filesystem>
#include <string>

namespace starcell {

/// Throws FileError with the system's reason; whatever file stood there is then as it was.
void write_whole_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace starcell
