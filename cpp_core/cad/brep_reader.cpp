#include "cad/brep_reader.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <BinTools_LocationSet.hxx>
#include <BinTools_ShapeSet.hxx>
#include <sstream>

#include "cad/well_formed.h"
#include "solids/errors.h"

namespace starcell::cad {
namespace {

struct Selection {
  int shape = 0, location = 0, orientation = 0;
};

Selection read_selection(std::istringstream& stream, int shapes, const std::string& path) {
  const auto start = stream.tellg();
  stream.seekg(0, std::ios::end);
  const auto left = stream.tellg() - start;
  stream.seekg(start);
  Selection chosen;
  if (left == 9) {  // BinTools::Write
    chosen.orientation = stream.get();
    BinTools::GetInteger(stream, chosen.shape);
    BinTools::GetInteger(stream, chosen.location);
    chosen.shape = shapes - chosen.shape + 1;
  } else if (left == 12) {  // FreeCAD's exportBinary
    BinTools::GetInteger(stream, chosen.shape);
    BinTools::GetInteger(stream, chosen.location);
    BinTools::GetInteger(stream, chosen.orientation);
  } else {
    throw FileError("'" + path + "' ends with " + std::to_string(left) +
                    " bytes after its shapes, where binary BREP has 9 or FreeCAD's variant 12: it is damaged.");
  }
  return chosen;
}

TopoDS_Shape well_formed(const TopoDS_Shape& shape, const std::string& path) {
  if (const std::string defect = malformation(shape); !defect.empty())
    throw FileError("'" + path + "' is damaged: it holds " + defect + ".");
  return shape;
}

}  // namespace

TopoDS_Shape read_text_brep(const std::string& bytes, const std::string& path) {
  std::istringstream stream(bytes + "\n\n");  // so that only reading past the last word meets the end
  stream.exceptions(std::ios::eofbit | std::ios::failbit | std::ios::badbit);
  TopoDS_Shape shape;
  try {
    BRepTools::Read(shape, stream, BRep_Builder());
  } catch (const std::ios::failure&) {
    throw FileError("'" + path + "' is cut short or damaged: its BREP text breaks off in the middle of a shape.");
  }
  if (shape.IsNull()) throw FileError("'" + path + "' is damaged: its BREP text holds no shape.");
  return well_formed(shape, path);
}

TopoDS_Shape read_binary_brep(const std::string& bytes, const std::string& path) {
  std::istringstream stream(bytes);
  BinTools_ShapeSet set;
  set.Read(stream);
  if (!stream || set.NbShapes() == 0)
    throw FileError("'" + path + "' is cut short or damaged: its binary BREP holds no shape.");
  const Selection chosen = read_selection(stream, set.NbShapes(), path);
  if (chosen.shape < 1 || chosen.shape > set.NbShapes() || chosen.location < 0 ||
      chosen.location > set.Locations().NbLocations() || chosen.orientation < TopAbs_FORWARD ||
      chosen.orientation > TopAbs_EXTERNAL)
    throw FileError("'" + path + "' names shape " + std::to_string(chosen.shape) + " at location " +
                    std::to_string(chosen.location) + ", which it does not contain: it is damaged.");
  TopoDS_Shape shape = set.Shape(chosen.shape);
  shape.Location(set.Locations().Location(chosen.location), Standard_False);
  shape.Orientation(static_cast<TopAbs_Orientation>(chosen.orientation));
  return well_formed(shape, path);
}

}  // namespace starcell::cad
