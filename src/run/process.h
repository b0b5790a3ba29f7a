#pragma once

namespace tourmaline::run {

/// Starts MPI, unless it runs, until the process ends (MUMPS needs it even on one rank), and sets
/// the number of threads of OpenBLAS and deal.II. Throws MachineError when MPI has been ended, as
/// it cannot be started again.
void start_process(int threads);

/// Seconds since the operating system started this process, to a hundredth; loading the libraries
/// included.
double process_age();

}  // namespace tourmaline::run
