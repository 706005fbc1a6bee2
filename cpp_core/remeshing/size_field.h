// How long the edges about each vertex should be: as long as asked for, but no longer than the sharp edges leave room.
//
// A corner asks for edges no longer than the runs of sharp edges that end there; a vertex on a run, for edges no longer than the way to the
// nearest run that its own has no corner with (the width of a wall). From there sizes grow with the distance along edges, at a given rate, as
// in Ruppert's local feature size (1995); so triangles with good angles fit between.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "remeshing/features.h"

namespace starcell {

/// A length per vertex. `most`: the largest allowed of each; `edges`: those of the mesh; room of less than `least` limits nothing: a few thin
/// triangles there do for many small ones.
std::vector<double> sizes(const std::vector<Vec3>& places, const std::vector<std::array<std::uint32_t, 2>>& edges, const Features& features, std::vector<double> most,
                          double least);

}  // namespace starcell
