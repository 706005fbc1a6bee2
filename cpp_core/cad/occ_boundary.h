// The border between OpenCASCADE's exceptions and ours: Standard_Failure is no std::exception, and must not leave cad/.
#pragma once

#include <Standard_Failure.hxx>
#include <string>

namespace starcell::cad {

/// Runs `work`; an OpenCASCADE failure becomes an `ErrorType` whose message starts with `doing`.
template <class ErrorType, class Work>
auto across_boundary(const std::string& doing, Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const Standard_Failure& failure) {
    const char* message = failure.GetMessageString();
    std::string reason = failure.DynamicType()->Name();
    if (message && *message) reason += std::string(", ") + message;
    throw ErrorType(doing + ": OpenCASCADE reports " + reason + ".");
  }
}

}  // namespace starcell::cad
