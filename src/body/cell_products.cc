#include "body/cell_products.h"

#include "parallel/ranks.h"

namespace tourmaline::body {

namespace {

template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;
template <int dim>
using Tensor = Eigen::Matrix<double, dim, dim>;
template <int dim>
using Strain = Eigen::Matrix<double, material::n_strains<dim>, 1>;

// Engineering strain of a displacement gradient H_ij = du_i/dx_j; `around` is u_x / x of a revolved
// body.
Strain<2> voigt_of(const Tensor<2> &h, double around) {
  return {h(0, 0), h(1, 1), around, h(0, 1) + h(1, 0)};
}

Strain<3> voigt_of(const Tensor<3> &h, double) {
  Strain<3> e;
  e << h(0, 0), h(1, 1), h(2, 2), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0), h(0, 1) + h(1, 0);
  return e;
}

Tensor<2> stress_tensor(const Strain<2> &s) {
  Tensor<2> t;
  t << s[0], s[3], s[3], s[1];
  return t;
}

// The stress that works with `around`.
double stress_around(const Strain<2> &s) {
  return s[2];
}
double stress_around(const Strain<3> &) {
  return 0;
}

Tensor<3> stress_tensor(const Strain<3> &s) {
  Tensor<3> t;
  t << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
  return t;
}

// The fields at one quadrature point.
template <int dim>
struct Point {
  Strain<dim> strain;
  Vector<dim> potential_gradient = Vector<dim>::Zero(), temperature_gradient = Vector<dim>::Zero();
  double temperature = 0;
};

// Of a cell's incompatible modes.
template <int dim>
using Amplitudes = Eigen::Matrix<double, CellModes<dim>::n_amplitudes, 1>;

template <int dim>
Vector<dim> gradient(const Quadrature<dim> &cell, std::size_t q, std::size_t a) {
  return Eigen::Map<const Vector<dim>>(cell.gradient(q, a).data());
}

template <int dim>
Point<dim> fields_at(const Quadrature<dim> &cell, std::size_t q, std::span<const double> x) {
  Point<dim> p;
  Tensor<dim> h = Tensor<dim>::Zero();
  double around = 0;
  const double *first = &x[unknown<dim>(cell.nodes[0], 0)];
  for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
    const double *at = &x[unknown<dim>(cell.nodes[a], 0)];
    const Vector<dim> g = gradient(cell, q, a);
    for (int i = 0; i < dim; ++i)
      h.row(i) += (at[i] - first[i]) * g.transpose();
    around += cell.around(q, a) * at[0];
    p.potential_gradient += (at[dim] - first[dim]) * g;
    p.temperature_gradient += (at[dim + 1] - first[dim + 1]) * g;
    p.temperature += cell.value(q, a) * at[dim + 1];
  }
  p.strain = voigt_of(h, around);
  return p;
}

// What of p one field makes, with the modes' amplitudes that the same field causes.
template <int dim>
Point<dim> part_of(const Point<dim> &p, int field, const Quadrature<dim> &cell, std::size_t q,
                   const Amplitudes<dim> &modes) {
  Point<dim> part;
  part.strain = field == 0 ? p.strain : Strain<dim>::Zero().eval();
  if (field == 1)
    part.potential_gradient = p.potential_gradient;
  if (field == 2)
    part.temperature = p.temperature;
  if (cell.mode_gradients.empty())
    return part;
  Tensor<dim> h = Tensor<dim>::Zero();
  double around = 0;
  for (int m = 0; m < dim; ++m) {
    const Vector<dim> g = Eigen::Map<const Vector<dim>>(cell.mode_gradients[q * dim + m].data());
    h += modes.template segment<dim>(dim * m) * g.transpose();
    around += cell.mode_around(q, m) * modes[dim * m];
    part.potential_gradient += modes[CellModes<dim>::n_displacement + m] * g;
  }
  part.strain += voigt_of(h, around);
  return part;
}

// The amplitudes that each field of x causes; of u and phi only differences to the first node do,
// as long as no strain around an axis comes from u itself.
template <int dim>
std::array<Amplitudes<dim>, 3> amplitudes(const CellModes<dim> &cell, bool is_revolved,
                                          std::span<const double> x) {
  constexpr int n = Fields<dim>::count;
  std::array<Amplitudes<dim>, 3> by_field;
  by_field.fill(Amplitudes<dim>::Zero());
  std::array<double, dim + 1> first{};
  std::copy_n(&x[unknown<dim>(cell.nodes[0], 0)], dim + 1, first.begin());
  if (is_revolved)
    first[0] = 0;
  for (int b = 0; b < CellModes<dim>::n_nodes; ++b) {
    const double *at = &x[unknown<dim>(cell.nodes[b], 0)];
    for (int c = 0; c < dim + 1; ++c)
      by_field[c < dim ? 0 : 1] += cell.response.col(n * b + c) * (at[c] - first[c]);
    by_field[2] += cell.response.col(n * b + dim + 1) * at[dim + 1];
  }
  return by_field;
}

}  // namespace

// Forces and charges of each node, and a heat that is not a derivative, by the field they come
// from.
template <int dim>
struct CellProducts<dim>::Rows {
  static constexpr int n = Fields<dim>::count;
  using Row = Eigen::Matrix<double, n, 1>;

  explicit Rows(std::size_t n_nodes) {
    for (auto &rows : of)
      rows.assign(n_nodes, Row::Zero());
  }

  // stress and charge are tested by gradients: the first node's share is what the others' lack.
  void add(int field, const Quadrature<dim> &cell, std::size_t q, const Strain<dim> &stress,
           const Vector<dim> &charge, double heat) {
    const Tensor<dim> tensor = stress_tensor(stress);
    for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
      of[field][a][n - 1] += cell.jxw[q] * cell.value(q, a) * heat;
      of[field][a][0] += cell.jxw[q] * cell.around(q, a) * stress_around(stress);
      if (a == 0)
        continue;
      const Vector<dim> g = cell.jxw[q] * gradient(cell, q, a);
      Row tested = Row::Zero();
      tested.template head<dim>() = tensor * g;
      tested[dim] = charge.dot(g);
      of[field][a] += tested;
      of[field][0] -= tested;
    }
  }

  std::array<std::vector<Row>, 3> of;
};

template <int dim>
CellProducts<dim>::CellProducts(const Discretisation<dim> &body,
                                const material::Composition<dim> &composition,
                                const std::vector<CellModes<dim>> &modes)
    : body_(body), composition_(composition), modes_(modes) {}

template <int dim>
void CellProducts<dim>::add_exchange(const std::vector<std::string> &boundaries,
                                     const casefile::Formula &coefficient) {
  exchanges_.push_back({boundaries, &coefficient, 1});
}

template <int dim>
void CellProducts<dim>::add_capacitors(const std::vector<std::string> &boundaries,
                                       const casefile::Formula &coefficient, double factor) {
  capacitors_.push_back({boundaries, &coefficient, factor});
}

template <int dim>
void CellProducts<dim>::storage(std::span<const double> x, FieldProducts &products) const {
  for (std::vector<double> &product : products.of)
    product.assign(x.size(), 0.);
  std::size_t number = 0;
  const auto add_cell = [&](const Quadrature<dim> &cell) {
    const material::BodyConstants<dim> c = composition_.at(cell.region, cell.centre());
    std::array<Amplitudes<dim>, 3> modes;
    if (!modes_.empty())
      modes = amplitudes(modes_[number++], !cell.inverse_radius.empty(), x);
    Rows rows(cell.nodes.size());
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      const Point<dim> all = fields_at(cell, q, x);
      for (int field = 0; field < 3; ++field) {
        const Point<dim> p = part_of(all, field, cell, q, modes[field]);
        const Strain<dim> stress = c.stiffness * p.strain +
                                   c.piezoelectric.transpose() * p.potential_gradient -
                                   c.thermal_stress * p.temperature;
        rows.add(field, cell, q, stress,
                 c.piezoelectric * p.strain - c.permittivity * p.potential_gradient +
                     c.pyroelectric * p.temperature,
                 c.pyroelectric.dot(p.potential_gradient) - c.thermal_stress.dot(p.strain) -
                     c.heat_capacity * p.temperature);
      }
    }
    for (int field = 0; field < 3; ++field)
      for (std::size_t a = 0; a < cell.nodes.size(); ++a)
        for (int i = 0; i < Rows::n; ++i)
          products.of[field][unknown<dim>(cell.nodes[a], i)] += rows.of[field][a][i];
  };
  body_.for_each_cell(add_cell, modes_.empty() ? Modes::none : Modes::incompatible);
}

template <int dim>
void CellProducts<dim>::conduction(std::span<const double> x, std::vector<double> &taken) const {
  body_.for_each_cell([&](const Quadrature<dim> &cell) {
    const material::BodyConstants<dim> c = composition_.at(cell.region, cell.centre());
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      const Vector<dim> flow =
          cell.jxw[q] * (c.conductivity * fields_at(cell, q, x).temperature_gradient);
      for (std::size_t a = 1; a < cell.nodes.size(); ++a) {
        const double tested = gradient(cell, q, a).dot(flow);
        taken[cell.nodes[a]] += tested;
        taken[cell.nodes[0]] -= tested;
      }
    }
  });
  exchange(exchanges_, Fields<dim>::temperature, x, taken);
}

template <int dim>
void CellProducts<dim>::exchange(const std::vector<Exchange> &exchanges, int component,
                                 std::span<const double> x, std::vector<double> &taken) const {
  for (const Exchange &exchange : exchanges)
    body_.for_each_facet(exchange.boundaries, [&](const Quadrature<dim> &facet) {
      for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
        double value = 0;
        for (std::size_t a = 0; a < facet.nodes.size(); ++a)
          value += facet.value(q, a) * x[unknown<dim>(facet.nodes[a], component)];
        const double flow = exchange.factor * exchange.coefficient->value(facet.points[q], 0) *
                            facet.jxw[q] * value;
        for (std::size_t a = 0; a < facet.nodes.size(); ++a)
          taken[facet.nodes[a]] += facet.value(q, a) * flow;
      }
    });
}

template <int dim>
void CellProducts<dim>::multiply_by_field(std::span<const double> x,
                                          FieldProducts &products) const {
  parallel::together([&] { storage(x, products); });
  for (std::vector<double> &product : products.of)
    parallel::sum(product);
}

template <int dim>
std::vector<double> CellProducts<dim>::conducted(std::span<const double> x) const {
  std::vector<double> taken(body_.n_nodes(), 0.);
  parallel::together([&] { conduction(x, taken); });
  parallel::sum(taken);
  return taken;
}

template <int dim>
std::vector<double> CellProducts<dim>::held_by_capacitors(std::span<const double> x) const {
  if (capacitors_.empty())
    return {};
  std::vector<double> held(body_.n_nodes(), 0.);
  parallel::together([&] { exchange(capacitors_, Fields<dim>::potential, x, held); });
  parallel::sum(held);
  return held;
}

template <int dim>
std::vector<Energies> CellProducts<dim>::stored(std::span<const double> x,
                                                std::size_t n_regions) const {
  std::vector<double> sums(4 * n_regions, 0.);
  std::size_t number = 0;
  const auto add_cell = [&](const Quadrature<dim> &cell) {
    const material::BodyConstants<dim> c = composition_.at(cell.region, cell.centre());
    std::array<Amplitudes<dim>, 3> modes;
    if (!modes_.empty())
      modes = amplitudes(modes_[number++], !cell.inverse_radius.empty(), x);
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      const Point<dim> all = fields_at(cell, q, x);
      Point<dim> p;
      p.strain.setZero();
      for (int field = 0; field < 3; ++field) {
        const Point<dim> part = part_of(all, field, cell, q, modes[field]);
        p.strain += part.strain;
        p.potential_gradient += part.potential_gradient;
      }
      double *sum = &sums[4 * cell.region];
      sum[0] += cell.jxw[q] * p.strain.dot(c.stiffness * p.strain) / 2;
      sum[1] += cell.jxw[q] * p.potential_gradient.dot(c.permittivity * p.potential_gradient) / 2;
      sum[2] += cell.jxw[q] * c.heat_capacity * all.temperature * all.temperature / 2;
      sum[3] -= cell.jxw[q] * c.pyroelectric.dot(p.potential_gradient) * all.temperature;
    }
  };
  parallel::together(
      [&] { body_.for_each_cell(add_cell, modes_.empty() ? Modes::none : Modes::incompatible); });
  parallel::sum(sums);
  std::vector<Energies> energies;
  for (std::size_t r = 0; r < sums.size(); r += 4)
    energies.push_back({sums[r], sums[r + 1], sums[r + 2], sums[r + 3]});
  return energies;
}

template <int dim>
void CellProducts<dim>::multiply(double step, std::span<const double> x,
                                 std::span<double> y) const {
  FieldProducts products;
  std::vector<double> taken(body_.n_nodes(), 0.), held(body_.n_nodes(), 0.);
  parallel::together([&] {
    storage(x, products);
    conduction(x, taken);
    exchange(capacitors_, Fields<dim>::potential, x, held);
  });
  for (std::size_t i = 0; i < x.size(); ++i)
    y[i] = products.sum(i);
  for (Node node = 0; node < taken.size(); ++node)
    y[unknown<dim>(node, Fields<dim>::temperature)] -=
        step / composition_.reference_temperature() * taken[node];
  for (Node node = 0; !capacitors_.empty() && node < held.size(); ++node)
    y[unknown<dim>(node, Fields<dim>::potential)] -= held[node];
  if (with_rates_)
    with_rates_->add_rate_share(step, x, y);
  parallel::sum(y);
}

template <int dim>
void CellProducts<dim>::add_history(std::span<const double> x, std::span<double> y) const {
  FieldProducts products;
  multiply_by_field(x, products);
  for (std::size_t i = Fields<dim>::temperature; i < y.size(); i += Fields<dim>::count)
    y[i] += products.sum(i);
}

template class CellProducts<2>;
template class CellProducts<3>;

}  // namespace tourmaline::body
