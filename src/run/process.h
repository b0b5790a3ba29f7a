#pragma once

namespace tourmaline::run {

/// MPI for as long as it lives, and the number of threads of OpenBLAS and deal.II. MUMPS needs MPI
/// even on one rank.
class Process {
 public:
  explicit Process(int threads);
  ~Process();
  Process(const Process &) = delete;
  Process &operator=(const Process &) = delete;

 private:
  bool owns_mpi_ = false;
};

/// Seconds since the operating system started this process, to a hundredth; loading the libraries
/// included.
double process_age();

}  // namespace tourmaline::run
