// Limits of the process (ulimit) that its libraries do not survive, looked at before these start:
// OpenBLAS makes threads while it is loaded and raises SIGINT, or waits forever, where it may not;
// Open MPI ends the process with words of its own where it may not open files. So this runs before
// all constructors, and uses nothing that has one.

#include "limits.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

// The sanitizer reserves terabytes, and its own start is to be the first.
#ifndef __SANITIZE_ADDRESS__

namespace {

constexpr rlim_t room = rlim_t{480} << 20;       // address space for OpenBLAS and Open MPI [bytes]
constexpr rlim_t per_thread = rlim_t{12} << 20;  // of OpenBLAS: stack and what belongs to it
constexpr rlim_t least_stack = rlim_t{1} << 20;  // MUMPS and METIS have arrays there
constexpr int files = 24;                        // that are open at once, with some to spare
constexpr int most_threads = 256;                // that are tried
constexpr rlim_t few_processes = 4096;           // a limit above is not looked at

const char *value_of(const char *name, char **environment) {
  const size_t length = strlen(name);
  for (char **entry = environment; *entry; ++entry)
    if (strncmp(*entry, name, length) == 0 && (*entry)[length] == '=')
      return *entry + length + 1;
  return nullptr;
}

// Of several ranks one speaks.
[[noreturn]] void refuse(const char *text, char **environment) {
  const char *rank = value_of("OMPI_COMM_WORLD_RANK", environment);
  if (!rank || strcmp(rank, "0") == 0) [[maybe_unused]]
    const ssize_t written = write(STDERR_FILENO, text, strlen(text));
  _exit(4);
}

// How many OpenBLAS will start beside the first one.
int threads(char **environment) {
  constexpr const char *names[] = {"OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS"};
  for (const char *name : names)
    if (const char *value = value_of(name, environment))
      if (const int number = atoi(value); number > 0)
        return number - 1;
  cpu_set_t cores;
  return sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) - 1 : 0;
}

// The pages that are mapped, the first number of the file.
rlim_t used_address_space() {
  char text[32] = "";
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0)
    return 0;
  if (read(file, text, sizeof text - 1) < 0)
    text[0] = '\0';
  close(file);
  return strtoul(text, nullptr, 10) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

bool has_address_space(int n_threads) {
  rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return true;
  return limit.rlim_cur >= used_address_space() + room + n_threads * per_thread;
}

bool has_files() {
  int open_files[files], n = 0;
  while (n < files && (open_files[n] = open("/dev/null", O_RDONLY | O_CLOEXEC)) >= 0)
    ++n;
  for (int i = 0; i < n; ++i)
    close(open_files[i]);
  return n == files;
}

bool has_stack() {
  rlimit limit;
  return getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= least_stack;
}

// Threads count as processes; only the attempt tells how many there may be.
bool has_processes(int n_threads) {
  rlimit limit;
  if (getrlimit(RLIMIT_NPROC, &limit) != 0 || limit.rlim_cur > few_processes)
    return true;
  pid_t children[most_threads];
  const int wanted = n_threads < most_threads ? n_threads + 1 : most_threads;  // one of Open MPI
  int n = 0;
  for (; n < wanted; ++n) {
    children[n] = static_cast<pid_t>(syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0));
    if (children[n] == 0)
      for (;;)
        pause();
    if (children[n] < 0)
      break;
  }
  for (int i = 0; i < n; ++i) {
    kill(children[i], SIGKILL);
    waitpid(children[i], nullptr, 0);
  }
  return n == wanted;
}

void need_processes(char **environment) {
  if (!has_processes(threads(environment)))
    refuse(
        "tourmaline: too few processes to start: Open MPI needs one thread, OpenBLAS one for each "
        "core, or as many as OPENBLAS_NUM_THREADS says; lower that or raise the limit (ulimit "
        "-u)\n",
        environment);
}

void out_of_time(int) {
  constexpr char text[] =
      "tourmaline: the limit of processor time (ulimit -t) is reached; raise it. What is written "
      "stays, and a run that has a checkpoint goes on with --resume\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(4);
}

// At the hard limit the system kills without a word, so an alarm of this process comes before.
void watch_time() {
  signal(SIGXCPU, out_of_time);
  rlimit limit;
  if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
      (limit.rlim_cur < limit.rlim_max && limit.rlim_cur > 0))
    return;
  // Recent systems kill at once then, while the libraries are being loaded; others grant a second.
  if (limit.rlim_cur == 0)
    out_of_time(SIGXCPU);
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  itimerval alarm{};
  alarm.it_value.tv_sec = static_cast<time_t>(limit.rlim_cur) - 1 - used.tv_sec;
  alarm.it_value.tv_usec = 600000 - used.tv_nsec / 2000;  // within the last second, and never 0
  signal(SIGPROF, out_of_time);
  if (alarm.it_value.tv_sec >= 0)
    setitimer(ITIMER_PROF, &alarm, nullptr);
}

void look_at_limits(int, char **, char **environment) {
  const int n_threads = threads(environment);
  if (!has_stack())
    refuse("tourmaline: not enough stack to start: 1 MiB is needed; raise the limit (ulimit -s)\n",
           environment);
  if (!has_files())
    refuse(
        "tourmaline: too few files may be open to start: 24 more than now are needed; raise the "
        "limit (ulimit -n)\n",
        environment);
  if (!has_address_space(n_threads))
    refuse(
        "tourmaline: not enough memory to start: OpenBLAS and Open MPI need 480 MiB of address "
        "space beside the program's own; raise the limit (ulimit -v)\n",
        environment);
  need_processes(environment);
  // A file that may not grow is told by who writes it, with its name.
  signal(SIGXFSZ, SIG_IGN);
  watch_time();
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const before_all)(int, char **,
                                                                       char **) = look_at_limits;

}  // namespace

void look_at_limits_of_copy(char **environment) {
  need_processes(environment);
  watch_time();
}

#else

void look_at_limits_of_copy(char **) {}

#endif
