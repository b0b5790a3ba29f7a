#include "run/lone_error.h"

#include <chrono>
#include <iostream>

#include "parallel/ranks.h"

namespace tourmaline::run {

namespace {

// Ranks do the same work between two sums; how far apart they are depends on the machine's other
// work.
constexpr std::chrono::seconds patience{10};

int exit_status(const Error &error) {
  if (dynamic_cast<const CaseError *>(&error))
    return 2;
  if (dynamic_cast<const SolveError *>(&error))
    return 3;
  const auto *stopped = dynamic_cast<const Stopped *>(&error);
  return stopped ? 128 + stopped->signal : 4;
}

}  // namespace

void require_error_of_all(const Error &error) {
  if (parallel::all_come(patience))
    return;
  std::cerr << "tourmaline: on rank " << parallel::rank() << " of " << parallel::n_ranks() << ": "
            << error.what() << "; other ranks have no such error\n";
  parallel::end_all(exit_status(error));
}

}  // namespace tourmaline::run
