// The configurations in which the last link of a planar arm crosses the first: all three links without width.
//
// Let a, b be the heights of the last link's ends over the first one's line, c, d those of the first one's over the last one's line. The links cross if a b < 0
// and c d < 0. All four vanish together wherever the arm is stretched or folded flat, along lines in the space of angles; a cell about such a line, however
// small, has four surfaces through it. So crossing is said otherwise about these lines: where the links are within a right angle of one line, they cross if
// they are on different sides of each other at the two ends of what they have in common as seen along it, and which corners these ends are does not
// change as long as no corner passes another one: two surfaces, which part the neighbourhood of the line into four, two of them free. Links of
// equal length fold onto each other's ends: b or c then has a plane as a factor, along which the links touch and no more; it goes.
// Where both senses of crossing meet in such a line, the free space touches itself: a contact, which is decided by a move within the contact tolerance, as
// every one is. Crossing is made smaller by it: links that just touch at their ends may pass.
// Guarantees: the set is part of the open set of configurations in which the two links cross, each inside of the other's ends, and no point of either's boundary is
// more than `moved` from the other's. With no move: exactly that set. What only touches is not in it. (The move is told from the slopes at the places where two surfaces meet, and
// from the least slope of each; that slopes vary within a move has a fifth of it for reserve.
// A domain that cuts the set at a shallow angle, as a joint's limit may, is not looked at: along its side the two can be farther apart.)
// Does not help where the first link is exactly as long as the others together, or the second one is: the ends pass each other there.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "expression/expression.h"

namespace starcell {

struct CrossingLinks {
  Expression set;
  double moved;                  ///< in scaled angles
  std::vector<Box3> contacts;    ///< the lines, as far as they are in the domain, in which the free space touches itself
};

/// In scaled angles (moving_frame.h), over `domain`, for any number of turns; none: there are no such configurations. `move`: what may be moved.
std::optional<CrossingLinks> crossing_links(const std::array<double, 3>& lengths, double unit, const Box3& domain, double move);

}  // namespace starcell
