#include "certificate/certificate.h"

namespace starcell {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::exact: return "exact";
    case Verdict::contact: return "contact";
    case Verdict::unresolved: return "unresolved";
  }
  return "unresolved";
}

}  // namespace starcell
