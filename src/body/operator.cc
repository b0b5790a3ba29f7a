#include "body/operator.h"

#include <algorithm>
#include <cmath>

#include "cell_block.h"
#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::body {

namespace {

template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;

// As on linear simplices that are not revolved: then one product of the constants serves the whole
// cell.
template <int dim>
bool has_constant_gradients(const Quadrature<dim> &cell) {
  const std::size_t n = cell.nodes.size();
  return cell.inverse_radius.empty() &&
         std::equal(cell.gradients.begin() + n, cell.gradients.end(), cell.gradients.begin());
}

template <int dim>
Weights weights(const Quadrature<dim> &cell, std::size_t q, std::size_t a, std::size_t b) {
  const double jxw = cell.jxw[q], va = cell.value(q, a), vb = cell.value(q, b);
  return {jxw, jxw * va, jxw * vb, jxw * va * vb};
}

template <int dim>
Weights weights(const Quadrature<dim> &cell, std::size_t a, std::size_t b) {
  Weights sum{};
  for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
    const Weights w = weights(cell, q, a, b);
    sum = {sum.one + w.one, sum.a + w.a, sum.b + w.b, sum.ab + w.ab};
  }
  return sum;
}

}  // namespace

template <int dim>
Operator<dim>::Operator(const Discretisation<dim> &body,
                        const material::BodyConstants<dim> &material, Modes modes)
    : graph_(body.graph()),
      place_(places()),
      sharing_(body.sharing()),
      storage_(n_blocks(), Block::Zero()),
      conduction_(n_blocks(), 0.),
      reference_temperature_(material.reference_temperature) {
  body.for_each_cell([&](const Quadrature<dim> &cell) { add_cell(cell, material); }, modes);
}

template <int dim>
Operator<dim>::Operator(const Discretisation<dim> &body,
                        const material::Composition<dim> &composition, Modes modes)
    : graph_(body.graph()),
      place_(places()),
      sharing_(body.sharing()),
      storage_(n_blocks(), Block::Zero()),
      conduction_(n_blocks(), 0.),
      reference_temperature_(composition.reference_temperature()) {
  parallel::together([&] {
    body.for_each_cell(
        [&](const Quadrature<dim> &cell) {
          add_cell(cell, composition.at(cell.region, cell.centre()));
        },
        modes);
  });
}

// Rows come in ascending order, and so do the columns of a row.
template <int dim>
std::vector<typename Operator<dim>::Place> Operator<dim>::places() const {
  std::vector<Place> places(graph_.column.size());
  std::vector<std::size_t> next(graph_.row.begin(), graph_.row.end() - 1);
  std::size_t block = 0;
  for (Node i = 0; i < graph_.n_nodes(); ++i)
    for (std::size_t e = next[i]; e < graph_.row[i + 1]; ++e, ++block) {
      places[e] = {block, false};
      if (const Node j = graph_.column[e]; j != i)
        places[next[j]++] = {block, true};
    }
  return places;
}

// Every node that has neighbours is its own.
template <int dim>
std::size_t Operator<dim>::n_blocks() const {
  std::size_t n_rows = 0;
  for (Node i = 0; i < graph_.n_nodes(); ++i)
    n_rows += graph_.row[i + 1] > graph_.row[i] ? 1 : 0;
  return (graph_.column.size() + n_rows) / 2;
}

// `visit` takes the row, the column, which is not before it, and the block's number.
template <int dim>
template <class Visit>
void Operator<dim>::for_each_block(const Visit &visit) const {
  std::size_t block = 0;
  for (Node i = 0; i < graph_.n_nodes(); ++i)
    for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e)
      if (graph_.column[e] >= i)
        visit(i, graph_.column[e], block++);
}

template <int dim>
void Operator<dim>::add_cell(const Quadrature<dim> &cell,
                             const material::BodyConstants<dim> &material) {
  const std::size_t n_shapes = cell.nodes.size();
  const bool constant = has_constant_gradients(cell);
  std::array<Trial<dim>, 27> trials;  // as many as a quadratic hexahedron has
  for (std::size_t q = 0; q < (constant ? 1 : cell.jxw.size()); ++q) {
    for (std::size_t a = 0; a < n_shapes; ++a)
      trials[a] = trial<dim>(material, cell.gradient(q, a), cell.around(q, a));
    for (std::size_t a = 0; a < n_shapes; ++a)
      for (std::size_t b = 0; b < n_shapes; ++b) {
        if (cell.nodes[b] < cell.nodes[a])
          continue;
        const std::size_t block = block_of(cell.nodes[a], cell.nodes[b]);
        const Weights w = constant ? weights(cell, a, b) : weights(cell, q, a, b);
        add_block(trials[a], trials[b], material.heat_capacity, w, storage_[block]);
        conduction_[block] +=
            w.one * trials[a].gradient.dot(material.conductivity * trials[b].gradient);
      }
  }
  if (!cell.mode_gradients.empty())
    add_modes(cell, material);
}

// storage - K_xa K_aa^-1 K_ax, all fields at once.
template <int dim>
void Operator<dim>::add_modes(const Quadrature<dim> &cell,
                              const material::BodyConstants<dim> &material) {
  const typename CellModes<dim>::Blocks blocks(cell, material);
  const CellModes<dim> &modes = modes_.emplace_back(cell, blocks);
  for (int a = 0; a < CellModes<dim>::n_nodes; ++a)
    for (int b = 0; b < CellModes<dim>::n_nodes; ++b)
      if (modes.nodes[a] <= modes.nodes[b])
        storage_[block_of(modes.nodes[a], modes.nodes[b])] +=
            blocks.coupling.template middleCols<n>(n * a).transpose() *
            modes.response.template middleCols<n>(n * b);
}

template <int dim>
Energies Operator<dim>::energy_shift(std::span<const double> x) const {
  Energies shift;
  for (const CellModes<dim> &cell : modes_) {
    const Energies of_cell = cell.energy_shift(x);
    shift.elastic += of_cell.elastic;
    shift.electric += of_cell.electric;
    shift.thermal += of_cell.thermal;
    shift.coupling += of_cell.coupling;
  }
  std::array<double, 4> parts{shift.elastic, shift.electric, shift.thermal, shift.coupling};
  parallel::sum(parts);
  return {parts[0], parts[1], parts[2], parts[3]};
}

template <int dim>
void Operator<dim>::add_facets(const Discretisation<dim> &body,
                               const std::vector<std::string> &boundaries,
                               const casefile::Formula &coefficient, double factor,
                               const char *what, std::vector<double> &blocks) {
  const auto add_facet = [&](const Quadrature<dim> &facet) {
    for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
      const double k_c = factor * coefficient.value(facet.points[q], 0);
      if (k_c < 0)
        throw CaseError(coefficient.where() + ": the coefficient of " + what + " is negative");
      for (std::size_t a = 0; a < facet.nodes.size(); ++a)
        for (std::size_t b = 0; b < facet.nodes.size(); ++b)
          if (const double v = facet.value(q, a) * facet.value(q, b);
              v != 0 && facet.nodes[a] <= facet.nodes[b])
            blocks[block_of(facet.nodes[a], facet.nodes[b])] += k_c * facet.jxw[q] * v;
    }
  };
  parallel::together([&] { body.for_each_facet(boundaries, add_facet); });
}

template <int dim>
void Operator<dim>::add_exchange(const Discretisation<dim> &body,
                                 const std::vector<std::string> &boundaries,
                                 const casefile::Formula &coefficient) {
  add_facets(body, boundaries, coefficient, 1, "heat exchange", conduction_);
}

template <int dim>
void Operator<dim>::add_capacitors(const Discretisation<dim> &body,
                                   const std::vector<std::string> &boundaries,
                                   const casefile::Formula &coefficient, double factor) {
  has_capacitors_ = true;
  capacitors_.resize(n_blocks(), 0.);
  add_facets(body, boundaries, coefficient, factor, "charge exchange", capacitors_);
}

template <int dim>
std::size_t Operator<dim>::block_of(Node row, Node column) const {
  const auto begin = graph_.column.begin() + graph_.row[row];
  const auto end = graph_.column.begin() + graph_.row[row + 1];
  return place_[std::lower_bound(begin, end, column) - graph_.column.begin()].block;
}

template <int dim>
typename Operator<dim>::Block Operator<dim>::step_block(std::size_t entry, double step) const {
  constexpr int theta = Fields<dim>::temperature;
  const auto [held, is_transposed] = place_[entry];
  Block block = storage_[held];
  if (is_transposed)
    block.transposeInPlace();
  block(theta, theta) -= step / reference_temperature_ * conduction_[held];
  if (!capacitors_.empty())
    block(Fields<dim>::potential, Fields<dim>::potential) -= capacitors_[held];
  if (rates_ && step > 0)
    block.template topLeftCorner<dim, dim>() += rates_->step_block(entry, step);
  return block;
}

template <int dim>
void Operator<dim>::multiply(double step, std::span<const double> x, std::span<double> y) const {
  using Map = Eigen::Map<const Vector<n>>;
  constexpr int phi = Fields<dim>::potential, theta = Fields<dim>::temperature;
  std::fill(y.begin(), y.end(), 0.);
  for_each_block([&](Node i, Node j, std::size_t block) {
    const double conduction = step / reference_temperature_ * conduction_[block];
    const double capacitor = capacitors_.empty() ? 0 : capacitors_[block];
    const auto add = [&](Node row, Node column, const auto &storage) {
      const Map at(&x[unknown<dim>(column, 0)]);
      Eigen::Map<Vector<n>> sum(&y[unknown<dim>(row, 0)]);
      sum.noalias() += storage * at;
      sum[phi] -= capacitor * at[phi];
      sum[theta] -= conduction * at[theta];
    };
    add(i, j, storage_[block]);
    if (i != j)
      add(j, i, storage_[block].transpose());
  });
  add_rate_share(step, x, y);
  sharing_.add_up(y);
}

template <int dim>
void Operator<dim>::add_rate_share(double step, std::span<const double> x,
                                   std::span<double> y) const {
  if (rates_ && step > 0)
    rates_->add_of_step(graph_, step, x, y);
}

template <int dim>
std::vector<double> Operator<dim>::rate_product(typename RateForces<dim>::Kind kind,
                                                std::span<const double> x) const {
  std::vector<double> product(x.size(), 0.);
  rates_->add(kind, graph_, x, product);
  sharing_.add_up(product);
  return product;
}

template <int dim>
double Operator<dim>::row_times(std::size_t row, double step, std::span<const double> x) const {
  const Node i = static_cast<Node>(row / n);
  double sum = 0;
  for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e)
    sum += step_block(e, step).row(row % n).dot(
        Eigen::Map<const Vector<n>>(&x[unknown<dim>(graph_.column[e], 0)]));
  return parallel::sum(sum);
}

template <int dim>
void Operator<dim>::subtract_columns(std::span<const std::size_t> columns, double step,
                                     std::span<const double> x, std::span<double> y) const {
  if (std::all_of(columns.begin(), columns.end(), [&](std::size_t c) { return x[c] == 0; }))
    return;
  if (!parallel::is_first())
    std::fill(y.begin(), y.end(), 0.);
  for (const std::size_t column : columns) {
    const Node j = static_cast<Node>(column / n);
    for (std::size_t e = graph_.row[j]; e < graph_.row[j + 1]; ++e)
      Eigen::Map<Vector<n>>(&y[unknown<dim>(graph_.column[e], 0)]) -=
          x[column] * step_block(e, step).row(column % n).transpose();
  }
  parallel::sum(y);
}

template <int dim>
std::vector<double> Operator<dim>::diagonal(double step) const {
  std::vector<double> diagonal(graph_.n_nodes() * n, 0.);
  for (Node i = 0; i < graph_.n_nodes(); ++i)
    for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e)
      if (graph_.column[e] == i)
        Vector<n>::Map(&diagonal[unknown<dim>(i, 0)]) = step_block(e, step).diagonal();
  sharing_.add_up(diagonal);
  return diagonal;
}

template <int dim>
std::array<double, Operator<dim>::n> Operator<dim>::scales(std::span<const double> diagonal) const {
  std::array<double, 3> largest{};
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    largest[field_of<dim>(i)] = std::max(largest[field_of<dim>(i)], std::abs(diagonal[i]));
  sharing_.largest(largest);
  std::array<double, n> scales;
  for (int c = 0; c < n; ++c)
    scales[c] = 1 / std::sqrt(largest[field_of<dim>(c)]);
  return scales;
}

template <int dim>
std::vector<double> Operator<dim>::sizes(double step, std::span<const double> x) const {
  std::vector<double> sums(x.size(), 0.);
  for (Node i = 0; i < graph_.n_nodes(); ++i)
    for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e)
      Eigen::Map<Vector<n>>(&sums[unknown<dim>(i, 0)]) +=
          step_block(e, step).cwiseAbs() *
          Eigen::Map<const Vector<n>>(&x[unknown<dim>(graph_.column[e], 0)]).cwiseAbs();
  sharing_.add_up(sums);
  return sums;
}

template <int dim>
void Operator<dim>::multiply_by_field(std::span<const double> x, FieldProducts &products) const {
  for (std::vector<double> &product : products.of)
    product.assign(x.size(), 0.);
  for_each_block([&](Node i, Node j, std::size_t block) {
    const auto add = [&](Node row, Node column, const auto &storage) {
      const Eigen::Map<const Vector<n>> at(&x[unknown<dim>(column, 0)]);
      const double own = x[unknown<dim>(row, Fields<dim>::potential)];
      const auto sum = [&](int field) {
        return Eigen::Map<Vector<n>>(&products.of[field][unknown<dim>(row, 0)]);
      };
      sum(0).noalias() += storage.template leftCols<dim>() * at.template head<dim>();
      sum(1) += storage.col(Fields<dim>::potential) * (at[Fields<dim>::potential] - own);
      sum(2) += storage.col(Fields<dim>::temperature) * at[Fields<dim>::temperature];
    };
    add(i, j, storage_[block]);
    if (i != j)
      add(j, i, storage_[block].transpose());
  });
  for (std::vector<double> &product : products.of)
    sharing_.add_up(product);
}

template <int dim>
std::vector<double> Operator<dim>::times(const std::vector<double> &blocks, int component,
                                         std::span<const double> x) const {
  std::vector<double> taken(graph_.n_nodes(), 0.);
  for_each_block([&](Node i, Node j, std::size_t block) {
    taken[i] += blocks[block] * x[unknown<dim>(j, component)];
    if (i != j)
      taken[j] += blocks[block] * x[unknown<dim>(i, component)];
  });
  sharing_.add_up(taken);
  return taken;
}

template <int dim>
std::vector<double> Operator<dim>::conducted(std::span<const double> x) const {
  return times(conduction_, Fields<dim>::temperature, x);
}

template <int dim>
std::vector<double> Operator<dim>::held_by_capacitors(std::span<const double> x) const {
  if (!has_capacitors_)
    return {};
  return times(capacitors_, Fields<dim>::potential, x);
}

template <int dim>
void add_history(const FieldProducts &products, std::span<double> y) {
  for (std::size_t i = Fields<dim>::temperature; i < y.size(); i += Fields<dim>::count)
    y[i] += products.sum(i);
}

template class Operator<2>;
template class Operator<3>;
template void add_history<2>(const FieldProducts &, std::span<double>);
template void add_history<3>(const FieldProducts &, std::span<double>);

}  // namespace tourmaline::body
