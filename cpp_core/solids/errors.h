// The errors that StarCell throws. Each message is a sentence for the person at the screen:
// what, where, how many, what to do. Wrong arguments throw std::invalid_argument instead.
#pragma once

#include <stdexcept>
#include <string>

namespace starcell {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is not a closed, oriented, embedded 2-manifold.
class InvalidSolidError : public Error {
 public:
  using Error::Error;
};

/// The expression has no bounded result.
class UnboundedError : public Error {
 public:
  using Error::Error;
};

/// The user, or a progress callback, stopped the run.
class CancelledError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be read or written.
class FileError : public Error {
 public:
  using Error::Error;
};

}  // namespace starcell
