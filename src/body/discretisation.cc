#include "tourmaline/body/discretisation.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <set>

#include "tourmaline/error.h"
#include "tourmaline/output/place.h"

namespace tourmaline::body {

template <int dim>
struct Discretisation<dim>::Parts {
  Parts(mesh::Mesh<dim> given, int degree);

  template <class Values>
  void copy(const Values &from, const std::vector<dealii::types::global_dof_index> &dofs,
            Quadrature<dim> &to) const;

  mesh::Mesh<dim> mesh;
  std::unique_ptr<dealii::FiniteElement<dim>> linear, element;
  std::unique_ptr<dealii::Mapping<dim>> mapping;
  dealii::Quadrature<dim> cell_rule;
  dealii::Quadrature<dim - 1> facet_rule;
  dealii::DoFHandler<dim> nodes;
  std::vector<output::Vector> points;
};

namespace {

template <int dim>
std::unique_ptr<dealii::FiniteElement<dim>> lagrange(bool simplices, int degree) {
  if (simplices)
    return std::make_unique<dealii::FE_SimplexP<dim>>(degree);
  return std::make_unique<dealii::FE_Q<dim>>(degree);
}

template <int dim>
dealii::Quadrature<dim> gauss(bool simplices, int n) {
  if (simplices)
    return dealii::QGaussSimplex<dim>(n);
  return dealii::QGauss<dim>(n);
}

template <int dim>
output::Vector in_space(const dealii::Point<dim> &p) {
  output::Vector v{};
  for (int i = 0; i < dim; ++i)
    v[i] = p[i];
  return v;
}

template <int dim>
std::array<double, dim> plain(const dealii::Tensor<1, dim> &t) {
  std::array<double, dim> v;
  for (int i = 0; i < dim; ++i)
    v[i] = t[i];
  return v;
}

}  // namespace

template <int dim>
Discretisation<dim>::Parts::Parts(mesh::Mesh<dim> given, int degree)
    : mesh(std::move(given)),
      linear(lagrange<dim>(mesh.simplices, 1)),
      element(lagrange<dim>(mesh.simplices, degree)),
      mapping(std::make_unique<dealii::MappingFE<dim>>(*linear)),
      cell_rule(gauss<dim>(mesh.simplices, degree + 1)),
      facet_rule(gauss<dim - 1>(mesh.simplices, degree + 1)),
      nodes(*mesh.cells) {
  nodes.distribute_dofs(*element);
  std::vector<dealii::Point<dim>> places(nodes.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(*mapping, nodes, places);
  std::vector<output::Vector> unsorted;
  std::transform(places.begin(), places.end(), std::back_inserter(unsorted), in_space<dim>);
  const std::vector<std::size_t> order = output::sorted_by_place(unsorted);
  std::vector<dealii::types::global_dof_index> number(order.size());
  for (std::size_t place = 0; place < order.size(); ++place) {
    number[order[place]] = static_cast<dealii::types::global_dof_index>(place);
    points.push_back(unsorted[order[place]]);
  }
  nodes.renumber_dofs(number);
}

template <int dim>
template <class Values>
void Discretisation<dim>::Parts::copy(const Values &from,
                                      const std::vector<dealii::types::global_dof_index> &dofs,
                                      Quadrature<dim> &to) const {
  const unsigned int n_points = from.n_quadrature_points;
  const auto n_shapes = static_cast<unsigned int>(dofs.size());
  to.nodes.assign(dofs.begin(), dofs.end());
  to.jxw = from.get_JxW_values();
  to.points.resize(n_points);
  to.values.resize(n_points * n_shapes);
  for (unsigned int q = 0; q < n_points; ++q) {
    to.points[q] = in_space<dim>(from.quadrature_point(q));
    for (unsigned int a = 0; a < n_shapes; ++a)
      to.values[q * n_shapes + a] = from.shape_value(a, q);
  }
}

template <int dim>
Discretisation<dim>::Discretisation(mesh::Mesh<dim> mesh, int degree)
    : parts_(std::make_unique<Parts>(std::move(mesh), degree)) {}
template <int dim>
Discretisation<dim>::~Discretisation() = default;
template <int dim>
Discretisation<dim>::Discretisation(Discretisation &&) noexcept = default;

template <int dim>
std::size_t Discretisation<dim>::n_nodes() const {
  return parts_->nodes.n_dofs();
}

template <int dim>
std::size_t Discretisation<dim>::n_cells() const {
  return parts_->mesh.cells->n_active_cells();
}

template <int dim>
const std::vector<output::Vector> &Discretisation<dim>::points() const {
  return parts_->points;
}

template <int dim>
NodeGraph Discretisation<dim>::graph() const {
  dealii::DynamicSparsityPattern pattern(parts_->nodes.n_dofs());
  dealii::DoFTools::make_sparsity_pattern(parts_->nodes, pattern);
  NodeGraph graph;
  graph.row.reserve(n_nodes() + 1);
  graph.column.reserve(pattern.n_nonzero_elements());
  graph.row.push_back(0);
  for (Node i = 0; i < n_nodes(); ++i) {
    for (unsigned int k = 0; k < pattern.row_length(i); ++k)
      graph.column.push_back(static_cast<Node>(pattern.column_number(i, k)));
    graph.row.push_back(graph.column.size());
  }
  return graph;
}

template <int dim>
void Discretisation<dim>::for_each_cell(
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  dealii::FEValues<dim> shape(*parts_->mapping, *parts_->element, parts_->cell_rule,
                              dealii::update_values | dealii::update_gradients |
                                  dealii::update_JxW_values | dealii::update_quadrature_points);
  std::vector<dealii::types::global_dof_index> dofs(parts_->element->n_dofs_per_cell());
  Quadrature<dim> plain_values;
  plain_values.gradients.resize(shape.n_quadrature_points * dofs.size());
  for (const auto &cell : parts_->nodes.active_cell_iterators()) {
    shape.reinit(cell);
    cell->get_dof_indices(dofs);
    parts_->copy(shape, dofs, plain_values);
    for (unsigned int q = 0; q < shape.n_quadrature_points; ++q)
      for (unsigned int a = 0; a < dofs.size(); ++a)
        plain_values.gradients[q * dofs.size() + a] = plain<dim>(shape.shape_grad(a, q));
    visit(plain_values);
  }
}

namespace {

template <int dim>
std::set<dealii::types::boundary_id> ids_of(const mesh::Mesh<dim> &mesh,
                                            const std::vector<std::string> &names) {
  std::set<dealii::types::boundary_id> ids;
  for (const std::string &name : names) {
    const auto found = mesh.boundaries.find(name);
    if (found == mesh.boundaries.end())
      throw CaseError("the mesh has no boundary named \"" + name + "\"");
    ids.insert(found->second.begin(), found->second.end());
  }
  return ids;
}

}  // namespace

template <int dim>
void Discretisation<dim>::for_each_facet(
    const std::vector<std::string> &boundaries,
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  const auto ids = ids_of(parts_->mesh, boundaries);
  dealii::FEFaceValues<dim> shape(*parts_->mapping, *parts_->element, parts_->facet_rule,
                                  dealii::update_values | dealii::update_JxW_values |
                                      dealii::update_quadrature_points |
                                      dealii::update_normal_vectors);
  std::vector<dealii::types::global_dof_index> dofs(parts_->element->n_dofs_per_cell());
  Quadrature<dim> plain_values;
  for (const auto &cell : parts_->nodes.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary() || !ids.count(cell->face(f)->boundary_id()))
        continue;
      shape.reinit(cell, f);
      cell->get_dof_indices(dofs);
      parts_->copy(shape, dofs, plain_values);
      plain_values.normals.clear();
      for (unsigned int q = 0; q < shape.n_quadrature_points; ++q)
        plain_values.normals.push_back(plain<dim>(shape.normal_vector(q)));
      visit(plain_values);
    }
}

template <int dim>
std::vector<Node> Discretisation<dim>::nodes_on(const std::vector<std::string> &boundaries) const {
  const dealii::IndexSet on =
      dealii::DoFTools::extract_boundary_dofs(parts_->nodes, {}, ids_of(parts_->mesh, boundaries));
  return {on.begin(), on.end()};
}

namespace {

using output::VtkCell;

VtkCell vtk_cell(int dim, bool simplices, unsigned int degree) {
  if (simplices)
    return dim == 2 ? (degree == 1 ? VtkCell::triangle : VtkCell::quadratic_triangle)
                    : (degree == 1 ? VtkCell::tetrahedron : VtkCell::quadratic_tetrahedron);
  return dim == 2 ? (degree == 1 ? VtkCell::quadrilateral : VtkCell::quadratic_quadrilateral)
                  : (degree == 1 ? VtkCell::hexahedron : VtkCell::quadratic_hexahedron);
}

// deal.II's local node of each of VTK's. Simplices agree but for the edges of the tetrahedron;
// deal.II's tensor-product cells run x fastest and list vertices, lines, faces, interior.
std::vector<unsigned int> vtk_order(VtkCell cell) {
  switch (cell) {
    case VtkCell::triangle:
      return {0, 1, 2};
    case VtkCell::quadrilateral:
      return {0, 1, 3, 2};
    case VtkCell::tetrahedron:
      return {0, 1, 2, 3};
    case VtkCell::hexahedron:
      return {0, 1, 3, 2, 4, 5, 7, 6};
    case VtkCell::quadratic_triangle:
      return {0, 1, 2, 3, 4, 5};
    case VtkCell::quadratic_quadrilateral:
      return {0, 1, 3, 2, 6, 5, 7, 4, 8};
    case VtkCell::quadratic_tetrahedron:
      return {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    case VtkCell::quadratic_hexahedron:
      return {0,  1,  3,  2,  4,  5,  7,  6,  10, 9,  11, 8,  14, 13,
              15, 12, 16, 17, 19, 18, 20, 21, 22, 23, 24, 25, 26};
  }
  return {};
}

}  // namespace

template <int dim>
output::Grid Discretisation<dim>::grid() const {
  output::Grid grid;
  grid.dimension = dim;
  grid.points = parts_->points;
  grid.cell = vtk_cell(dim, parts_->mesh.simplices, parts_->element->degree);
  const std::vector<unsigned int> order = vtk_order(grid.cell);
  grid.nodes_per_cell = order.size();
  std::vector<dealii::types::global_dof_index> dofs(parts_->element->n_dofs_per_cell());
  for (const auto &cell : parts_->nodes.active_cell_iterators()) {
    cell->get_dof_indices(dofs);
    for (const unsigned int local : order)
      grid.connectivity.push_back(dofs[local]);
  }
  return grid;
}

template class Discretisation<2>;
template class Discretisation<3>;

}  // namespace tourmaline::body
