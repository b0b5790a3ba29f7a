#pragma once

#include <string>

namespace tourmaline::parallel {

/// What this process may still take, and what says so: the system, the control group that it runs
/// in (containers), or its own limit of address space (ulimit -v), whichever leaves least.
struct AvailableMemory {
  double bytes;
  bool is_limited;    ///< by less than what the system has
  std::string words;  ///< "... leaves" that many bytes
};

AvailableMemory available_memory();

/// Hands freed memory back to the system (glibc; elsewhere nothing): the allocator keeps what was
/// freed in small pieces for the next ones, and the largest arrays, which never come from there,
/// would stand beside it.
void give_back_freed_memory();

/// Throws MachineError where the limit of address space does not let Open MPI load its parts and
/// OpenBLAS take its first buffer of 128 MiB, which it would try for ever; makes it take that one.
void require_room_to_start();

}  // namespace tourmaline::parallel
