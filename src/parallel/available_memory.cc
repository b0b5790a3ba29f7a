#include "parallel/available_memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "tourmaline/error.h"

// As Eigen declares it.
extern "C" int dgemm_(const char *, const char *, const int *, const int *, const int *,
                      const double *, const double *, const int *, const double *, const int *,
                      const double *, double *, const int *);

namespace tourmaline::parallel {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

// The number behind a word in a file such as /proc/meminfo.
double number_after(const std::string &word, const std::string &file) {
  std::ifstream lines(file);
  std::string key, rest;
  for (double number; lines >> key >> number; std::getline(lines, rest))
    if (key == word)
      return number;
  return unlimited;
}

double number_in(const std::string &file) {
  std::ifstream in(file);
  double number = 0;
  return in >> number ? number : unlimited;  // "max"
}

// A group's limit less what is in use; the file cache is given back when it is wanted.
double left_by_group(const std::string &limit, const std::string &use, const std::string &cache,
                     const std::string &folder) {
  const double most = number_in(folder + limit), used = number_in(folder + use);
  if (most == unlimited || used == unlimited)
    return unlimited;
  const double given_back = number_after(cache, folder + "memory.stat");
  return most - used + (given_back == unlimited ? 0 : given_back);
}

// Both versions of control groups, the process's own one and, as seen in a container, the root.
double left_by_groups() {
  double left = unlimited;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::string path = line.substr(std::min(line.size(), line.rfind(':') + 1));
    for (const std::string &at : {path, std::string()}) {
      if (line.rfind("0::", 0) == 0)
        left = std::min(left, left_by_group("memory.max", "memory.current", "inactive_file",
                                            "/sys/fs/cgroup" + at + "/"));
      else if (line.find(":memory:") != std::string::npos)
        left = std::min(left,
                        left_by_group("memory.limit_in_bytes", "memory.usage_in_bytes",
                                      "total_inactive_file", "/sys/fs/cgroup/memory" + at + "/"));
    }
  }
  return left;
}

double left_by_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return unlimited;
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

AvailableMemory available_memory() {
  const AvailableMemory all[] = {
      {1024 * number_after("MemAvailable:", "/proc/meminfo"), false, "this machine has"},
      {left_by_groups(), true, "the memory limit of the container (control group) leaves"},
      {left_by_address_space(), true, "the limit of address space (ulimit -v) leaves"}};
  return *std::min_element(std::begin(all), std::end(all),
                           [](const auto &a, const auto &b) { return a.bytes < b.bytes; });
}

void require_room_to_start() {
  constexpr std::size_t room = 320UL << 20;
  void *trial = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (trial == MAP_FAILED)
    throw MachineError(
        "not enough memory to start: OpenBLAS and Open MPI need 320 MiB of address space beside "
        "the program's own; raise the limit (ulimit -v, or -d)");
  munmap(trial, room);
  const int n = 1;
  const double one = 1;
  double product = 0;
  dgemm_("N", "N", &n, &n, &n, &one, &one, &n, &one, &n, &one, &product, &n);
}

void give_back_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace tourmaline::parallel
