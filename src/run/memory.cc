#include "run/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case/electrodes.h"
#include "case/holding.h"
#include "parallel/available_memory.h"
#include "parallel/ranks.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

namespace {

constexpr double program = 190e6;  // the libraries, before any case

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

// Nodes that a node shares cells with, itself among them: the mean of a regular mesh.
double neighbours(const casefile::MeshCase &mesh) {
  using casefile::CellShape;
  const bool linear = mesh.degree == 1;
  switch (casefile::shape_of(mesh)) {
    case CellShape::triangle:
      return linear ? 7 : 11.5;
    case CellShape::quadrilateral:
      return linear ? 9 : 16;
    case CellShape::tetrahedron:
      return linear ? 15 : 29;
    case CellShape::hexahedron:
      return linear ? 27 : 64;
  }
  return 0;
}

}  // namespace

double factorised_memory(const casefile::Case &asked) {
  const double unknowns = nodes_of(asked.mesh) * (asked.dimension + 2);
  return program + (asked.dimension == 2 ? unknowns * (440 + 115 * std::log2(unknowns))
                                         : 310 * std::pow(unknowns, 4. / 3));
}

double another_factorisation(const casefile::Case &asked) {
  return factorised_memory(asked) - program;
}

double iterative_memory(const casefile::Case &asked) {
  const double unknowns_of_a_node = asked.dimension + 2,
               of_mesh = asked.dimension == 2 ? 1250 : 2100;
  return program + nodes_of(asked.mesh) * unknowns_of_a_node *
                       (of_mesh + 32.5 * unknowns_of_a_node * neighbours(asked.mesh));
}

bool solves_iteratively(const casefile::Case &asked) {
  if (asked.solver.method != "condensed" || asked.solver.body == "direct")
    return false;
  const bool too_large = asked.dimension == 3 && casefile::all_voltages_given(asked) &&
                         casefile::left_to_contact(asked).empty() &&
                         factorised_memory(asked) > parallel::available_memory().bytes / 2;
  return asked.solver.body == "iterative" || parallel::from_first(too_large) != 0;
}

bool may_be_factorised(const casefile::Case &asked) {
  const bool has_memory = factorised_memory(asked) <= parallel::available_memory().bytes;
  return asked.solver.body == "automatic" && parallel::from_first(has_memory) != 0;
}

void require_memory(const casefile::Case &asked) {
  const double needed =
      solves_iteratively(asked) ? iterative_memory(asked) : factorised_memory(asked);
  const parallel::AvailableMemory available = parallel::available_memory();
  // Of a limited process the program's own part is in use already.
  const double more = available.is_limited ? needed - program : needed;
  if (more <= available.bytes)
    return;
  const std::string text =
      fmt::format("{}: [mesh] this mesh needs about {:.3g} GiB of memory, {} {:.3g} GiB",
                  asked.source, more / (1 << 30), available.words, available.bytes / (1 << 30));
  if (available.is_limited)
    throw MachineError(text + "; raise the limit or take fewer cells");
  throw CaseError(text + "; take fewer cells");
}

}  // namespace tourmaline::run
