#include "cad/shape_reader.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cad/brep_reader.h"
#include "cad/occ_boundary.h"
#include "cad/step_reader.h"
#include "solids/errors.h"

namespace starcell::cad {
namespace {

/// OpenCASCADE's readers talk to standard output; what matters goes into our exceptions instead.
class SilentMessenger {
 public:
  SilentMessenger() : saved_(Message::DefaultMessenger()->Printers()) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~SilentMessenger() { Message::DefaultMessenger()->ChangePrinters() = saved_; }
  SilentMessenger(const SilentMessenger&) = delete;
  SilentMessenger& operator=(const SilentMessenger&) = delete;

 private:
  Message_SequenceOfPrinters saved_;
};

std::string read_bytes(const std::string& path) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem)) throw FileError("Cannot read '" + path + "': it is a folder.");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError("Cannot open '" + path + "': " + std::strerror(errno) + ".");
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (file.bad()) throw FileError("Cannot read '" + path + "': " + std::strerror(errno) + ".");
  return std::move(bytes).str();
}

}  // namespace

TopoDS_Shape read_shape(const std::string& path) {
  const std::string bytes = read_bytes(path);
  const std::string head = bytes.substr(0, 1024);
  const auto contains = [&](const char* text) { return head.find(text) != std::string::npos; };
  const SilentMessenger silence;
  const TopoDS_Shape shape = across_boundary<FileError>("Cannot read '" + path + "'", [&]() -> TopoDS_Shape {
    if (contains("ISO-10303-21")) return read_step(bytes, path);
    if (contains("Open CASCADE Topology V")) return read_binary_brep(bytes, path);
    if (contains("CASCADE Topology V")) return read_text_brep(bytes, path);
    throw FileError("'" + path + "' is neither BREP (text or binary) nor STEP" + (bytes.empty() ? ": it is empty." : "."));
  });
  if (shape.IsNull()) throw FileError("'" + path + "' holds an empty shape.");
  return shape;
}

}  // namespace starcell::cad
