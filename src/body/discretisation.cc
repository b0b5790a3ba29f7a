#include "body/discretisation.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "discretisation_parts.h"
#include "parallel/ranks.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::body {

Geometry geometry_of(const casefile::Case &asked) {
  return asked.model.is_axisymmetric() ? Geometry::revolved : Geometry::cartesian;
}

template <int dim>
std::array<double, 3> Quadrature<dim>::centre() const {
  std::array<double, 3> sum{};
  double volume = 0;
  for (std::size_t q = 0; q < jxw.size(); ++q) {
    volume += jxw[q];
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] += jxw[q] * points[q][axis];
  }
  for (double &coordinate : sum)
    coordinate /= volume;
  return sum;
}

namespace {

template <int dim>
std::unique_ptr<dealii::FiniteElement<dim>> lagrange(bool simplices, int degree) {
  if (simplices)
    return std::make_unique<dealii::FE_SimplexP<dim>>(degree);
  return std::make_unique<dealii::FE_Q<dim>>(degree);
}

// Of degree 2 n - 1 at least, with positive weights. On simplices the rule that no permutation of
// the corners changes (Witherden and Vincent 2015), so that no number depends on the order in which
// a mesh lists them; deal.II's QGaussSimplex is not such a rule for n = 2.
template <int dim>
dealii::Quadrature<dim> gauss(bool simplices, int n) {
  if (simplices)
    return dealii::QWitherdenVincentSimplex<dim>(n);
  return dealii::QGauss<dim>(n);
}

template <int dim>
Vector3 in_space(const dealii::Point<dim> &p) {
  Vector3 v{};
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
Discretisation<dim>::Parts::Parts(mesh::Mesh<dim> given, int degree, Geometry asked)
    : mesh(std::move(given)),
      geometry(asked),
      linear(lagrange<dim>(mesh.simplices, 1)),
      element(lagrange<dim>(mesh.simplices, degree)),
      mapping(std::make_unique<dealii::MappingFE<dim>>(*linear)),
      cell_rule(gauss<dim>(mesh.simplices, degree + 1)),
      sampling_rule(gauss<dim>(mesh.simplices, degree)),
      facet_rule(gauss<dim - 1>(mesh.simplices, degree + 1)),
      dofs(*mesh.cells) {
  dofs.distribute_dofs(*element);
  for (const auto &cell : dofs.active_cell_iterators())
    if (cell->is_locally_owned())
      cells.push_back(cell);
  number_nodes();
  list_nodes_of_cells();
  sharing = NodeSharing(touched());
  if (geometry == Geometry::revolved)
    find_axis();
}

template <int dim>
template <class Face>
bool Discretisation<dim>::Parts::lies_on_axis(const Face &face) const {
  const auto corners = face.vertex_indices();
  return geometry == Geometry::revolved &&
         std::all_of(corners.begin(), corners.end(),
                     [&](unsigned int corner) { return face.vertex(corner)[0] <= axis_ends; });
}

template <int dim>
std::span<const Node> Discretisation<dim>::Parts::nodes_of(std::size_t cell) const {
  const std::size_t n = element->n_dofs_per_cell();
  return std::span(connectivity).subspan(cell * n, n);
}

template <int dim>
template <class Values>
void Discretisation<dim>::Parts::copy(const Values &from, std::span<const Node> cell_nodes,
                                      Quadrature<dim> &to) const {
  const unsigned int n_points = from.n_quadrature_points;
  const auto n_shapes = static_cast<unsigned int>(cell_nodes.size());
  to.nodes.assign(cell_nodes.begin(), cell_nodes.end());
  to.jxw = from.get_JxW_values();
  to.points.resize(n_points);
  to.values.resize(n_points * n_shapes);
  for (unsigned int q = 0; q < n_points; ++q) {
    to.points[q] = in_space<dim>(from.quadrature_point(q));
    for (unsigned int a = 0; a < n_shapes; ++a)
      to.values[q * n_shapes + a] = from.shape_value(a, q);
  }
  if (geometry == Geometry::revolved)
    for (unsigned int q = 0; q < n_points; ++q)
      to.jxw[q] *= 2 * std::numbers::pi * to.points[q][0];
}

template <int dim>
Discretisation<dim>::Discretisation(mesh::Mesh<dim> mesh, int degree, Geometry geometry)
    : parts_(std::make_unique<Parts>(std::move(mesh), degree, geometry)) {}
template <int dim>
Discretisation<dim>::~Discretisation() = default;
template <int dim>
Discretisation<dim>::Discretisation(Discretisation &&) noexcept = default;

template <int dim>
const NodeSharing &Discretisation<dim>::sharing() const {
  return parts_->sharing;
}

template <int dim>
const std::array<Vector3, 2> &Discretisation<dim>::bounds() const {
  return parts_->bounds;
}

template <int dim>
std::size_t Discretisation<dim>::n_nodes() const {
  return parts_->points.size();
}

template <int dim>
std::size_t Discretisation<dim>::n_cells() const {
  return parts_->mesh.cells->n_global_active_cells();
}

template <int dim>
bool Discretisation<dim>::has_simplices() const {
  return parts_->mesh.simplices;
}

template <int dim>
int Discretisation<dim>::degree() const {
  return static_cast<int>(parts_->element->degree);
}

template <int dim>
Geometry Discretisation<dim>::geometry() const {
  return parts_->geometry;
}

template <int dim>
bool Discretisation<dim>::is_on_axis(Node node) const {
  return geometry() == Geometry::revolved && parts_->points[node][0] <= parts_->axis_ends;
}

template <int dim>
const std::vector<Vector3> &Discretisation<dim>::points() const {
  return parts_->points;
}

// Each node's row collects the nodes of its cells, with repetitions, and is then sorted.
template <int dim>
NodeGraph Discretisation<dim>::graph() const {
  const std::vector<Node> &nodes = parts_->connectivity;
  const std::size_t n_per_cell = parts_->element->n_dofs_per_cell();
  std::vector<std::size_t> start(n_nodes() + 1, 0);
  for (const Node node : nodes)
    start[node + std::size_t{1}] += n_per_cell;
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Node> neighbours(start.back());
  std::vector<std::size_t> end(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto cell = parts_->nodes_of(i / n_per_cell);
    std::copy(cell.begin(), cell.end(), &neighbours[end[nodes[i]]]);
    end[nodes[i]] += n_per_cell;
  }
  NodeGraph graph;
  graph.row.reserve(n_nodes() + 1);
  graph.row.push_back(0);
  for (std::size_t i = 0; i < n_nodes(); ++i) {
    const auto begin = neighbours.begin() + start[i], all = neighbours.begin() + end[i];
    std::sort(begin, all);
    graph.column.insert(graph.column.end(), begin, std::unique(begin, all));
    graph.row.push_back(graph.column.size());
  }
  return graph;
}

namespace {

// The modes 1 - xi_m^2 of Wilson on the reference cell (-1, 1)^dim, with the gradients of Taylor,
// Beresford and Wilson: (j_0 / j) J_0^-T grad_xi, where J_0 and j_0 are those of the cell's centre.
// Their integral over the cell is zero whatever its shape, so that a uniform stress does no work on
// them and the patch test holds.
template <int dim>
void fill_mode_gradients(const dealii::FEValues<dim> &centre, const dealii::FEValues<dim> &shape,
                         Quadrature<dim> &cell) {
  const auto inverse = centre.inverse_jacobian(0);
  const double j0 = centre.JxW(0);  // the rule's only weight is 1
  cell.mode_gradients.resize(std::size_t{shape.n_quadrature_points} * dim);
  for (unsigned int q = 0; q < shape.n_quadrature_points; ++q) {
    const double ratio = j0 * shape.get_quadrature().weight(q) / shape.JxW(q);
    for (int m = 0; m < dim; ++m) {
      const double xi = 2 * shape.get_quadrature().point(q)[m] - 1;
      for (int i = 0; i < dim; ++i)
        cell.mode_gradients[q * dim + m][i] = -4 * xi * ratio * inverse[m][i];
    }
  }
}

// In a revolved body the weights change over the cell and a radial mode strains it around the axis.
// Without their means over the cell these do no work on a uniform stress again (Ibrahimbegovic and
// Wilson 1991).
template <int dim>
void revolve_modes(const dealii::Quadrature<dim> &rule, Quadrature<dim> &cell) {
  cell.modes_by_radius.resize(cell.mode_gradients.size());
  const double volume = std::accumulate(cell.jxw.begin(), cell.jxw.end(), 0.);
  for (std::size_t m = 0; m < dim; ++m) {
    std::array<double, dim> mean{};
    double mean_around = 0;
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      const double xi =
          2 * rule.point(static_cast<unsigned int>(q))[static_cast<unsigned int>(m)] - 1;
      cell.modes_by_radius[q * dim + m] = (1 - xi * xi) * cell.inverse_radius[q];
      mean_around += cell.jxw[q] / volume * cell.modes_by_radius[q * dim + m];
      for (std::size_t i = 0; i < dim; ++i)
        mean[i] += cell.jxw[q] / volume * cell.mode_gradients[q * dim + m][i];
    }
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      cell.modes_by_radius[q * dim + m] -= mean_around;
      for (std::size_t i = 0; i < dim; ++i)
        cell.mode_gradients[q * dim + m][i] -= mean[i];
    }
  }
}

}  // namespace

template <int dim>
void Discretisation<dim>::for_each_cell(const std::function<void(const Quadrature<dim> &)> &visit,
                                        Modes modes) const {
  visit_cells(parts_->cell_rule, modes, visit);
}

template <int dim>
void Discretisation<dim>::for_each_cell_sampled(
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  visit_cells(parts_->sampling_rule, Modes::none, visit);
}

template <int dim>
std::vector<std::vector<double>> Discretisation<dim>::corner_shares() const {
  std::vector<std::vector<double>> shares;
  for (const dealii::Point<dim> &node : parts_->element->get_unit_support_points()) {
    shares.emplace_back();
    for (unsigned int v = 0; v < parts_->linear->n_dofs_per_cell(); ++v)
      shares.back().push_back(parts_->linear->shape_value(v, node));
  }
  return shares;
}

template <int dim>
void Discretisation<dim>::for_each_cell_nodes(
    const std::function<void(std::span<const Node>)> &visit) const {
  for (std::size_t i = 0; i < parts_->cells.size(); ++i)
    visit(parts_->nodes_of(i));
}

template <int dim>
ReferenceShapes<dim> Discretisation<dim>::shapes_at(
    const std::array<double, dim> &reference) const {
  dealii::Point<dim> place;
  std::copy(reference.begin(), reference.end(), place.begin_raw());
  ReferenceShapes<dim> shapes;
  for (unsigned int a = 0; a < parts_->element->n_dofs_per_cell(); ++a)
    shapes.values.push_back(parts_->element->shape_value(a, place));
  for (unsigned int v = 0; v < parts_->linear->n_dofs_per_cell(); ++v) {
    shapes.corners.push_back(parts_->linear->shape_value(v, place));
    shapes.corner_gradients.push_back(plain<dim>(parts_->linear->shape_grad(v, place)));
  }
  return shapes;
}

template <int dim>
template <class Rule>
void Discretisation<dim>::visit_cells(
    const Rule &rule, Modes modes,
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  dealii::FEValues<dim> shape(*parts_->mapping, *parts_->element, rule,
                              dealii::update_values | dealii::update_gradients |
                                  dealii::update_JxW_values | dealii::update_quadrature_points);
  std::optional<dealii::FEValues<dim>> centre;
  if (modes == Modes::incompatible)
    centre.emplace(*parts_->mapping, *parts_->element, dealii::QMidpoint<dim>(),
                   dealii::update_inverse_jacobians | dealii::update_JxW_values);
  const unsigned int n_shapes = parts_->element->n_dofs_per_cell();
  Quadrature<dim> plain_values;
  plain_values.gradients.resize(shape.n_quadrature_points * n_shapes);
  for (std::size_t i = 0; i < parts_->cells.size(); ++i) {
    shape.reinit(parts_->cells[i]);
    parts_->copy(shape, parts_->nodes_of(i), plain_values);
    plain_values.region = parts_->cells[i]->material_id();
    for (unsigned int q = 0; q < shape.n_quadrature_points; ++q)
      for (unsigned int a = 0; a < n_shapes; ++a)
        plain_values.gradients[q * n_shapes + a] = plain<dim>(shape.shape_grad(a, q));
    if (parts_->geometry == Geometry::revolved) {
      plain_values.inverse_radius.clear();
      for (const Vector3 &point : plain_values.points)
        plain_values.inverse_radius.push_back(1 / point[0]);
    }
    if (centre) {
      centre->reinit(parts_->cells[i]);
      fill_mode_gradients(*centre, shape, plain_values);
      if (parts_->geometry == Geometry::revolved)
        revolve_modes(rule, plain_values);
    }
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
  visit_facets([&](unsigned int id) { return ids.contains(id); }, visit);
}

template <int dim>
bool Discretisation<dim>::is_boundary(const std::string &name) const {
  return parts_->mesh.boundaries.contains(name);
}

template <int dim>
void Discretisation<dim>::for_each_facet_on_both(
    const std::vector<std::string> &boundaries, const std::vector<std::string> &others,
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  const auto ids = ids_of(parts_->mesh, boundaries), other_ids = ids_of(parts_->mesh, others);
  visit_facets([&](unsigned int id) { return ids.contains(id) && other_ids.contains(id); }, visit);
}

// `is_meant` is asked with the facet's part of the boundary.
template <int dim>
void Discretisation<dim>::visit_facets(
    const std::function<bool(unsigned int)> &is_meant,
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  dealii::FEFaceValues<dim> shape(*parts_->mapping, *parts_->element, parts_->facet_rule,
                                  dealii::update_values | dealii::update_JxW_values |
                                      dealii::update_quadrature_points |
                                      dealii::update_normal_vectors);
  Quadrature<dim> plain_values;
  for (std::size_t i = 0; i < parts_->cells.size(); ++i) {
    const auto &cell = parts_->cells[i];
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary() || !is_meant(cell->face(f)->boundary_id()))
        continue;
      shape.reinit(cell, f);
      parts_->copy(shape, parts_->nodes_of(i), plain_values);
      plain_values.normals.clear();
      for (unsigned int q = 0; q < shape.n_quadrature_points; ++q)
        plain_values.normals.push_back(plain<dim>(shape.normal_vector(q)));
      visit(plain_values);
    }
  }
}

// deal.II's own extraction would count the outer faces of the layer around a rank's cells.
template <int dim>
template <class IsAsked>
std::vector<Node> Discretisation<dim>::nodes_of_facets(const IsAsked &is_asked) const {
  std::vector<Node> nodes;
  typename Parts::Dofs of_face;
  parallel::together([&] {
    for (const auto &cell : parts_->cells)
      for (const unsigned int f : cell->face_indices()) {
        if (!is_asked(*cell->face(f)) || parts_->lies_on_axis(*cell->face(f)))
          continue;
        of_face.resize(parts_->element->n_dofs_per_face(f));
        cell->face(f)->get_dof_indices(of_face);
        for (const auto dof : of_face)
          nodes.push_back(parts_->sharing.number(parts_->node_of(dof)));
      }
  });
  nodes = parallel::joined(nodes);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return parts_->sharing.nodes(nodes);
}

template <int dim>
std::vector<Node> Discretisation<dim>::nodes_on(const std::vector<std::string> &boundaries) const {
  std::vector<std::string> outer;
  std::vector<const std::set<mesh::FacetCorners<dim>> *> inner;
  for (const std::string &name : boundaries)
    if (const auto found = parts_->mesh.inner.find(name); found != parts_->mesh.inner.end())
      inner.push_back(&found->second);
    else
      outer.push_back(name);
  const auto ids = ids_of(parts_->mesh, outer);
  return nodes_of_facets([&](const auto &face) {
    if (face.at_boundary() && ids.contains(face.boundary_id()))
      return true;
    return !inner.empty() && std::any_of(inner.begin(), inner.end(), [&](const auto *facets) {
      return facets->contains(mesh::corners_of<dim>(face));
    });
  });
}

template <int dim>
std::vector<Node> Discretisation<dim>::nodes_inside(
    const std::function<bool(const Vector3 &)> &belongs) const {
  return nodes_of_facets([&](const auto &face) {
    if (face.at_boundary())
      return false;
    const auto corners = face.vertex_indices();
    return std::all_of(corners.begin(), corners.end(), [&](unsigned int corner) {
      return belongs(in_space<dim>(face.vertex(corner)));
    });
  });
}

template struct Quadrature<2>;
template struct Quadrature<3>;
template class Discretisation<2>;
template class Discretisation<3>;

}  // namespace tourmaline::body
