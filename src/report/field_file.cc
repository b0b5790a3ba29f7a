#include "report/field_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "output/place.h"
#include "report/text_file.h"
#include "report/vtk_array.h"
#include "report/xml.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

namespace fs = std::filesystem;
using output::VtkCell;

std::size_t nodes_of(VtkCell cell, const std::string &name) {
  switch (cell) {
    case VtkCell::triangle:
      return 3;
    case VtkCell::quadrilateral:
    case VtkCell::tetrahedron:
      return 4;
    case VtkCell::quadratic_triangle:
      return 6;
    case VtkCell::hexahedron:
      return 8;
    case VtkCell::quadratic_quadrilateral:
      return 9;
    case VtkCell::quadratic_tetrahedron:
      return 10;
    case VtkCell::quadratic_hexahedron:
      return 27;
  }
  throw CaseError(
      fmt::format("{}: cells of VTK's type {} are not read here", name, static_cast<int>(cell)));
}

bool is_plane(VtkCell cell) {
  return cell == VtkCell::triangle || cell == VtkCell::quadrilateral ||
         cell == VtkCell::quadratic_triangle || cell == VtkCell::quadratic_quadrilateral;
}

/// 0 for what is no number of components, which no array has.
std::size_t number_of(const std::string &text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number <= 9 ? number : 0;
}

/// Collects the arrays of one .vtu file as its elements go by.
class Piece {
 public:
  explicit Piece(std::string name) : name_(std::move(name)) {}

  void visit(const XmlElement &element) {
    if (element.name == "DataArray")
      take(element);
    else
      section_ = element.name;
  }

  /// A rank without cells writes such a piece.
  bool is_empty() const { return file_.grid.points.empty() && !has_cells_; }

  FieldFile finish() {
    if (file_.grid.points.empty() || !has_cells_)
      throw CaseError(name_ + ": is no field file of Tourmaline; it holds no points or no cells");
    file_.grid.nodes_per_cell = nodes_of(file_.grid.cell, name_);
    file_.grid.dimension = is_plane(file_.grid.cell) ? 2 : 3;
    check_sizes();
    return std::move(file_);
  }

 private:
  void take(const XmlElement &element) {
    if (section_ == "FieldData")
      return;
    const std::string array = element.attribute("Name");
    std::vector<double> values = read_vtk_binary(element.text, element.attribute("type"), name_);
    if (section_ == "Points")
      take_points(values);
    else if (array == "connectivity")
      take_connectivity(values);
    else if (array == "types" && !values.empty()) {
      file_.grid.cell = static_cast<VtkCell>(values.front() < 256 ? values.front() : 0);
      has_cells_ = true;
    } else if (section_ == "PointData" || section_ == "CellData") {
      const std::string components = element.attribute("NumberOfComponents");
      file_.arrays.push_back({array, components.empty() ? 1 : number_of(components),
                              section_ == "PointData", std::move(values)});
    }
  }

  void take_connectivity(const std::vector<double> &values) {
    file_.grid.connectivity.clear();
    for (const double value : values) {
      if (!(value >= 0 && value < 4294967295.))
        throw CaseError(name_ + ": a cell refers to a point that there is not");
      file_.grid.connectivity.push_back(static_cast<std::uint32_t>(value));
    }
  }

  void take_points(const std::vector<double> &values) {
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      file_.grid.points.push_back({values[i], values[i + 1], values[i + 2]});
  }

  void check_sizes() const {
    if (file_.grid.connectivity.empty() ||
        file_.grid.connectivity.size() % file_.grid.nodes_per_cell != 0)
      throw CaseError(name_ + ": the list of its cells is not whole");
    for (const Vector3 &point : file_.grid.points)
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
        throw CaseError(name_ + ": a point has no place");
    for (const std::uint32_t node : file_.grid.connectivity)
      if (node >= file_.grid.points.size())
        throw CaseError(name_ + ": a cell refers to a point that there is not");
    for (const FieldArray &array : file_.arrays) {
      const std::size_t places = array.on_points ? file_.grid.points.size() : file_.grid.n_cells();
      if (array.components == 0 || array.values.size() != places * array.components)
        throw CaseError(fmt::format("{}: the array {} does not have one value for each place",
                                    name_, array.name));
    }
  }

  std::string name_;
  FieldFile file_;
  std::string_view section_;
  bool has_cells_ = false;
};

Piece piece_in(const fs::path &path) {
  const std::string text = read_text_file(path);
  Piece piece(path.string());
  for_each_element(text, path.string(), [&](const XmlElement &e) { piece.visit(e); });
  return piece;
}

void append(FieldFile &all, const FieldFile &piece, const std::string &name) {
  if (all.arrays.size() != piece.arrays.size() || all.grid.cell != piece.grid.cell)
    throw CaseError(name + ": its pieces do not hold the same arrays");
  const auto first = static_cast<std::uint32_t>(all.grid.points.size());
  all.grid.points.insert(all.grid.points.end(), piece.grid.points.begin(), piece.grid.points.end());
  for (const std::uint32_t node : piece.grid.connectivity)
    all.grid.connectivity.push_back(first + node);
  for (std::size_t i = 0; i < all.arrays.size(); ++i)
    all.arrays[i].values.insert(all.arrays[i].values.end(), piece.arrays[i].values.begin(),
                                piece.arrays[i].values.end());
}

double extent(const std::vector<Vector3> &points) {
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(), [axis](auto &a, auto &b) { return a[axis] < b[axis]; });
    size = std::max(size, (*high)[axis] - (*low)[axis]);
  }
  return size;
}

bool same_place(const Vector3 &a, const Vector3 &b, double tolerance) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(a[axis] - b[axis]) > tolerance)
      return false;
  return true;
}

/// The region of each point: a point of a piece belongs to cells of one. 0 where there is but one.
std::vector<double> regions_of_points(const FieldFile &file) {
  std::vector<double> regions(file.grid.points.size(), 0);
  for (const FieldArray &array : file.arrays)
    if (array.name == "region" && !array.on_points && array.components == 1)
      for (std::size_t i = 0; i < file.grid.connectivity.size(); ++i)
        regions[file.grid.connectivity[i]] = array.values[i / file.grid.nodes_per_cell];
  return regions;
}

/// Points by place and region, each once, with the values of the first piece that has it: first
/// those of the least region at each place, in the order of nodes.csv, then the others.
class Merged {
 public:
  explicit Merged(const FieldFile &file) : number_(file.grid.points.size()) {
    const std::vector<Vector3> &points = file.grid.points;
    const std::vector<std::size_t> order = output::sorted_by_place(points);
    const std::vector<double> regions = regions_of_points(file);
    const double tolerance = 1e-9 * extent(points);  // that of sorted_by_place
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      while (end < order.size() && same_place(points[order[begin]], points[order[end]], tolerance))
        ++end;
      add({&order[begin], end - begin}, regions);
    }
    for (auto &[point, others] : copies_)
      add_copy(point, others);
  }

  /// The points that are kept, and the place among them of each one.
  const std::vector<std::size_t> &kept() const { return kept_; }
  std::uint32_t number(std::size_t point) const { return number_[point]; }

 private:
  void add(std::span<const std::size_t> here, const std::vector<double> &regions) {
    std::map<double, std::vector<std::size_t>> by_region;
    for (const std::size_t point : here)
      by_region[regions[point]].push_back(point);
    for (const auto &[region, points] : by_region)
      if (region == by_region.begin()->first)
        add_copy(points.front(), points);
      else
        copies_.emplace_back(points.front(), points);
  }

  void add_copy(std::size_t point, const std::vector<std::size_t> &all) {
    for (const std::size_t one : all)
      number_[one] = static_cast<std::uint32_t>(kept_.size());
    kept_.push_back(point);
  }

  std::vector<std::size_t> kept_;
  std::vector<std::uint32_t> number_;
  std::vector<std::pair<std::size_t, std::vector<std::size_t>>> copies_;
};

void merge_points(FieldFile &file) {
  const Merged merged(file);
  // Points of one node stand at one place to the last bit, by which they are known as such.
  std::vector<Vector3> points;
  points.reserve(merged.kept().size());
  for (const std::size_t i : merged.kept())
    points.push_back(file.grid.points[i]);
  file.grid.points = std::move(points);
  for (std::uint32_t &node : file.grid.connectivity)
    node = merged.number(node);
  for (FieldArray &array : file.arrays) {
    if (!array.on_points)
      continue;
    std::vector<double> values;
    for (const std::size_t i : merged.kept())
      values.insert(values.end(), &array.values[i * array.components],
                    &array.values[i * array.components] + array.components);
    array.values = std::move(values);
  }
}

FieldFile read_pieces(const fs::path &path) {
  const std::string text = read_text_file(path);
  std::vector<fs::path> pieces;
  for_each_element(text, path.string(), [&](const XmlElement &e) {
    if (e.name == "Piece")
      pieces.push_back(path.parent_path() / e.attribute("Source"));
  });
  if (pieces.empty())
    throw CaseError(path.string() + ": names no pieces");
  std::optional<FieldFile> all;
  for (const fs::path &file : pieces) {
    Piece piece = piece_in(file);
    if (piece.is_empty())
      continue;
    if (all)
      append(*all, piece.finish(), path.string());
    else
      all = piece.finish();
  }
  if (!all)
    throw CaseError(path.string() + ": none of its pieces holds points and cells");
  merge_points(*all);
  return *std::move(all);
}

}  // namespace

FieldFile read_field_file(const fs::path &path) {
  return path.extension() == ".pvtu" ? read_pieces(path) : piece_in(path).finish();
}

}  // namespace tourmaline::report
