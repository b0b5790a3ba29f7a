#include <fmt/format.h>

#include <algorithm>

#include "case/toml_text.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::mesh {

namespace {

template <int dim>
std::array<double, 3> in_space(const dealii::Point<dim> &p) {
  std::array<double, 3> v{};
  for (int i = 0; i < dim; ++i)
    v[i] = p[i];
  return v;
}

// The names that a mesh file gives its cells, in the order of the cells.
class CellNames {
 public:
  explicit CellNames(const casefile::MeshCase &mesh) : file_(mesh.content.get()) {}

  bool holds(std::size_t cell, const std::vector<std::string> &names) const {
    for (const std::string &name : of(cell))
      if (std::find(names.begin(), names.end(), name) != names.end())
        return true;
    return false;
  }

  std::string words(std::size_t cell) const {
    std::string text;
    for (const std::string &name : of(cell))
      text += (text.empty() ? ", called \"" : "\", \"") + name;
    return text.empty() ? (file_ ? ", which has no name in the mesh file" : "") : text + "\"";
  }

 private:
  std::vector<std::string> of(std::size_t cell) const {
    std::vector<std::string> names;
    if (file_)
      for (const int name :
           file_->regions.sets[static_cast<std::size_t>(file_->regions.set_of[cell])])
        names.push_back(file_->regions.names[static_cast<std::size_t>(name)]);
    return names;
  }

  const casefile::MeshFile *file_;
};

bool is_in(const casefile::RegionCase &region, std::size_t cell, const CellNames &names,
           const std::array<double, 3> &centre) {
  return region.inside ? region.inside->value(centre, 0) != 0 : names.holds(cell, region.on);
}

// The corners of the box about some points.
struct Bounds {
  std::array<double, 3> least{}, most{};
  bool empty = true;

  void add(const std::array<double, 3> &point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = empty ? point[axis] : std::min(least[axis], point[axis]);
      most[axis] = empty ? point[axis] : std::max(most[axis], point[axis]);
    }
    empty = false;
  }

  std::string words(int dimension) const {
    std::string text;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
      text += fmt::format("{}{} from {:g} to {:g}", axis == 0 ? "" : ", ", "xyz"[axis], least[axis],
                          most[axis]);
    return text + " m";
  }
};

[[noreturn]] void fail(const casefile::Case &asked, const std::string &what,
                       const std::array<double, 3> &centre, const std::string &names) {
  throw CaseError(
      fmt::format("{} [[region]]: the cell at ({:g}, {:g}, {:g}){} {}; every cell must be in "
                  "exactly one region",
                  asked.source, centre[0], centre[1], centre[2], names, what));
}

// Most likely its name or its condition is another than was meant.
void check_none_is_empty(const casefile::Case &asked, const std::vector<std::size_t> &n_cells,
                         const Bounds &centres) {
  for (std::size_t i = 0; i < n_cells.size(); ++i) {
    if (n_cells[i] != 0)
      continue;
    const casefile::RegionCase &region = asked.regions[i];
    const std::string why =
        region.inside ? fmt::format("where = {} is 0 at the centres of all cells, which lie at {}",
                                    casefile::toml_text(region.inside->text()),
                                    centres.words(asked.dimension))
                      : fmt::format("no cell of the mesh file is called \"{}\"",
                                    fmt::join(region.on, "\" or \""));
    throw CaseError(fmt::format("{}: the region holds no cell: {}",
                                region.place.empty() ? asked.source + " [[region]]" : region.place,
                                why));
  }
}

}  // namespace

template <int dim>
void assign_regions(Mesh<dim> &mesh, const casefile::Case &asked) {
  const CellNames names(asked.mesh);
  std::vector<std::size_t> n_cells(asked.regions.size());
  Bounds centres;
  for (const auto &cell : mesh.cells->active_cell_iterators()) {
    const auto index = static_cast<std::size_t>(cell->index());
    const std::array<double, 3> centre = in_space<dim>(cell->center());
    std::vector<std::size_t> found;
    for (std::size_t region = 0; region < asked.regions.size(); ++region)
      if (is_in(asked.regions[region], index, names, centre))
        found.push_back(region);
    if (found.size() > 1)
      fail(asked, fmt::format("is in the regions {} (counted from 0)", fmt::join(found, " and ")),
           centre, names.words(index));
    if (found.empty() && !asked.regions.empty())
      fail(asked, "is in no region and has no material", centre, names.words(index));
    cell->set_material_id(found.empty() ? 0
                                        : static_cast<dealii::types::material_id>(found.front()));
    for (const std::size_t region : found)
      ++n_cells[region];
    centres.add(centre);
  }
  check_none_is_empty(asked, n_cells, centres);
}

template <int dim>
Mesh<dim> build(const casefile::Case &asked) {
  Mesh<dim> mesh = build<dim>(asked.mesh);
  assign_regions(mesh, asked);
  return mesh;
}

template void assign_regions<2>(Mesh<2> &, const casefile::Case &);
template void assign_regions<3>(Mesh<3> &, const casefile::Case &);
template Mesh<2> build<2>(const casefile::Case &);
template Mesh<3> build<3>(const casefile::Case &);

}  // namespace tourmaline::mesh
