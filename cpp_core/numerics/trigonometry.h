// Enclosures of cosine and sine.
//
// Rests on the C library's cos() and sin(), which are right to a last digit whatever the rounding mode (glibc); four are allowed for. Sound
// only while a Rounding object is alive, as all interval arithmetic.
#pragma once

#include "numerics/interval.h"

namespace starcell {

/// Of an angle in radians.
struct Turn {
  Interval cosine, sine;
};
Turn turn_by(const Interval& angle);

}  // namespace starcell
