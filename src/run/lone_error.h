#pragma once

#include "tourmaline/error.h"

namespace tourmaline::run {

/// Call it with an error that may be this rank's alone. Returns where all ranks have come here with
/// one of theirs, or there is but one rank. Otherwise the others would wait for this one for ever:
/// it tells the error and ends all ranks with its exit status.
void require_error_of_all(const Error &error);

}  // namespace tourmaline::run
