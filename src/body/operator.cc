#include "tourmaline/body/operator.h"

#include <algorithm>

#include "tourmaline/error.h"

namespace tourmaline::body {

namespace {

template <int dim>
using Strains = Eigen::Matrix<double, material::n_strains<dim>, dim>;

// Strain (engineering shear) of a displacement with shape gradient g, by component: eps(u) = B u.
Strains<2> strain_of(const std::array<double, 2> &g) {
  Strains<2> b;
  b << g[0], 0, 0, g[1], g[1], g[0];
  return b;
}

Strains<3> strain_of(const std::array<double, 3> &g) {
  Strains<3> b;
  b << g[0], 0, 0, 0, g[1], 0, 0, 0, g[2], 0, g[2], g[1], g[2], 0, g[0], g[1], g[0], 0;
  return b;
}

template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;

// What one shape function does at one point: the fields' derivatives, multiplied by the constants.
template <int dim>
struct Trial {
  double value;
  Vector<dim> gradient;
  Strains<dim> strain;
  Strains<dim> stress;                     // F B
  Eigen::Matrix<double, dim, dim> charge;  // E B
  Vector<dim> electric;                    // beta g
  Eigen::Matrix<double, 1, dim> heat;      // M^T B
  double pyroelectric;                     // P . g
};

template <int dim>
Trial<dim> trial(const material::BodyConstants<dim> &c, double value,
                 const std::array<double, static_cast<std::size_t>(dim)> &gradient) {
  Trial<dim> t;
  t.value = value;
  t.gradient = Eigen::Map<const Vector<dim>>(gradient.data());
  t.strain = strain_of(gradient);
  t.stress = c.stiffness * t.strain;
  t.charge = c.piezoelectric * t.strain;
  t.electric = c.permittivity * t.gradient;
  t.heat = c.thermal_stress.transpose() * t.strain;
  t.pyroelectric = c.pyroelectric.dot(t.gradient);
  return t;
}

// The storage operator's block between test function a and trial function b at one point.
template <int dim>
void add_block(const Trial<dim> &a, const Trial<dim> &b, double heat_capacity, double jxw,
               typename Operator<dim>::Block &block) {
  constexpr int phi = Fields<dim>::potential, theta = Fields<dim>::temperature;
  block.template topLeftCorner<dim, dim>() += jxw * a.strain.transpose() * b.stress;
  block.template block<dim, 1>(0, phi) += jxw * a.charge.transpose() * b.gradient;
  block.template block<1, dim>(phi, 0) += jxw * a.gradient.transpose() * b.charge;
  block.template block<dim, 1>(0, theta) -= jxw * b.value * a.heat.transpose();
  block.template block<1, dim>(theta, 0) -= jxw * a.value * b.heat;
  block(phi, phi) -= jxw * a.gradient.dot(b.electric);
  block(phi, theta) += jxw * a.pyroelectric * b.value;
  block(theta, phi) += jxw * a.value * b.pyroelectric;
  block(theta, theta) -= jxw * heat_capacity * a.value * b.value;
}

constexpr int field_of(int component, int dim) {
  return std::max(0, component - dim + 1);
}

}  // namespace

template <int dim>
Operator<dim>::Operator(const Discretisation<dim> &body,
                        const material::BodyConstants<dim> &material)
    : graph_(body.graph()),
      storage_(graph_.column.size(), Block::Zero()),
      conduction_(graph_.column.size(), 0.),
      reference_temperature_(material.reference_temperature) {
  std::vector<Trial<dim>> trials;
  body.for_each_cell([&](const Quadrature<dim> &cell) {
    for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
      trials.clear();
      for (std::size_t a = 0; a < cell.nodes.size(); ++a)
        trials.push_back(trial<dim>(material, cell.value(q, a), cell.gradient(q, a)));
      for (std::size_t a = 0; a < cell.nodes.size(); ++a)
        for (std::size_t b = 0; b < cell.nodes.size(); ++b) {
          const std::size_t entry = entry_of(cell.nodes[a], cell.nodes[b]);
          add_block(trials[a], trials[b], material.heat_capacity, cell.jxw[q], storage_[entry]);
          conduction_[entry] +=
              cell.jxw[q] * trials[a].gradient.dot(material.conductivity * trials[b].gradient);
        }
    }
  });
}

template <int dim>
void Operator<dim>::add_exchange(const Discretisation<dim> &body,
                                 const std::vector<std::string> &boundaries,
                                 const casefile::Formula &coefficient) {
  body.for_each_facet(boundaries, [&](const Quadrature<dim> &facet) {
    for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
      const double k_c = coefficient.value(facet.points[q], 0);
      if (k_c < 0)
        throw CaseError(coefficient.where() + ": the coefficient of heat exchange is negative");
      for (std::size_t a = 0; a < facet.nodes.size(); ++a)
        for (std::size_t b = 0; b < facet.nodes.size(); ++b)
          if (const double v = facet.value(q, a) * facet.value(q, b); v != 0)
            conduction_[entry_of(facet.nodes[a], facet.nodes[b])] += k_c * facet.jxw[q] * v;
    }
  });
}

template <int dim>
std::size_t Operator<dim>::entry_of(Node row, Node column) const {
  const auto begin = graph_.column.begin() + graph_.row[row];
  const auto end = graph_.column.begin() + graph_.row[row + 1];
  return std::lower_bound(begin, end, column) - graph_.column.begin();
}

template <int dim>
typename Operator<dim>::Block Operator<dim>::step_block(std::size_t entry, double step) const {
  constexpr int theta = Fields<dim>::temperature;
  Block block = storage_[entry];
  block(theta, theta) -= step / reference_temperature_ * conduction_[entry];
  return block;
}

template <int dim>
void Operator<dim>::multiply(double step, std::span<const double> x, std::span<double> y) const {
  using Map = Eigen::Map<const Vector<n>>;
  for (Node i = 0; i < graph_.n_nodes(); ++i) {
    Vector<n> sum = Vector<n>::Zero();
    double conducted = 0;
    for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e) {
      const Map xj(&x[unknown<dim>(graph_.column[e], 0)]);
      sum.noalias() += storage_[e] * xj;
      conducted += conduction_[e] * xj[Fields<dim>::temperature];
    }
    sum[Fields<dim>::temperature] -= step / reference_temperature_ * conducted;
    std::copy(sum.begin(), sum.end(), &y[unknown<dim>(i, 0)]);
  }
}

template <int dim>
void Operator<dim>::add_history(std::span<const double> x, std::span<double> y) const {
  constexpr int theta = Fields<dim>::temperature;
  for (Node i = 0; i < graph_.n_nodes(); ++i) {
    double sum = 0;
    for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e)
      sum += storage_[e].row(theta).dot(
          Eigen::Map<const Vector<n>>(&x[unknown<dim>(graph_.column[e], 0)]));
    y[unknown<dim>(i, theta)] += sum;
  }
}

template <int dim>
double Operator<dim>::row_times(std::size_t row, double step, std::span<const double> x) const {
  const Node i = static_cast<Node>(row / n);
  double sum = 0;
  for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e)
    sum += step_block(e, step).row(row % n).dot(
        Eigen::Map<const Vector<n>>(&x[unknown<dim>(graph_.column[e], 0)]));
  return sum;
}

template <int dim>
void Operator<dim>::subtract_column(std::size_t column, double step, double value,
                                    std::span<double> y) const {
  const Node j = static_cast<Node>(column / n);
  for (std::size_t e = graph_.row[j]; e < graph_.row[j + 1]; ++e)
    Eigen::Map<Vector<n>>(&y[unknown<dim>(graph_.column[e], 0)]) -=
        value * step_block(e, step).row(column % n).transpose();
}

template <int dim>
void Operator<dim>::multiply_by_field(std::span<const double> x, FieldProducts &products) const {
  for (std::vector<double> &product : products.of)
    product.resize(x.size());
  for (Node i = 0; i < graph_.n_nodes(); ++i) {
    Vector<n> u = Vector<n>::Zero(), phi = Vector<n>::Zero(), theta = Vector<n>::Zero();
    for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e) {
      const Eigen::Map<const Vector<n>> xj(&x[unknown<dim>(graph_.column[e], 0)]);
      u.noalias() += storage_[e].template leftCols<dim>() * xj.template head<dim>();
      phi += storage_[e].col(Fields<dim>::potential) * xj[Fields<dim>::potential];
      theta += storage_[e].col(Fields<dim>::temperature) * xj[Fields<dim>::temperature];
    }
    std::copy(u.begin(), u.end(), &products.of[0][unknown<dim>(i, 0)]);
    std::copy(phi.begin(), phi.end(), &products.of[1][unknown<dim>(i, 0)]);
    std::copy(theta.begin(), theta.end(), &products.of[2][unknown<dim>(i, 0)]);
  }
}

template <int dim>
std::vector<double> Operator<dim>::conducted(std::span<const double> x) const {
  std::vector<double> taken(graph_.n_nodes(), 0.);
  for (Node i = 0; i < graph_.n_nodes(); ++i)
    for (std::size_t e = graph_.row[i]; e < graph_.row[i + 1]; ++e)
      taken[i] += conduction_[e] * x[unknown<dim>(graph_.column[e], Fields<dim>::temperature)];
  return taken;
}

template class Operator<2>;
template class Operator<3>;

}  // namespace tourmaline::body
