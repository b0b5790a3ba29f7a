#pragma once

#include <stdexcept>
#include <string>

namespace tourmaline {

/// What ends a run and is told to the user as one paragraph. All ranks throw the same.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What the user asked for is wrong: exit status 2. The text is one paragraph: where, what was
/// given, what is allowed.
struct CaseError : Error {
  using Error::Error;
};

/// The solve failed: exit status 3. The text says at which time, why, and what to try.
struct SolveError : Error {
  using Error::Error;
};

/// No state of the contact was found; a shorter step may lead to one.
struct UnsettledStep : SolveError {
  using SolveError::SolveError;
};

/// The machine failed (disk full, no permission, no memory): exit status 4.
struct MachineError : Error {
  using Error::Error;
};

/// SIGHUP, SIGINT or SIGTERM ended a run between two steps: exit status 128 + the signal's number.
struct Stopped : Error {
  Stopped(const std::string &text, int by) : Error(text), signal(by) {}
  int signal;
};

}  // namespace tourmaline
