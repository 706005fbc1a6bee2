#include "solids/whole_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "solids/errors.h"

namespace starcell {
namespace {

[[noreturn]] void give_up(const std::filesystem::path& path, const std::filesystem::path& part, const std::string& reason) {
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw FileError("Cannot write '" + path.string() + "': " + reason + ".");
}

}  // namespace

void write_whole_file(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::path part = path;
  part += ".part";
  errno = 0;
  std::ofstream file(part, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) give_up(path, part, std::strerror(errno));
  std::error_code problem;
  std::filesystem::rename(part, path, problem);
  if (problem) give_up(path, part, problem.message());
}

}  // namespace starcell
