// CAD files to solids: the door of the folder cad/, the only header of it that anyone else includes.
//
// Computes: one leaf a solid, the union of them if there are several. A solid that is one ball, cylinder, cone or torus is
// that curved solid itself (recognition.h); any other is a watertight polyhedron with the measured two-sided distance to the
// CAD shape in its Provenance (deflection.h says how it is measured).
// Rests on OpenCASCADE 7.6 for reading and for triangulating single faces; the stitching (stitching.h) is ours.
// Guarantees: polyhedra passed Polyhedron::make, and their measured deflection is at most error / 2; solids whose
// faces are planes between straight lines keep exactly their vertices and have deflection 0; same file, same bytes.
// Does not guarantee: that the CAD model is what its author meant. Nothing is healed or sewn: what is not a closed
// solid is refused with the reason, except that a closed shell without a solid is taken as one, and its name says so.
#pragma once

#include <string>

#include "expression/expression.h"

namespace starcell {

/// Whether whole balls, cylinders, cones and tori become such, or polyhedra that know their faces like all other solids.
enum class Curved { recognised, tessellated };

/// Reads .brep, .brp (text or binary), .bin (FreeCAD's exportBinary or BinTools), .step and .stp. `error` is the
/// budget in model units (mm for STEP); infinity asks for the topology only.
/// Throws FileError, InvalidSolidError, std::invalid_argument for an error that is not positive.
Expression read_cad(const std::string& path, double error, Curved curved = Curved::recognised);

}  // namespace starcell
