#include "output/vtu_elements.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <stdexcept>
#include <type_traits>

#include "output/vtk_binary.h"

namespace tourmaline::output {
namespace {

template <typename Number>
constexpr const char *vtk_type() {
  if constexpr (std::is_same_v<Number, double>)
    return "Float64";
  else if constexpr (std::is_same_v<Number, std::int64_t>)
    return "Int64";
  else if constexpr (std::is_same_v<Number, std::int32_t>)
    return "Int32";
  else if constexpr (std::is_same_v<Number, std::uint8_t>)
    return "UInt8";
}

template <typename Number>
std::string data_array(const std::string &name, std::string_view attributes,
                       std::span<const Number> numbers) {
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"binary\">\n{}\n</DataArray>\n",
                     vtk_type<Number>(), name, attributes, vtk_binary(std::as_bytes(numbers)));
}

template <std::size_t n>
std::span<const double> flat(const std::vector<std::array<double, n>> &values) {
  static_assert(sizeof(std::array<double, n>) == n * sizeof(double));
  return {values.empty() ? nullptr : values.front().data(), values.size() * n};
}

void check_size(const std::string &name, std::size_t size, std::size_t expected) {
  if (size != expected)
    throw std::invalid_argument(
        fmt::format("field {}: {} values for {} places", name, size, expected));
}

}  // namespace

std::string field(const std::string &name, const std::vector<double> &values,
                  std::size_t expected) {
  check_size(name, values.size(), expected);
  return data_array<double>(name, "", values);
}

std::string field(const std::string &name, const std::vector<std::uint8_t> &values,
                  std::size_t expected) {
  check_size(name, values.size(), expected);
  return data_array<std::uint8_t>(name, "", values);
}

std::string field(const std::string &name, const std::vector<std::int32_t> &values,
                  std::size_t expected) {
  check_size(name, values.size(), expected);
  return data_array<std::int32_t>(name, "", values);
}

std::string field(const std::string &name, const std::vector<Vector3> &values,
                  std::size_t expected) {
  check_size(name, values.size(), expected);
  return data_array(name, vector_components, flat(values));
}

std::string principal_field(const std::string &name, const std::vector<Vector3> &values,
                            std::size_t expected) {
  check_size(name, values.size(), expected);
  return data_array(name, principal_components, flat(values));
}

std::string field(const std::string &name, const std::vector<SymmetricTensor> &values,
                  std::size_t expected) {
  check_size(name, values.size(), expected);
  return data_array(name, tensor_components, flat(values));
}

std::string points_element(const std::vector<Vector3> &points) {
  return "<Points>\n" + data_array("Points", vector_components, flat(points)) + "</Points>\n";
}

std::string cells_element(std::span<const std::int64_t> nodes, std::span<const std::int64_t> ends,
                          std::span<const std::uint8_t> types) {
  return "<Cells>\n" + data_array("connectivity", "", nodes) + data_array("offsets", "", ends) +
         data_array("types", "", types) + "</Cells>\n";
}

std::string vtu_opening(double time, std::size_t n_points, std::size_t n_cells) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n"
      "<UnstructuredGrid>\n"
      "<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">\n"
      "{:.17g}\n</DataArray>\n"
      "</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", time, n_points,
      n_cells);
}

}  // namespace tourmaline::output
