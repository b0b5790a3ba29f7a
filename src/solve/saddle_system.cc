#include "solve/saddle_system.h"

#include <algorithm>
#include <cmath>

#include "condensation/ordering.h"
#include "larger.h"
#include "parallel/ranks.h"
#include "stopwatch.h"

namespace tourmaline::solve {

using body::field_of;
using body::Fields;
using body::Node;
using body::unknown;
using contact::Local;
using Eigen::Index;
using Eigen::MatrixXd;

namespace {

// dy/du of a point, columns share by share.
template <int dim>
MatrixXd jacobian(const contact::MultiplierPoint<dim> &point) {
  MatrixXd j(point.n_multipliers(), dim * static_cast<Index>(point.mean.size()));
  for (std::size_t a = 0; a < point.mean.size(); ++a)
    j.middleCols(dim * static_cast<Index>(a), dim) =
        point.mean[a].factor * point.directions.transpose();
  return j;
}

}  // namespace

template <int dim>
SaddleSystem<dim>::SaddleSystem(const body::Operator<dim> &op, double step,
                                const std::vector<body::Prescribed> &prescribed,
                                std::vector<Point> points, const std::vector<std::size_t> &crossing,
                                int threads)
    : operator_(op),
      step_(step),
      points_(std::move(points)),
      crossing_(crossing),
      slope_(Eigen::VectorXd::Zero(static_cast<Index>(crossing.size()))) {
  const std::vector<double> diagonal = op.diagonal(step);
  field_scale_ = op.scales(diagonal);
  number(prescribed);
  set_scales();
  for (const Point &point : points_) {
    double stiffness = 0;
    for (const auto &share : point.mean)
      for (int c = 0; c < dim; ++c)
        stiffness += share.factor * diagonal[unknown<dim>(share.node, c)] / dim;
    stiffness_.push_back(stiffness / point.weight);
  }
  condensation::SymmetricMatrix matrix =
      condensation::scaled_matrix(operator_, step_, variable_of_, scale_);
  n_body_entries_ = matrix.value.size();
  add_contact_pattern(matrix);
  add_crossing_pattern(matrix);
  factorisation_.emplace(std::move(matrix), elimination_order(), threads);
}

template <int dim>
void SaddleSystem<dim>::number(const std::vector<body::Prescribed> &prescribed) {
  variable_of_.assign(operator_.graph().n_nodes() * Fields<dim>::count, 0);
  zero_.assign(variable_of_.size(), 0.);
  for (const body::Prescribed &p : prescribed)
    variable_of_[p.unknown] = -1;
  for (std::size_t i = 0; i < variable_of_.size(); ++i)
    if (variable_of_[i] == 0) {
      variable_of_[i] = static_cast<int>(unknown_of_.size());
      unknown_of_.push_back(i);
    }
  std::size_t next = 0;
  for (const Point &point : points_) {
    offset_.push_back(next);
    next += static_cast<std::size_t>(point.n_multipliers());
  }
}

template <int dim>
void SaddleSystem<dim>::set_scales() {
  for (const std::size_t i : unknown_of_)
    scale_.push_back(field_scale_[i % Fields<dim>::count]);
  // The coupling w dy/du between a multiplier and a displacement then has entries of the size 1.
  for (const Point &point : points_)
    scale_.insert(scale_.end(), point.n_multipliers(), 1 / (field_scale_[0] * point.weight));
}

template <int dim>
std::size_t SaddleSystem<dim>::n_electric_and_thermal() const {
  return std::count_if(unknown_of_.begin(), unknown_of_.end(),
                       [](std::size_t i) { return field_of<dim>(i) > 0; });
}

// Variables of a point: its nodes' displacements, share by share (-1: prescribed), its multipliers.
template <int dim>
std::vector<int> SaddleSystem<dim>::local_variables(std::size_t point) const {
  std::vector<int> variables;
  for (const auto &share : points_[point].mean)
    for (int c = 0; c < dim; ++c)
      variables.push_back(variable_of_[unknown<dim>(share.node, c)]);
  for (Index k = 0; k < points_[point].n_multipliers(); ++k)
    variables.push_back(static_cast<int>(unknown_of_.size() + offset_[point] + k));
  return variables;
}

template <int dim>
void SaddleSystem<dim>::add_contact_pattern(condensation::SymmetricMatrix &matrix) const {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::vector<int> variables = local_variables(p);
    for (std::size_t a = 0; a < variables.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b)
        if (variables[a] >= 0 && variables[b] >= 0) {
          matrix.row.push_back(std::max(variables[a], variables[b]) + 1);
          matrix.column.push_back(std::min(variables[a], variables[b]) + 1);
          matrix.value.push_back(0);
        }
  }
}

template <int dim>
void SaddleSystem<dim>::add_crossing_pattern(condensation::SymmetricMatrix &matrix) const {
  for (const std::size_t unknown : crossing_) {
    matrix.row.push_back(variable_of_[unknown] + 1);
    matrix.column.push_back(variable_of_[unknown] + 1);
    matrix.value.push_back(0);
  }
}

// Nodes in the order of nested dissection, each with its unknowns; a multiplier behind the last of
// the nodes that it acts on, where elimination has made its zero on the diagonal a pivot.
template <int dim>
std::vector<int> SaddleSystem<dim>::elimination_order() const {
  const std::size_t n_nodes = operator_.graph().n_nodes();
  condensation::NodeUnknowns unknowns{std::vector<int>(n_nodes, 0), std::vector<int>(n_nodes, 0)};
  for (const std::size_t i : unknown_of_)
    ++unknowns.eliminated[i / Fields<dim>::count];
  const std::vector<int> node_position =
      condensation::nested_dissection(operator_.graph(), unknowns, dim);
  std::vector<std::vector<int>> variables_at(n_nodes);  // by place of the node
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    variables_at[node_position[unknown_of_[v] / Fields<dim>::count]].push_back(static_cast<int>(v));
  for (std::size_t p = 0; p < points_.size(); ++p) {
    int last = 0;
    for (const auto &share : points_[p].mean)
      last = std::max(last, node_position[share.node]);
    for (Index k = 0; k < points_[p].n_multipliers(); ++k)
      variables_at[last].push_back(static_cast<int>(unknown_of_.size() + offset_[p] + k));
  }
  std::vector<int> position(scale_.size());
  int next = 0;
  for (const std::vector<int> &variables : variables_at)
    for (const int v : variables)
      position[v] = next++;
  return position;
}

template <int dim>
Local SaddleSystem<dim>::displacement(std::size_t point, const SaddlePoint &x,
                                      const StepData &data) const {
  return points_[point].displacement(x.body, data.before, data.rest);
}

template <int dim>
Local SaddleSystem<dim>::change(std::size_t point, const SaddlePoint &x) const {
  return points_[point].displacement(x.body, zero_, zero_);
}

template <int dim>
Local SaddleSystem<dim>::multiplier(std::size_t point, const SaddlePoint &x) const {
  return x.multipliers.segment(static_cast<Index>(offset_[point]), points_[point].n_multipliers());
}

template <int dim>
void SaddleSystem<dim>::set_multiplier(std::size_t point, const Local &value,
                                       SaddlePoint &x) const {
  x.multipliers.segment(static_cast<Index>(offset_[point]), value.size()) = value;
}

template <int dim>
SaddlePoint SaddleSystem<dim>::residual(const StepData &data, const SaddlePoint &x) const {
  SaddlePoint r{body_times(x.body), Eigen::VectorXd(x.multipliers.size())};  // (38), (39)
  for (std::size_t i = 0; i < r.body.size(); ++i)
    r.body[i] -= data.right_side[i];
  for (std::size_t p = 0; p < points_.size(); ++p) {  // (42)
    const Point &point = points_[p];
    const auto gradient = data.laws[p].gradient(displacement(p, x, data), multiplier(p, x));
    for (const auto &share : point.mean)
      Eigen::Map<typename Point::Vector>(&r.body[unknown<dim>(share.node, 0)]) +=
          point.weight * share.factor * point.directions * gradient.traction;
    set_multiplier(p, point.weight * gradient.condition, r);
  }
  for (std::size_t i = 0; i < r.body.size(); ++i)
    if (!is_free(i))
      r.body[i] = 0;
  return r;
}

template <int dim>
std::vector<double> SaddleSystem<dim>::body_times(const std::vector<double> &x) const {
  std::vector<double> y(x.size());
  operator_.multiply(step_, x, y);
  for (std::size_t k = 0; k < crossing_.size(); ++k)
    y[crossing_[k]] -= slope_[static_cast<Index>(k)] * x[crossing_[k]];
  return y;
}

template <int dim>
double SaddleSystem<dim>::largest_displacement(const SaddlePoint &x) const {
  double largest = 0;
  for (std::size_t i = 0; i < x.body.size(); ++i)
    if (field_of<dim>(i) == 0)
      largest = larger(largest, std::abs(x.body[i]));
  return largest;
}

template <int dim>
typename SaddleSystem<dim>::RowSizes SaddleSystem<dim>::row_sizes(const StepData &data,
                                                                  const SaddlePoint &x) const {
  std::vector<double> terms = operator_.sizes(step_, x.body);
  for (std::size_t k = 0; k < crossing_.size(); ++k)
    terms[crossing_[k]] += std::abs(slope_[static_cast<Index>(k)] * x.body[crossing_[k]]);
  const auto size = [&](std::size_t i) { return std::abs(data.right_side[i]) + terms[i]; };
  RowSizes sizes;
  for (const std::size_t i : unknown_of_) {
    double &largest = sizes.of_field[field_of<dim>(i)];
    largest = larger(largest, size(i));
  }
  for (const Point &point : points_) {
    double &largest = sizes.at_point.emplace_back(0);
    for (const auto &share : point.mean)
      for (int c = 0; c < dim; ++c)
        if (const std::size_t i = body::unknown<dim>(share.node, c); is_free(i))
          largest = larger(largest, size(i));
  }
  return sizes;
}

template <int dim>
std::array<double, 3> SaddleSystem<dim>::largest_rows(const SaddlePoint &residual) const {
  std::array<double, 3> largest{};
  for (const std::size_t i : unknown_of_)
    largest[field_of<dim>(i)] = larger(largest[field_of<dim>(i)], std::abs(residual.body[i]));
  return largest;
}

template <int dim>
MatrixXd SaddleSystem<dim>::local_tangent(
    const Point &point, const contact::AugmentedLagrangian::Hessian &hessian) const {
  const MatrixXd j = jacobian(point);
  MatrixXd tangent(j.cols() + j.rows(), j.cols() + j.rows());
  tangent << j.transpose() * hessian.displacement * j, j.transpose() * hessian.mixed,
      hessian.mixed.transpose() * j, hessian.multiplier;
  return point.weight * tangent;
}

// The body's part of the tangent never changes; the contact tangent T and slopes stand behind it
// and are written anew in the order of their patterns, on the first rank: entries of all ranks are
// added.
template <int dim>
void SaddleSystem<dim>::factorise(const StepData &data, const SaddlePoint &x) {
  std::size_t entry = n_body_entries_;
  std::vector<double> &values = factorisation_->values();
  for (std::size_t p = 0; parallel::is_first() && p < points_.size(); ++p) {
    const std::vector<int> variables = local_variables(p);
    const MatrixXd tangent =
        local_tangent(points_[p], data.laws[p].hessian(displacement(p, x, data), multiplier(p, x)));
    for (std::size_t a = 0; a < variables.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b)
        if (variables[a] >= 0 && variables[b] >= 0)
          values[entry++] = tangent(static_cast<Index>(a), static_cast<Index>(b)) *
                            scale_[variables[a]] * scale_[variables[b]];
  }
  for (std::size_t k = 0; parallel::is_first() && k < crossing_.size(); ++k)
    values[entry++] = -slope_[static_cast<Index>(k)] *
                      std::pow(scale_[static_cast<std::size_t>(variable_of_[crossing_[k]])], 2);
  factorisation_->factorise();
}

template <int dim>
SaddlePoint SaddleSystem<dim>::increment(const SaddlePoint &residual) {
  std::vector<double> variables = scaled(residual);
  Stopwatch watch;
  factorisation_->solve(variables);
  substitution_seconds_ += watch.lap();
  SaddlePoint increment = unscaled(variables);
  for (double &value : increment.body)
    value = -value;
  increment.multipliers = -increment.multipliers;
  return increment;
}

template <int dim>
std::vector<double> SaddleSystem<dim>::scaled(const SaddlePoint &x) const {
  std::vector<double> variables;
  for (const std::size_t i : unknown_of_)
    variables.push_back(x.body[i]);
  variables.insert(variables.end(), x.multipliers.begin(), x.multipliers.end());
  for (std::size_t v = 0; v < variables.size(); ++v)
    variables[v] *= scale_[v];
  return variables;
}

template <int dim>
SaddlePoint SaddleSystem<dim>::unscaled(const std::vector<double> &variables) const {
  SaddlePoint x{std::vector<double>(variable_of_.size(), 0.),
                Eigen::VectorXd(static_cast<Index>(n_multipliers()))};
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    x.body[unknown_of_[v]] = variables[v] * scale_[v];
  for (std::size_t v = unknown_of_.size(); v < variables.size(); ++v)
    x.multipliers[static_cast<Index>(v - unknown_of_.size())] = variables[v] * scale_[v];
  return x;
}

template class SaddleSystem<2>;
template class SaddleSystem<3>;

}  // namespace tourmaline::solve
