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

template <int dim>
using Amplitudes = typename CellModes<dim>::Amplitudes;

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

template <int dim>
Point<dim> whole_of(const Point<dim> &p, const Quadrature<dim> &cell, std::size_t q,
                    const std::array<Amplitudes<dim>, 3> &modes) {
  if (cell.mode_gradients.empty())
    return p;
  Point<dim> whole = part_of(p, 0, cell, q, modes[0]);
  for (int field = 1; field < 3; ++field) {
    const Point<dim> part = part_of(p, field, cell, q, modes[field]);
    whole.strain += part.strain;
    whole.potential_gradient += part.potential_gradient;
  }
  whole.temperature = p.temperature;
  whole.temperature_gradient = p.temperature_gradient;
  return whole;
}

// Stress, charge and a heat that is not a derivative.
template <int dim>
struct Response {
  Strain<dim> stress;
  Vector<dim> charge;
  double heat;
};

template <int dim>
Response<dim> response_of(const material::BodyConstants<dim> &c, const Point<dim> &p) {
  return {c.stiffness * p.strain + c.piezoelectric.transpose() * p.potential_gradient -
              c.thermal_stress * p.temperature,
          c.piezoelectric * p.strain - c.permittivity * p.potential_gradient +
              c.pyroelectric * p.temperature,
          c.pyroelectric.dot(p.potential_gradient) - c.thermal_stress.dot(p.strain) -
              c.heat_capacity * p.temperature};
}

// Adds the heat that flows out of each node.
template <int dim>
void conduct(const Quadrature<dim> &cell, std::size_t q, const Tensor<dim> &conductivity,
             const Vector<dim> &temperature_gradient, std::vector<double> &taken) {
  const Vector<dim> flow = cell.jxw[q] * (conductivity * temperature_gradient);
  for (std::size_t a = 1; a < cell.nodes.size(); ++a) {
    const double tested = gradient(cell, q, a).dot(flow);
    taken[cell.nodes[a]] += tested;
    taken[cell.nodes[0]] -= tested;
  }
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

// What a cell adds to the rows of its nodes.
template <int dim>
struct CellProducts<dim>::Rows {
  static constexpr int n = Fields<dim>::count;
  using Row = Eigen::Matrix<double, n, 1>;

  // stress and charge are tested by gradients: the first node's share is what the others' lack.
  void add(const Quadrature<dim> &cell, std::size_t q, const Response<dim> &response) {
    const Tensor<dim> tensor = stress_tensor(response.stress);
    for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
      of[a][n - 1] += cell.jxw[q] * cell.value(q, a) * response.heat;
      of[a][0] += cell.jxw[q] * cell.around(q, a) * stress_around(response.stress);
      if (a == 0)
        continue;
      const Vector<dim> g = cell.jxw[q] * gradient(cell, q, a);
      Row tested = Row::Zero();
      tested.template head<dim>() = tensor * g;
      tested[dim] = response.charge.dot(g);
      of[a] += tested;
      of[0] -= tested;
    }
  }

  void add_to(std::span<double> product, const std::vector<Node> &nodes) const {
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int i = 0; i < n; ++i)
        product[unknown<dim>(nodes[a], i)] += of[a][i];
  }

  std::vector<Row> of;
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
void CellProducts<dim>::for_each_cell(std::span<const double> x, const Visit &visit) const {
  std::size_t number = 0;
  const auto visit_cell = [&](const Quadrature<dim> &cell) {
    std::array<Amplitudes<dim>, 3> modes;
    if (!modes_.empty())
      modes = amplitudes(modes_[number++], !cell.inverse_radius.empty(), x);
    visit(cell, composition_.at(cell.region, cell.centre()), modes);
  };
  body_.for_each_cell(visit_cell, modes_.empty() ? Modes::none : Modes::incompatible);
}

template <int dim>
void CellProducts<dim>::storage(std::span<const double> x, FieldProducts &products) const {
  for (std::vector<double> &product : products.of)
    product.assign(x.size(), 0.);
  std::array<Rows, 3> rows;
  for_each_cell(x, [&](const Quadrature<dim> &cell, const Constants &c, const CellAmplitudes &m) {
    for (int field = 0; field < 3; ++field)
      rows[field].of.assign(cell.nodes.size(), Rows::Row::Zero());
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      const Point<dim> all = fields_at(cell, q, x);
      for (int field = 0; field < 3; ++field)
        rows[field].add(cell, q, response_of(c, part_of(all, field, cell, q, m[field])));
    }
    for (int field = 0; field < 3; ++field)
      rows[field].add_to(products.of[field], cell.nodes);
  });
}

template <int dim>
void CellProducts<dim>::conduction(std::span<const double> x, std::vector<double> &taken) const {
  body_.for_each_cell([&](const Quadrature<dim> &cell) {
    const Constants c = composition_.at(cell.region, cell.centre());
    for (std::size_t q = 0; q < cell.jxw.size(); ++q)
      conduct<dim>(cell, q, c.conductivity, fields_at(cell, q, x).temperature_gradient, taken);
  });
  exchange(exchanges_, Fields<dim>::temperature, x, taken);
}

// Storage of all fields together and conduction.
template <int dim>
void CellProducts<dim>::storage_and_conduction(std::span<const double> x, std::span<double> y,
                                               std::vector<double> &taken) const {
  std::fill(y.begin(), y.end(), 0.);
  Rows rows;
  for_each_cell(x, [&](const Quadrature<dim> &cell, const Constants &c, const CellAmplitudes &m) {
    rows.of.assign(cell.nodes.size(), Rows::Row::Zero());
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      const Point<dim> all = fields_at(cell, q, x);
      rows.add(cell, q, response_of(c, whole_of(all, cell, q, m)));
      conduct<dim>(cell, q, c.conductivity, all.temperature_gradient, taken);
    }
    rows.add_to(y, cell.nodes);
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
    body_.sharing().add_up(product);
}

template <int dim>
std::vector<double> CellProducts<dim>::conducted(std::span<const double> x) const {
  std::vector<double> taken(body_.n_nodes(), 0.);
  parallel::together([&] { conduction(x, taken); });
  body_.sharing().add_up(taken);
  return taken;
}

template <int dim>
std::vector<double> CellProducts<dim>::held_by_capacitors(std::span<const double> x) const {
  if (capacitors_.empty())
    return {};
  std::vector<double> held(body_.n_nodes(), 0.);
  parallel::together([&] { exchange(capacitors_, Fields<dim>::potential, x, held); });
  body_.sharing().add_up(held);
  return held;
}

template <int dim>
std::vector<Energies> CellProducts<dim>::stored(std::span<const double> x,
                                                std::size_t n_regions) const {
  std::vector<double> sums(4 * n_regions, 0.);
  const auto add_cell = [&](const Quadrature<dim> &cell, const Constants &c,
                            const CellAmplitudes &modes) {
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      const Point<dim> p = whole_of(fields_at(cell, q, x), cell, q, modes);
      double *sum = &sums[4 * cell.region];
      sum[0] += cell.jxw[q] * p.strain.dot(c.stiffness * p.strain) / 2;
      sum[1] += cell.jxw[q] * p.potential_gradient.dot(c.permittivity * p.potential_gradient) / 2;
      sum[2] += cell.jxw[q] * c.heat_capacity * p.temperature * p.temperature / 2;
      sum[3] -= cell.jxw[q] * c.pyroelectric.dot(p.potential_gradient) * p.temperature;
    }
  };
  parallel::together([&] { for_each_cell(x, add_cell); });
  parallel::sum(sums);
  std::vector<Energies> energies;
  for (std::size_t r = 0; r < sums.size(); r += 4)
    energies.push_back({sums[r], sums[r + 1], sums[r + 2], sums[r + 3]});
  return energies;
}

template <int dim>
void CellProducts<dim>::multiply(double step, std::span<const double> x,
                                 std::span<double> y) const {
  std::vector<double> taken(body_.n_nodes(), 0.), held(body_.n_nodes(), 0.);
  parallel::together([&] {
    storage_and_conduction(x, y, taken);
    exchange(capacitors_, Fields<dim>::potential, x, held);
  });
  for (Node node = 0; node < taken.size(); ++node)
    y[unknown<dim>(node, Fields<dim>::temperature)] -=
        step / composition_.reference_temperature() * taken[node];
  for (Node node = 0; !capacitors_.empty() && node < held.size(); ++node)
    y[unknown<dim>(node, Fields<dim>::potential)] -= held[node];
  if (with_rates_)
    with_rates_->add_rate_share(step, x, y);
  body_.sharing().add_up(y);
}

template class CellProducts<2>;
template class CellProducts<3>;

}  // namespace tourmaline::body
