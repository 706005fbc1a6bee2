// Whether a shape that was read is one at all: what OpenCASCADE's algorithms take for granted and its readers do not check.
//
// Checks, everywhere in the shape: no null parts; orientations among the four; parts of a lower dimension than the
// whole (compounds may hold anything but themselves); faces with a surface; edges with a curve in space, or degenerated,
// or with a curve on a surface; finite points.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace starcell::cad {

/// The first defect as a sentence part ("a face without a surface"); empty if there is none.
std::string malformation(const TopoDS_Shape& shape);

}  // namespace starcell::cad
