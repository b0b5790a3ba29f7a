#pragma once

#include "../cases/run_case.h"
#include "mesh/mesh.h"
#include "problem.h"

namespace tourmaline::verified {

/// Norms of the error over those of the solution, for u, phi and theta: of the values (L2) and of
/// the gradients (H1).
struct Errors {
  std::array<double, 3> l2{}, h1{};
};

template <int dim>
class ErrorNorms {
 public:
  ErrorNorms(const Manufactured<dim> &exact, double time) : time_(time) {
    for (int c = 0; c < dim + 2; ++c) {
      value_.emplace_back(exact.value(c));
      for (int axis = 0; axis < dim; ++axis)
        slope_.emplace_back(exact.slope(c, axis));
    }
  }

  // The rule has one point more than the degree along each axis: no point where the gradient
  // superconverges.
  Errors of(const body::Discretisation<dim> &body, const std::vector<double> &state) {
    body.for_each_cell([&](const body::Quadrature<dim> &cell) {
      for (std::size_t q = 0; q < cell.jxw.size(); ++q)
        for (int c = 0; c < dim + 2; ++c)
          add(cell, q, c, state);
    });
    Errors errors;
    for (int f = 0; f < 3; ++f) {
      errors.l2[f] = std::sqrt(l2_[f].error / l2_[f].size);
      errors.h1[f] = std::sqrt(h1_[f].error / h1_[f].size);
    }
    return errors;
  }

 private:
  struct Squares {
    double error = 0, size = 0;

    void add(double weight, double exact, double computed) {
      error += weight * (computed - exact) * (computed - exact);
      size += weight * exact * exact;
    }
  };

  void add(const body::Quadrature<dim> &cell, std::size_t q, int c,
           const std::vector<double> &state) {
    double value = 0;
    Vector<dim> gradient = Vector<dim>::Zero();
    for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
      const double nodal = state[body::unknown<dim>(cell.nodes[a], c)];
      value += nodal * cell.value(q, a);
      gradient += nodal * Eigen::Map<const Vector<dim>>(cell.gradient(q, a).data());
    }
    const int field = std::max(0, c - dim + 1);
    l2_[field].add(cell.jxw[q], value_[c].value(cell.points[q], time_), value);
    for (int axis = 0; axis < dim; ++axis)
      h1_[field].add(cell.jxw[q], slope_[dim * c + axis].value(cell.points[q], time_),
                     gradient[axis]);
  }

  double time_;
  std::vector<casefile::Formula> value_, slope_;
  std::array<Squares, 3> l2_, h1_;
};

/// The unknowns of all nodes, as nodes.csv has them.
template <int dim>
std::vector<double> last_state(const Table &nodes) {
  std::vector<std::string> columns{"u_x", "u_y", "u_z"};
  columns.resize(dim);
  columns.insert(columns.end(), {"potential", "temperature"});
  std::vector<double> state(nodes.n_rows() * columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::vector<double> values = nodes.numbers(columns[c]);
    for (std::size_t i = 0; i < values.size(); ++i)
      state[columns.size() * i + c] = values[i];
  }
  return state;
}

template <int dim>
Errors errors_of_run(const Problem<dim> &problem, const RunCase &run) {
  const body::Discretisation<dim> body(mesh::build<dim>(problem.asked.mesh),
                                       problem.asked.mesh.degree);
  return ErrorNorms<dim>(problem.exact, problem.asked.time.end)
      .of(body, last_state<dim>(run.nodes()));
}

}  // namespace tourmaline::verified
