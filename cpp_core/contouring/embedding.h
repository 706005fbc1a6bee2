// Exact tests that triangles do not meet, on the coordinates as they are and as float32.
#pragma once

#include <functional>

#include "contouring/surface_mesh.h"

namespace starcell {

/// Two triangles that meet outside shared vertices and edges; twice the same: it has no area.
using MeetingPair = std::pair<std::uint32_t, std::uint32_t>;

/// Asked now and then, from one thread at a time: false to stop. Empty: never.
using GoOn = std::function<bool()>;

/// Which coordinates are rounded to float32: bit k stands for axis k.
using RoundedAxes = int;
constexpr RoundedAxes no_axis = 0, all_axes = 7;
/// All coordinates, and each alone: compilers drop roundings now and then (g++ 12 does), and a gap that depends on all three
/// being done is none.
inline const std::vector<RoundedAxes> every_rounding{all_axes, 1, 2, 4};

/// For each rounding all pairs that meet, ascending. Throws CancelledError.
std::vector<std::vector<MeetingPair>> meeting_pairs(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                                    const std::vector<RoundedAxes>& roundings, const GoOn& go_on = {});

/// The triangles of such pairs, ascending.
std::vector<std::uint32_t> triangles_of(const std::vector<MeetingPair>& pairs);

/// Has `fresh` no area, or does it meet the other, in any rounding? Of an other without area it is not asked.
bool meets_once_rounded(const std::vector<Vec3>& vertices, const Triangle& fresh, const Triangle& other);

/// Does any triangle of one fan meet one of the other? Both index `vertices`; they share no vertex. `rounded_too`: also once
/// rounded to float32.
bool fans_meet(const std::vector<Vec3>& vertices, const Triangle* a, std::size_t count_a, const Triangle* b,
               std::size_t count_b, bool rounded_too = true);

/// Does any triangle of a sheet meet another of it outside shared vertices and edges?
bool sheet_folds(const std::vector<Vec3>& vertices, const Triangle* triangles, std::size_t count, bool rounded_too = true);

}  // namespace starcell
