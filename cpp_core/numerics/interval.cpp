#include "numerics/interval.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace starcell {

// Out of line on purpose: compilers move plain arithmetic across a built-in that sets the mode, but not across a call. Doubles
// are done in SSE registers here; fesetround would set the x87 unit's mode too, which takes several times as long.
#if defined(__x86_64__)

Rounding::Rounding() : before_(_mm_getcsr()) {
  if ((before_ & _MM_ROUND_MASK) != _MM_ROUND_UP) _mm_setcsr((before_ & ~static_cast<unsigned>(_MM_ROUND_MASK)) | _MM_ROUND_UP);
}

Rounding::~Rounding() {
  if ((before_ & _MM_ROUND_MASK) != _MM_ROUND_UP) _mm_setcsr((_mm_getcsr() & ~static_cast<unsigned>(_MM_ROUND_MASK)) | (before_ & _MM_ROUND_MASK));
}

#else

Rounding::Rounding() : before_(static_cast<unsigned>(std::fegetround())) { std::fesetround(FE_UPWARD); }

Rounding::~Rounding() { std::fesetround(static_cast<int>(before_)); }

#endif

}  // namespace starcell
