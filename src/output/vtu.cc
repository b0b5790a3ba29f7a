#include "output/vtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "output/atomic_file.h"
#include "output/vtu_elements.h"

namespace tourmaline::output {
namespace {

std::string cells_of(const Grid &grid) {
  // VTK holds these as 64-bit integers and would convert anything narrower.
  const std::vector<std::int64_t> nodes(grid.connectivity.begin(), grid.connectivity.end());
  std::vector<std::int64_t> ends(grid.n_cells());
  for (std::size_t i = 0; i < ends.size(); ++i)
    ends[i] = static_cast<std::int64_t>((i + 1) * grid.nodes_per_cell);
  const std::vector<std::uint8_t> types(grid.n_cells(), static_cast<std::uint8_t>(grid.cell));
  return cells_element(nodes, ends, types);
}

void check_topology(const Grid &grid) {
  const auto outside = [&](std::uint32_t node) { return node >= grid.points.size(); };
  if (grid.nodes_per_cell == 0 || grid.connectivity.size() % grid.nodes_per_cell != 0)
    throw std::invalid_argument("grid: the connectivity does not divide into cells");
  if (std::any_of(grid.connectivity.begin(), grid.connectivity.end(), outside))
    throw std::invalid_argument("grid: a cell refers to a point that there is not");
}

}  // namespace

VtuWriter::VtuWriter(const Grid &grid) : n_points_(grid.points.size()), n_cells_(0) {
  check_topology(grid);
  n_cells_ = grid.n_cells();
  topology_ = points_element(grid.points) + cells_of(grid);
}

void VtuWriter::write(const std::filesystem::path &path, double time, const PointFields &points,
                      const CellFields &cells) const {
  // One array at a time, so that the text of a large body is never in memory as a whole.
  AtomicFile file(path);
  file.append(vtu_opening(time, n_points_, n_cells_));
  file.append("<PointData Scalars=\"potential\" Vectors=\"displacement\">\n");
  file.append(field("displacement", points.displacement, n_points_));
  file.append(field("potential", points.potential, n_points_));
  file.append(field("temperature", points.temperature, n_points_));
  if (!points.stress.empty()) {
    file.append(field("recovered_stress", points.stress, n_points_));
    file.append(principal_field("recovered_principal_stress", points.principal_stress, n_points_));
    file.append(field("recovered_von_mises", points.von_mises, n_points_));
  }
  file.append("</PointData>\n<CellData>\n");
  file.append(field("stress", cells.stress, n_cells_));
  file.append(principal_field("principal_stress", cells.principal_stress, n_cells_));
  file.append(field("von_mises", cells.von_mises, n_cells_));
  file.append(field("strain", cells.strain, n_cells_));
  file.append(field("electric_field", cells.electric_field, n_cells_));
  file.append(field("electric_displacement", cells.electric_displacement, n_cells_));
  file.append(field("heat_flux", cells.heat_flux, n_cells_));
  if (!cells.region.empty())
    file.append(field("region", cells.region, n_cells_));
  if (!cells.poling.empty())
    file.append(field("poling", cells.poling, n_cells_));
  file.append("</CellData>\n");
  file.append(topology_);
  file.append(vtu_closing);
  file.finish();
}

namespace {

std::string declared(const char *name, std::string_view attributes) {
  return fmt::format("<PDataArray type=\"Float64\" Name=\"{}\"{}/>\n", name, attributes);
}

}  // namespace

std::string pvtu_text(double time, std::span<const std::string> pieces,
                      const OptionalArrays &optional) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
      "<PUnstructuredGrid GhostLevel=\"0\">\n"
      "<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">\n"
      "{:.17g}\n</DataArray>\n"
      "</FieldData>\n"
      "<PPointData Scalars=\"potential\" Vectors=\"displacement\">\n",
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", time);
  text += declared("displacement", vector_components) + declared("potential", "") +
          declared("temperature", "");
  if (optional.recovered)
    text += declared("recovered_stress", tensor_components) +
            declared("recovered_principal_stress", principal_components) +
            declared("recovered_von_mises", "");
  text += "</PPointData>\n<PCellData>\n" + declared("stress", tensor_components) +
          declared("principal_stress", principal_components) + declared("von_mises", "") +
          declared("strain", tensor_components) + declared("electric_field", vector_components) +
          declared("electric_displacement", vector_components) +
          declared("heat_flux", vector_components);
  if (optional.region)
    text += declared("region", "");
  if (optional.poling)
    text += declared("poling", vector_components);
  text += "</PCellData>\n<PPoints>\n" + declared("Points", vector_components) + "</PPoints>\n";
  for (const std::string &piece : pieces)
    text += fmt::format("<Piece Source=\"{}\"/>\n", piece);
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace tourmaline::output
