#include "run/contact_edges.h"

#include <fmt/format.h>

#include "contact/interface.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::run {

std::string contact_edge_warning(const casefile::Case &asked, const std::vector<Vector3> &points,
                                 std::span<const body::Node> edges) {
  if (edges.empty())
    return "";
  const Vector3 &at = points[edges.front()];
  return fmt::format(
      "{}: contacts meet at an edge, at ({:g}, {:g}, {:g}){}: a node there has the laws and the "
      "normal of the contact that stands first in the case file, and of the other none of its "
      "share of the boundary",
      asked.source, at[0], at[1], at[2],
      edges.size() > 1 ? fmt::format(" and {} further nodes", edges.size() - 1) : "");
}

namespace {

template <int dim>
std::string warning_in(const casefile::Case &asked) {
  const body::Discretisation<dim> body(mesh::build<dim>(asked), asked.mesh.degree,
                                       body::geometry_of(asked));
  std::vector<std::vector<std::string>> boundaries;
  for (const casefile::ContactCase &contact : asked.contacts)
    boundaries.push_back(contact.on);
  return contact_edge_warning(asked, body.points(), contact::interface_of(body, boundaries).edges);
}

}  // namespace

std::string contact_edge_warning(const casefile::Case &asked) {
  if (asked.contacts.size() < 2)
    return "";
  return asked.dimension == 2 ? warning_in<2>(asked) : warning_in<3>(asked);
}

}  // namespace tourmaline::run
