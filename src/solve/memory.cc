#include "tourmaline/solve/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "tourmaline/error.h"
#include "tourmaline/parallel/ranks.h"

namespace tourmaline::solve {

namespace {

constexpr double program = 190e6;  // the libraries, before any case

double available_on_system() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  for (double kilobytes; file >> key >> kilobytes; std::getline(file, unit))
    if (key == "MemAvailable:")
      return 1024 * kilobytes;
  return std::numeric_limits<double>::infinity();
}

double nodes_of(const casefile::MeshCase &mesh) {
  // Degree 2 puts nodes where a mesh refined once has its vertices: 2^dim times as many.
  if (mesh.content)
    return static_cast<double>(mesh.content->points.size()) *
           std::pow(mesh.degree, mesh.content->dimension);
  double nodes = 1;
  for (const int cells : mesh.box ? mesh.box->cells : mesh.annulus->cells)
    nodes *= double(mesh.degree) * cells + 1;
  return nodes;
}

}  // namespace

double factorised_memory(const casefile::Case &asked) {
  const double unknowns = nodes_of(asked.mesh) * (asked.dimension + 2);
  return program + (asked.dimension == 2 ? unknowns * (440 + 115 * std::log2(unknowns))
                                         : 310 * std::pow(unknowns, 4. / 3));
}

double iterative_memory(const casefile::Case &asked) {
  return program + 5000 * nodes_of(asked.mesh) * (asked.dimension + 2);
}

bool solves_iteratively(const casefile::Case &asked) {
  if (asked.solver.method != "condensed" || asked.solver.body == "direct")
    return false;
  const bool too_large = asked.dimension == 3 && factorised_memory(asked) > available_memory() / 2;
  return asked.solver.body == "iterative" || parallel::from_first(too_large) != 0;
}

double available_memory() {
  rlimit limit{};
  double allowed = std::numeric_limits<double>::infinity();
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    allowed = static_cast<double>(limit.rlim_cur);
  return std::min(allowed, available_on_system());
}

void require_memory(const casefile::Case &asked) {
  const double needed =
      solves_iteratively(asked) ? iterative_memory(asked) : factorised_memory(asked);
  const double available = available_memory();
  if (needed > available)
    throw CaseError(
        fmt::format("{}: [mesh] this mesh needs about {:.3g} GiB of memory, {:.3g} GiB are "
                    "available; take fewer cells",
                    asked.source, needed / (1 << 30), available / (1 << 30)));
}

}  // namespace tourmaline::solve
