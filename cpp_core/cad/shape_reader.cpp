#include "cad/shape_reader.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <BinTools_ShapeSet.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cad/binary_brep.h"
#include "cad/occ_boundary.h"
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

TopoDS_Shape read_text_brep(const std::string& bytes, const std::string& path) {
  std::istringstream stream(bytes);
  TopoDS_Shape shape;
  BRepTools::Read(shape, stream, BRep_Builder());
  if (shape.IsNull()) throw FileError("'" + path + "' is cut short or damaged: its BREP text holds no shape.");
  return shape;
}

TopoDS_Shape read_step(const std::string& bytes, const std::string& path) {
  std::istringstream stream(bytes);
  STEPControl_Reader reader;
  if (reader.ReadStream(path.c_str(), stream) != IFSelect_RetDone)
    throw FileError("'" + path + "' is not a readable STEP file: its syntax is broken or it is cut short.");
  const int roots = reader.NbRootsForTransfer();
  if (roots == 0) throw FileError("'" + path + "' is a STEP file without any shape in it.");
  reader.TransferRoots();
  if (reader.NbShapes() == 0)
    throw FileError("'" + path + "': none of the " + std::to_string(roots) + " STEP shapes could be translated.");
  return reader.OneShape();
}

}  // namespace

TopoDS_Shape read_shape(const std::string& path) {
  const std::string bytes = read_bytes(path);
  const std::string head = bytes.substr(0, 1024);
  const auto starts_with = [&](const char* text) { return head.find(text) != std::string::npos; };
  const SilentMessenger silence;
  const TopoDS_Shape shape = across_boundary<FileError>("Cannot read '" + path + "'", [&]() -> TopoDS_Shape {
    if (starts_with("ISO-10303-21")) return read_step(bytes, path);
    if (starts_with("Open CASCADE Topology V")) return read_binary_brep(bytes, path);
    if (starts_with("CASCADE Topology V")) return read_text_brep(bytes, path);
    throw FileError("'" + path + "' is neither BREP (text or binary) nor STEP" +
                    (bytes.empty() ? ": it is empty." : "."));
  });
  if (shape.IsNull()) throw FileError("'" + path + "' holds an empty shape.");
  return shape;
}

}  // namespace starcell::cad
