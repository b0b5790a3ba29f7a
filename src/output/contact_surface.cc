#include "output/contact_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "output/atomic_file.h"
#include "output/vtu_elements.h"

namespace tourmaline::output {

ContactFacets contact_facets(const std::vector<NamedBoundary> &boundaries,
                             std::span<const std::string> names,
                             std::span<const std::uint32_t> nodes) {
  ContactFacets facets;
  for (const NamedBoundary &boundary : boundaries)
    if (std::find(names.begin(), names.end(), boundary.name) != names.end())
      facets.insert(facets.end(), boundary.facets.begin(), boundary.facets.end());
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  for (std::vector<std::uint32_t> &facet : facets)
    for (std::uint32_t &node : facet) {
      const auto row = std::lower_bound(nodes.begin(), nodes.end(), node);
      if (row == nodes.end() || *row != node)
        throw std::invalid_argument(fmt::format("node {} of the contact has no row", node));
      node = static_cast<std::uint32_t>(row - nodes.begin());
    }
  return facets;
}

namespace {

/// VTK's number of a facet.
std::uint8_t vtk_type(int dimension, std::size_t n_nodes) {
  constexpr std::uint8_t line = 3, quadratic_line = 21, triangle = 5, quadrilateral = 9,
                         quadratic_triangle = 22, biquadratic_quadrilateral = 28;
  if (dimension == 2 && (n_nodes == 2 || n_nodes == 3))
    return n_nodes == 2 ? line : quadratic_line;
  switch (dimension == 3 ? n_nodes : 0) {
    case 3:
      return triangle;
    case 4:
      return quadrilateral;
    case 6:
      return quadratic_triangle;
    case 9:
      return biquadratic_quadrilateral;
    default:
      throw std::invalid_argument(fmt::format("in {}D no facet has {} nodes", dimension, n_nodes));
  }
}

/// Appends the nodes as VTK wants them: a line's middle node behind its ends.
void append_in_vtk_order(std::vector<std::int64_t> &nodes, int dimension,
                         const std::vector<std::uint32_t> &facet) {
  nodes.insert(nodes.end(), facet.begin(), facet.end());
  if (dimension == 2 && facet.size() == 3)
    std::swap(*(nodes.end() - 2), nodes.back());
}

template <class Of>
std::string array(const std::string &name, std::span<const ContactRow> rows, Of of) {
  std::vector<std::decay_t<std::invoke_result_t<Of, const ContactRow &>>> values;
  values.reserve(rows.size());
  for (const ContactRow &row : rows)
    values.push_back(std::invoke(of, row));
  return field(name, values, rows.size());
}

std::string arrays(std::span<const ContactRow> rows) {
  std::string text =
      array("normal_traction", rows, &ContactRow::normal_traction) +
      array("tangential_traction", rows, &ContactRow::tangential_traction) +
      array("normal_displacement", rows, &ContactRow::normal_displacement) +
      array("slip", rows, &ContactRow::slip) + array("slip_rate", rows, &ContactRow::slip_rate) +
      array("status", rows,
            [](const ContactRow &row) { return static_cast<std::uint8_t>(row.status); }) +
      array("temperature", rows, &ContactRow::temperature) +
      array("potential", rows, &ContactRow::potential) +
      array("heat_flux", rows, &ContactRow::heat_flux) + array("gap", rows, &ContactRow::gap) +
      array("charge_flux", rows, &ContactRow::charge_flux);
  for (std::size_t i = 0; !rows.empty() && i < rows.front().quantities.size(); ++i)
    text += array(rows.front().quantities[i].first, rows,
                  [i](const ContactRow &row) { return row.quantities[i].second; });
  if (!rows.empty() && !rows.front().contact.empty())
    text += array("contact", rows, &ContactRow::contact_number);
  return text;
}

}  // namespace

ContactSurface::ContactSurface(int dimension, std::span<const ContactRow> rows,
                               const ContactFacets &facets)
    : n_points_(rows.size()), n_cells_(facets.size()) {
  std::vector<Vector3> points;
  for (const ContactRow &row : rows)
    points.push_back(row.point);
  std::vector<std::int64_t> nodes, ends;
  std::vector<std::uint8_t> types;
  for (const std::vector<std::uint32_t> &facet : facets) {
    if (std::any_of(facet.begin(), facet.end(),
                    [&](std::uint32_t row) { return row >= n_points_; }))
      throw std::invalid_argument("a facet of the contact refers to a row that there is not");
    types.push_back(vtk_type(dimension, facet.size()));
    append_in_vtk_order(nodes, dimension, facet);
    ends.push_back(static_cast<std::int64_t>(nodes.size()));
  }
  topology_ = points_element(points) + cells_element(nodes, ends, types);
}

void ContactSurface::write(const std::filesystem::path &path, double time,
                           std::span<const ContactRow> rows) const {
  if (rows.size() != n_points_)
    throw std::invalid_argument(
        fmt::format("{} rows for {} points of the contact", rows.size(), n_points_));
  AtomicFile file(path);
  file.append(vtu_opening(time, n_points_, n_cells_));
  file.append("<PointData Scalars=\"normal_traction\" Vectors=\"tangential_traction\">\n");
  file.append(arrays(rows));
  file.append("</PointData>\n");
  file.append(topology_);
  file.append(vtu_closing);
  file.finish();
}

}  // namespace tourmaline::output
