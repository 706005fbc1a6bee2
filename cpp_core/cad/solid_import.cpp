#include "cad/solid_import.h"

#include <BRepBndLib.hxx>
#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <cmath>
#include <limits>
#include <sstream>

#include "cad/consistency.h"
#include "cad/deflection.h"
#include "cad/edge_deflection.h"
#include "cad/face_refinement.h"
#include "cad/stitching.h"
#include "solids/errors.h"

namespace starcell::cad {
namespace {

constexpr int attempts = 6;
constexpr double finest_length = 1e-7;  ///< OpenCASCADE's own resolution (Precision::Confusion)
constexpr double largest_size = 1e10;   ///< beyond, coordinates have no digits left for the details
constexpr double most_triangles = 5e5;  ///< a solid; OpenCASCADE's mesher takes minutes for more

std::string number(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

double size_of(const SolidPart& part) {
  Bnd_Box box;
  BRepBndLib::Add(part.solid, box, Standard_False);
  if (box.IsVoid()) throw InvalidSolidError("'" + part.name + "' has no extent.");
  const double size = std::sqrt(box.SquareExtent());
  if (box.IsOpen() || !(size < largest_size))
    throw InvalidSolidError("'" + part.name + "' is unbounded: a face has no boundary or reaches beyond " +
                            number(largest_size) + ".");
  return size;
}

std::size_t triangles_at(const TopoDS_Solid& solid, double length) {
  std::size_t triangles = 0;
  for (const FaceMesh& face : mesh_faces(solid, {length, 0.5}))
    if (!face.triangulation.IsNull()) triangles += static_cast<std::size_t>(face.triangulation->NbTriangles());
  return triangles;
}

/// OpenCASCADE's mesher cannot be stopped: two coarse meshes tell how the number of triangles grows.
void require_affordable(const SolidPart& part, double size, double length, double error) {
  const double coarse = size / 500, fine = size / 2000;
  if (length > fine / 5) return;
  const double few = static_cast<double>(triangles_at(part.solid, coarse));
  const double more = static_cast<double>(triangles_at(part.solid, fine));
  const double growth = few > 0 && more > few ? std::min(std::log(more / few) / std::log(coarse / fine), 1.0) : 0;
  const double expected = more * std::pow(fine / length, growth);
  if (expected > most_triangles)
    throw InvalidSolidError("'" + part.name + "' would need about " + number(expected) + " triangles at error " +
                            number(error) + ", more than " + number(most_triangles) + ": raise the error.");
}

std::string too_far(const Deflection& measured, const TopoDS_Solid& solid, double error) {
  const double gap = std::max(BRep_Tool::MaxTolerance(solid, TopAbs_EDGE), BRep_Tool::MaxTolerance(solid, TopAbs_VERTEX));
  std::string text = "its triangles are still " + number(measured.value) + " away from " + measured.where +
                     ", where half of the error " + number(error) + " is allowed";
  if (gap > 0.1 * measured.value) text += " (the model's own faces and edges only meet within " + number(gap) + ")";
  return text;
}

}  // namespace

PolyhedronPtr import_solid(const SolidPart& part, double error) {
  const double size = size_of(part);
  const TopoDS_Solid& solid = part.solid;
  BRepLib::BuildCurves3d(solid);
  if (const std::string defect = inconsistency(solid, size); !defect.empty())
    throw InvalidSolidError("'" + part.name + "' is damaged: " + defect + ".");
  Resolution resolution{std::isfinite(error) ? error / 3 : size / 100, 0.5};
  resolution.length = std::clamp(resolution.length, finest_length, std::max(size / 20, finest_length));
  require_affordable(part, size, resolution.length, error);
  std::string reason;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0, idle = 0; i < attempts; ++i) {
    double shrink = 0.5, narrow = 1;
    try {
      std::vector<FaceMesh> faces = mesh_faces(solid, resolution);
      if (std::isfinite(error))
        for (FaceMesh& face : faces) refine(face, 0.9 * error / 2 / sampling_margin);
      StitchedMesh mesh = stitch(faces);
      const Deflection deflection = measure_deflection(faces, mesh);
      if (deflection.value <= error / 2) {
        Provenance provenance{part.name, deflection.value, std::move(mesh.cad_face)};
        return Polyhedron::make(std::move(mesh.vertices), std::move(mesh.triangles), std::move(provenance));
      }
      reason = too_far(deflection, solid, error);
      idle = deflection.value > 0.9 * nearest ? idle + 1 : 0;
      if (idle == 2 || static_cast<double>(mesh.triangles.size()) > most_triangles) break;  // finer does not help
      if (idle > 0) narrow = 0.5;
      nearest = std::min(nearest, deflection.value);
      shrink = std::clamp(0.4 * error / deflection.value, 0.25, 0.6);
    } catch (const InvalidSolidError& invalid) {
      reason = invalid.what();
      narrow = 0.5;
    }
    resolution = {std::max(resolution.length * shrink, finest_length), resolution.angle * narrow};
  }
  throw InvalidSolidError("'" + part.name + "' (" + describe(part.solid) +
                          ") cannot be made a watertight mesh, tried down to deflection " + number(resolution.length) +
                          ": " + reason + (reason.ends_with('.') ? "" : "."));
}

}  // namespace starcell::cad
