#include <fmt/format.h>

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

[[noreturn]] void fail(const std::string &what, const std::array<double, 3> &centre,
                       const std::string &names) {
  throw CaseError(fmt::format(
      "[[region]]: the cell at ({:g}, {:g}, {:g}){} {}; every cell must be in exactly one region",
      centre[0], centre[1], centre[2], names, what));
}

}  // namespace

template <int dim>
void assign_regions(Mesh<dim> &mesh, const casefile::Case &asked) {
  const CellNames names(asked.mesh);
  for (const auto &cell : mesh.cells->active_cell_iterators()) {
    const auto index = static_cast<std::size_t>(cell->index());
    const std::array<double, 3> centre = in_space<dim>(cell->center());
    std::vector<std::size_t> found;
    for (std::size_t region = 0; region < asked.regions.size(); ++region)
      if (is_in(asked.regions[region], index, names, centre))
        found.push_back(region);
    if (found.size() > 1)
      fail(fmt::format("is in the regions {} (counted from 0)", fmt::join(found, " and ")), centre,
           names.words(index));
    if (found.empty() && !asked.regions.empty())
      fail("is in no region and has no material", centre, names.words(index));
    cell->set_material_id(found.empty() ? 0
                                        : static_cast<dealii::types::material_id>(found.front()));
  }
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
