#include "run/process.h"

#include <deal.II/base/multithread_info.h>
#include <fmt/format.h>
#include <mpi.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tourmaline/error.h"

#include "krylov/body_system.h"
#include "parallel/team.h"

extern "C" void openblas_set_num_threads(int threads);

namespace tourmaline::run {

namespace {

// Started alone there is no other process to talk to: Open MPI need not fork a daemon for processes
// spawned later (0.1 s), nor look for networks (0.2 s).
void start_mpi() {
  if (!std::getenv("OMPI_COMM_WORLD_SIZE")) {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    // Isolated processes would share one session folder, and one's end removes it under another's
    // start.
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_btl", "self", 0);
  }
  MPI_Init(nullptr, nullptr);
}

pid_t owner_of_mpi = 0;

// MPI can be started only once in a process, so it runs until the end: an exit handler. Children
// that were forked have their parent's handlers, but not its MPI.
void end_mpi() {
  int ended = 0;
  MPI_Finalized(&ended);
  if (ended || getpid() != owner_of_mpi)
    return;
  krylov::finish();
  MPI_Finalize();
}

void require_mpi_not_ended() {
  int ended = 0;
  MPI_Finalized(&ended);
  if (ended)
    throw MachineError(
        "this program has ended MPI, which cannot be started twice: call MPI_Finalize after the "
        "last run, or leave MPI to the runs");
}

// Where it gets no memory for a thread OpenBLAS asks for ever, and where it gets no thread it
// raises SIGINT; of both kinds there are as many, its own and those of the factorisation, which
// call it.
void require_threads(int threads) {
  constexpr rlim_t of_blas = rlim_t{140} << 20;  // address space of a thread that has called it
  if (threads == 1)
    return;
  const parallel::Team as_many_as_can_be(2 * threads - 1);
  rlimit limit;
  const auto others = static_cast<rlim_t>(threads - 1);
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur / of_blas < 2 * others)
    throw MachineError(fmt::format(
        "solver.threads = {}: {} MiB of address space for each thread but the first are more than "
        "the limit (ulimit -v) of {} MiB; take fewer threads or raise it",
        threads, 2 * (of_blas >> 20), limit.rlim_cur >> 20));
}

}  // namespace

void start_process(int threads) {
  require_mpi_not_ended();
  int running = 0;
  MPI_Initialized(&running);
  if (!running) {
    start_mpi();
    owner_of_mpi = getpid();
    std::atexit(end_mpi);
  }
  require_threads(threads);
  openblas_set_num_threads(threads);
  // Its own loops on threads change last digits, and none of them takes long.
  dealii::MultithreadInfo::set_thread_limit(1);
}

double process_age() {
  std::ifstream stat("/proc/self/stat"), uptime("/proc/uptime");
  std::string text;
  std::getline(stat, text);
  // Field 22, counted after the program's name, which may hold spaces: the start in clock ticks
  // since boot.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  for (int field = 3; field <= 22; ++field)
    fields >> text;
  double now = 0;
  uptime >> now;
  return std::max(
      0., now - std::strtod(text.c_str(), nullptr) / static_cast<double>(sysconf(_SC_CLK_TCK)));
}

}  // namespace tourmaline::run
