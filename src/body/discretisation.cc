#include "body/discretisation.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "discretisation_parts.h"
#include "tourmaline/case/case.h"

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
std::array<double, dim> plain(const dealii::Tensor<1, dim> &t) {
  std::array<double, dim> v;
  for (int i = 0; i < dim; ++i)
    v[i] = t[i];
  return v;
}

}  // namespace

template <int dim>
Discretisation<dim>::Parts::Parts(const mesh::Mesh<dim> &mesh, int degree, Geometry asked)
    : geometry(asked),
      linear(lagrange<dim>(mesh.simplices, 1)),
      element(lagrange<dim>(mesh.simplices, degree)),
      shapes(*element, *linear, gauss<dim>(mesh.simplices, degree + 1)),
      sampled(*element, *linear, gauss<dim>(mesh.simplices, degree)),
      centre(*element, *linear, dealii::QMidpoint<dim>()),
      reference_facets(facets_of(*element, *linear, gauss<dim - 1>(mesh.simplices, degree + 1))),
      n_all_cells(mesh.cells->n_global_active_cells()) {
  dealii::DoFHandler<dim> dofs(*mesh.cells);
  dofs.distribute_dofs(*element);
  list_cells(dofs, number_nodes(dofs));
  list_facets(mesh);
  connectivity.shrink_to_fit();
  regions.shrink_to_fit();
  sharing = NodeSharing(touched());
  if (geometry == Geometry::revolved)
    find_axis();
}

template <int dim>
std::span<const Vector3> Discretisation<dim>::Parts::corners_of(std::size_t cell,
                                                                Corners &corners) const {
  const std::size_t n = linear->n_dofs_per_cell();
  for (std::size_t v = 0; v < n; ++v)
    corners[v] = points[nodes_of(cell)[v]];
  return std::span(corners).first(n);
}

template <int dim>
std::span<const Node> Discretisation<dim>::Parts::nodes_of(std::size_t cell) const {
  const std::size_t n = element->n_dofs_per_cell();
  return std::span(connectivity).subspan(cell * n, n);
}

template <int dim>
void Discretisation<dim>::Parts::revolve(Quadrature<dim> &to) const {
  for (std::size_t q = 0; q < to.jxw.size() && geometry == Geometry::revolved; ++q)
    to.jxw[q] *= 2 * std::numbers::pi * to.points[q][0];
}

template <int dim>
Discretisation<dim>::Discretisation(const mesh::Mesh<dim> &mesh, int degree, Geometry geometry)
    : parts_(std::make_unique<Parts>(mesh, degree, geometry)) {}
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
  return parts_->n_all_cells;
}

template <int dim>
bool Discretisation<dim>::has_simplices() const {
  return parts_->linear->n_dofs_per_cell() == dim + 1;
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
void fill_mode_gradients(std::span<const Vector3> corners, const ShapeTable<dim> &centre,
                         const ShapeTable<dim> &shapes, Quadrature<dim> &cell) {
  const typename ShapeTable<dim>::Jacobian of_centre = centre.jacobian(corners, 0);
  const typename ShapeTable<dim>::Jacobian inverse = of_centre.inverse();
  cell.mode_gradients.resize(cell.jxw.size() * dim);
  for (unsigned int q = 0; q < cell.jxw.size(); ++q) {
    const double ratio = of_centre.determinant() / shapes.jacobian(corners, q).determinant();
    for (int m = 0; m < dim; ++m) {
      const double xi = 2 * shapes.rule().point(q)[m] - 1;
      for (int i = 0; i < dim; ++i)
        cell.mode_gradients[q * dim + m][i] = -4 * xi * ratio * inverse(m, i);
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
  visit_cells(parts_->shapes, modes, visit);
}

template <int dim>
void Discretisation<dim>::for_each_cell_sampled(
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  visit_cells(parts_->sampled, Modes::none, visit);
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
  for (std::size_t i = 0; i < parts_->n_cells(); ++i)
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
template <class Table>
void Discretisation<dim>::visit_cells(
    const Table &shapes, Modes modes,
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  Quadrature<dim> cell;
  typename Parts::Corners places;
  for (std::size_t i = 0; i < parts_->n_cells(); ++i) {
    const auto corners = parts_->corners_of(i, places);
    const auto nodes = parts_->nodes_of(i);
    cell.nodes.assign(nodes.begin(), nodes.end());
    cell.region = parts_->regions[i];
    shapes.fill_cell(corners, cell);
    if (modes == Modes::incompatible)
      fill_mode_gradients(corners, parts_->centre, shapes, cell);
    if (parts_->geometry == Geometry::revolved) {
      parts_->revolve(cell);
      cell.inverse_radius.clear();
      for (const Vector3 &point : cell.points)
        cell.inverse_radius.push_back(1 / point[0]);
      if (modes == Modes::incompatible)
        revolve_modes(shapes.rule(), cell);
    }
    visit(cell);
  }
}

template struct Quadrature<2>;
template struct Quadrature<3>;
template class Discretisation<2>;
template class Discretisation<3>;

}  // namespace tourmaline::body
