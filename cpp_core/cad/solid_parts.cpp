#include "cad/solid_parts.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>

#include "solids/errors.h"

namespace starcell::cad {
namespace {

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum outside_of = TopAbs_SHAPE) {
  int found = 0;
  for (TopExp_Explorer walk(shape, kind, outside_of); walk.More(); walk.Next()) ++found;
  return found;
}

bool bounds(const TopoDS_Shape& part) {
  return part.Orientation() == TopAbs_FORWARD || part.Orientation() == TopAbs_REVERSED;
}

/// Edges used an odd number of times by the shell's faces. A seam is used twice by its one face; poles do not count.
int free_edges(const TopoDS_Shape& shell) {
  TopTools_IndexedMapOfShape edges;
  std::vector<int> uses;
  for (TopExp_Explorer faces(shell, TopAbs_FACE); faces.More(); faces.Next()) {
    if (!bounds(faces.Current())) continue;
    for (TopExp_Explorer walk(faces.Current(), TopAbs_EDGE); walk.More(); walk.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(walk.Current());
      if (!bounds(edge) || BRep_Tool::Degenerated(edge)) continue;
      const std::size_t index = static_cast<std::size_t>(edges.Add(edge)) - 1;
      if (index >= uses.size()) uses.resize(index + 1, 0);
      ++uses[index];
    }
  }
  int odd = 0;
  for (const int n : uses) odd += n % 2;
  return odd;
}

TopoDS_Solid solid_of(const TopoDS_Shell& shell) {
  TopoDS_Solid solid;
  BRep_Builder().MakeSolid(solid);
  BRep_Builder().Add(solid, shell);
  return solid;
}

std::string plural(int n, const std::string& what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

/// Faces without a shell that share their edges two by two enclose a volume all the same.
TopoDS_Solid solid_of_loose_faces(const TopoDS_Shape& shape, const std::string& name, int faces) {
  TopoDS_Shell shell;
  BRep_Builder().MakeShell(shell);
  for (TopExp_Explorer walk(shape, TopAbs_FACE, TopAbs_SHELL); walk.More(); walk.Next())
    BRep_Builder().Add(shell, walk.Current());
  if (const int open = free_edges(shell); open > 0)
    throw InvalidSolidError("'" + name + "' (a " + describe(shape) + ") contains " + plural(faces, "face") +
                            " without a shell, with " + plural(open, "free edge") +
                            ": they bound no volume. Sew them into a solid in FreeCAD first.");
  for (TopExp_Explorer walk(shell, TopAbs_FACE); walk.More(); walk.Next())
    if (count(walk.Current(), TopAbs_EDGE) == 0)
      throw InvalidSolidError("'" + name + "' (a " + describe(shape) + ") contains a face without boundary: unbounded.");
  return solid_of(shell);
}

}  // namespace

std::string describe(const TopoDS_Shape& shape) {
  static const char* const kinds[] = {"compound", "compsolid", "solid", "shell", "face", "wire", "edge", "vertex"};
  return std::string(kinds[shape.ShapeType()]) + " of " + plural(count(shape, TopAbs_SOLID), "solid") + ", " +
         plural(count(shape, TopAbs_SHELL), "shell") + " and " + plural(count(shape, TopAbs_FACE), "face");
}

std::vector<SolidPart> solid_parts(const TopoDS_Shape& shape, const std::string& name) {
  std::vector<SolidPart> parts;
  for (TopExp_Explorer walk(shape, TopAbs_SOLID); walk.More(); walk.Next())
    if (count(walk.Current(), TopAbs_FACE) > 0) parts.push_back({TopoDS::Solid(walk.Current()), ""});
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (const int open = free_edges(parts[i].solid); open > 0)
      throw InvalidSolidError("'" + name + "': solid " + std::to_string(i + 1) + " of " + std::to_string(parts.size()) +
                              " is open: " + plural(open, "free edge") + " among its " +
                              plural(count(parts[i].solid, TopAbs_FACE), "face") +
                              ". Repair it in FreeCAD first (Part > Check geometry).");
  for (TopExp_Explorer walk(shape, TopAbs_SHELL, TopAbs_SOLID); walk.More(); walk.Next()) {
    const TopoDS_Shell& shell = TopoDS::Shell(walk.Current());
    if (const int open = free_edges(shell); open > 0)
      throw InvalidSolidError("'" + name + "' (a " + describe(shape) + ") contains an open shell of " +
                              plural(count(shell, TopAbs_FACE), "face") + " with " + plural(open, "free edge") +
                              ": it bounds no volume. Sew or cap it in FreeCAD (Part > Create > Shape builder).");
    parts.push_back({solid_of(shell), " (closed shell taken as a solid)"});
  }
  if (const int loose = count(shape, TopAbs_FACE, TopAbs_SHELL); loose > 0)
    parts.push_back({solid_of_loose_faces(shape, name, loose), " (closed faces taken as a solid)"});
  if (parts.empty())
    throw InvalidSolidError("'" + name + "' (a " + describe(shape) + ") contains no solid, only wires, edges or vertices.");
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i].name = (parts.size() > 1 ? name + "#" + std::to_string(i + 1) : name) + parts[i].name;
  return parts;
}

}  // namespace starcell::cad
