// The distance between an edge's chords and what they stand for: its curve in space, and the strip of a curved face
// between its curve and its chords. Samples, see deflection.h for what they are worth.
// The arc over a chord joins the chord's ends, so its shadow covers the chord: arc to chord bounds chord to arc, too.
#pragma once

#include <vector>

#include "cad/stitching.h"

namespace starcell::cad {

bool is_straight(const TopoDS_Edge& edge);

double curve_deflection(const EdgeNodes& edge, const std::vector<Vec3>& vertices);

/// `edge` is oriented as in the face (a seam has two parameter curves); `elementary`: the face's surface is one.
double strip_deflection(const TopoDS_Edge& edge, const EdgeNodes& nodes, const FaceMesh& face, bool elementary,
                        const std::vector<Vec3>& vertices);

/// Samples are multiplied by this where no closed form makes them exact.
constexpr double sampling_margin = 1.25;

}  // namespace starcell::cad
