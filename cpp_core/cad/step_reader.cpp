#include "cad/step_reader.h"

#include <IFSelect_ReturnStatus.hxx>
#include <Interface_Check.hxx>
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <sstream>

#include "solids/errors.h"

namespace starcell::cad {
namespace {

bool shapes_the_model(const std::string& type) {
  if (type == "StepRepr_DefinitionalRepresentation") return true;  // the curve of an edge on its face
  return (type.starts_with("StepGeom_") || type.starts_with("StepShape_")) && !type.ends_with("Representation");
}

bool only_a_name(const std::string& complaint) { return complaint.find("(name) not a quoted String") != std::string::npos; }

bool breaks_the_text(const std::string& complaint) {
  return complaint.find("Undefined Parsing") != std::string::npos ||
         complaint.find("Unresolved Reference") != std::string::npos;
}

/// The first broken line, dangling reference, or unreadable parameter of an entity that the translation would rely on;
/// empty if there is none.
std::string first_defect(const StepData_StepModel& model) {
  const Handle(Interface_Check) file = model.GlobalCheck(Standard_True);
  for (int k = 1; k <= file->NbFails(); ++k)
    if (const std::string complaint = file->CFail(k); breaks_the_text(complaint)) return complaint;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const std::string type = model.Value(i)->DynamicType()->Name();
    if (!shapes_the_model(type)) continue;
    const Handle(Interface_Check) check = model.Check(i, Standard_True);
    for (int k = 1; k <= check->NbFails(); ++k)
      if (const std::string complaint = check->CFail(k); !only_a_name(complaint)) return type + ": " + complaint;
  }
  return {};
}

}  // namespace

TopoDS_Shape read_step(const std::string& bytes, const std::string& path) {
  std::istringstream stream(bytes);
  STEPControl_Reader reader;
  if (reader.ReadStream(path.c_str(), stream) != IFSelect_RetDone || reader.StepModel().IsNull())
    throw FileError("'" + path + "' is not a readable STEP file: its syntax is broken or it is cut short.");
  if (const std::string defect = first_defect(*reader.StepModel()); !defect.empty())
    throw FileError("'" + path + "' is damaged (" + defect + ").");
  const int roots = reader.NbRootsForTransfer();
  if (roots == 0) throw FileError("'" + path + "' is a STEP file without any shape in it.");
  reader.TransferRoots();
  if (reader.NbShapes() == 0)
    throw FileError("'" + path + "': none of the " + std::to_string(roots) + " STEP shapes could be translated.");
  return reader.OneShape();
}

}  // namespace starcell::cad
