#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/records.h"

/// What VTK's files of unstructured grids (.vtu) consist of, as text.
namespace tourmaline::output {

/// Component names in ParaView's own order of vectors and symmetric tensors.
constexpr std::string_view vector_components =
    R"( NumberOfComponents="3" ComponentName0="X" ComponentName1="Y" ComponentName2="Z")";
constexpr std::string_view tensor_components =
    R"( NumberOfComponents="6" ComponentName0="XX" ComponentName1="YY" ComponentName2="ZZ")"
    R"( ComponentName3="XY" ComponentName4="YZ" ComponentName5="XZ")";

/// Of principal values, which are no vector.
constexpr std::string_view principal_components =
    R"( NumberOfComponents="3" ComponentName0="1" ComponentName1="2" ComponentName2="3")";

/// The array of a field with a value for each of `expected` places; throws std::invalid_argument
/// when it has another number of them.
std::string field(const std::string &name, const std::vector<double> &values, std::size_t expected);
std::string field(const std::string &name, const std::vector<std::uint8_t> &values,
                  std::size_t expected);
std::string field(const std::string &name, const std::vector<std::int32_t> &values,
                  std::size_t expected);
std::string field(const std::string &name, const std::vector<Vector3> &values,
                  std::size_t expected);
std::string field(const std::string &name, const std::vector<SymmetricTensor> &values,
                  std::size_t expected);
std::string principal_field(const std::string &name, const std::vector<Vector3> &values,
                            std::size_t expected);

/// <Points>
std::string points_element(const std::vector<Vector3> &points);
/// <Cells>: the nodes of all cells one behind the other, where each cell's end, VTK's number of
/// what each is.
std::string cells_element(std::span<const std::int64_t> nodes, std::span<const std::int64_t> ends,
                          std::span<const std::uint8_t> types);

/// What stands before <PointData>, with the time [s], and at the end of the file.
std::string vtu_opening(double time, std::size_t n_points, std::size_t n_cells);
constexpr std::string_view vtu_closing = "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";

}  // namespace tourmaline::output
