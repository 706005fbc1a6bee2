// From a path to bytes to the reader of its format.
#include "solids/mesh_reader.h"

#include <filesystem>
#include <fstream>

#include "solids/errors.h"

namespace starcell {
namespace {

std::string read_bytes(const std::string& path) {
  std::error_code error;
  const std::filesystem::path file(path);
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw FileError(path + ": there is no such file.");
  // A device or a pipe may never end.
  if (!std::filesystem::is_regular_file(status)) throw FileError(path + ": it is not a file.");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) throw FileError(path + ": it cannot be opened.");
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) throw FileError(path + ": it cannot be read to its end.");
  return bytes;
}

}  // namespace

TriangleSoup read_mesh(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const auto reader = extension == ".off" ? read_off : extension == ".stl" ? read_stl : extension == ".obj" ? read_obj
                      : extension == ".ply" ? read_ply : nullptr;
  if (!reader)
    throw FileError(path + ": the format " + (extension.empty() ? "is not named by an extension" : "'" + extension + "' is not known") +
                    "; use .off, .stl, .obj or .ply" + (extension == ".gz" ? ", unpacked." : "."));
  return reader(read_bytes(path), path);
}

}  // namespace starcell
