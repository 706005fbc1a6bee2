#include "cad/cad_import.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "cad/occ_boundary.h"
#include "cad/recognition.h"
#include "cad/shape_import.h"
#include "cad/shape_reader.h"
#include "cad/solid_import.h"
#include "cad/solid_parts.h"
#include "solids/errors.h"

namespace starcell {
namespace {

void require_positive(double error) {
  if (!(error > 0))
    throw std::invalid_argument("error must be positive (infinity for the topology only), not " + std::to_string(error) +
                                ".");
}

}  // namespace

Expression import_shape(const TopoDS_Shape& shape, const std::string& name, double error, Curved curved) {
  require_positive(error);
  return cad::across_boundary<InvalidSolidError>("Cannot import '" + name + "'", [&] {
    if (shape.IsNull()) throw InvalidSolidError("'" + name + "' is an empty shape.");
    std::vector<Expression> leaves;
    for (const cad::SolidPart& part : cad::solid_parts(shape, name)) {
      if (CurvedSolidPtr round = curved == Curved::recognised ? cad::recognise(part.solid) : nullptr)
        leaves.emplace_back(std::move(round));
      else
        leaves.emplace_back(cad::import_solid(part, error));
    }
    return leaves.size() == 1 ? leaves.front() : Expression::set_union(leaves);
  });
}

Expression read_cad(const std::string& path, double error, Curved curved) {
  require_positive(error);
  return import_shape(cad::read_shape(path), std::filesystem::path(path).stem().string(), error, curved);
}

}  // namespace starcell
