#pragma once

#include <stdexcept>
#include <string>

namespace tourmaline {

/// What the user asked for is wrong: exit status 2. The text is one paragraph: where, what was
/// given, what is allowed.
struct CaseError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The solve failed: exit status 3. The text says at which time, why, and what to try.
struct SolveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The machine failed (disk full, no permission, no memory): exit status 4.
struct MachineError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace tourmaline
