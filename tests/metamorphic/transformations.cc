#include "transformations.h"

#include <algorithm>
#include <numeric>

namespace tourmaline::verified {
namespace {

Eigen::MatrixXd axes_to_axes(int dimension, Random &random) {
  std::vector<int> axes(dimension);
  std::iota(axes.begin(), axes.end(), 0);
  random.shuffle(axes);
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(dimension, dimension);
  for (int i = 0; i < dimension; ++i)
    turn(axes[i], i) = random.chance(0.5) ? 1 : -1;
  return turn;
}

// Another vertex first, the same way round; simplices any way.
void start_elsewhere(std::vector<int> &cell, bool is_simplex, Random &random) {
  if (is_simplex)
    return random.shuffle(cell);
  for (int turns = random.below(4); turns-- > 0;)
    for (auto first = cell.begin(); first != cell.end(); first += 4)
      std::rotate(first, first + 1, first + 4);
}

std::vector<int> random_order(std::size_t n, Random &random) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  random.shuffle(order);
  return order;
}

template <class Entry>
std::vector<Entry> in_order(const std::vector<Entry> &list, const std::vector<int> &order) {
  std::vector<Entry> result;
  for (const int i : order)
    result.push_back(list[i]);
  return result;
}

std::vector<bool> turned(const std::vector<bool> &free, const Eigen::MatrixXd &turn) {
  std::vector<bool> image(free.size());
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t j = 0; j < free.size(); ++j)
      if (turn(i, j) != 0)
        image[i] = free[j];
  return image;
}

}  // namespace

Eigen::MatrixXd random_turn(const Sample &sample, bool mirrors, Random &random) {
  const int dimension = sample.dimension();
  Eigen::MatrixXd turn;
  if (sample.has_free_components())
    turn = axes_to_axes(dimension, random);
  else
    turn = random.matrix(dimension, dimension).householderQr().householderQ();
  if ((turn.determinant() < 0) != mirrors)
    turn.row(0) *= -1;
  return turn;
}

Sample turned(Sample sample, const Eigen::MatrixXd &turn) {
  const bool mirrors = turn.determinant() < 0;
  for (Eigen::VectorXd &point : sample.mesh.points)
    point = turn * point;
  for (SampleMaterial &material : sample.materials) {
    material.poling = turn * material.poling;
    // Axis 2 follows from 3 and 1 by the right hand, so it is axis 1 that a mirror reverses: all
    // classes of the samples have a mirror plane across it.
    material.axis1 = (mirrors ? -1. : 1.) * turn * material.axis1;
  }
  for (Condition &condition : sample.conditions) {
    for (Term &term : condition.terms) {
      term.gradient *= turn.transpose();
      if (term.value.size() == 1)
        continue;
      term.gradient = turn * term.gradient;
      term.value = turn * term.value;
    }
    if (!condition.free.empty())
      condition.free = turned(condition.free, turn);
  }
  return sample;
}

// None in which the program would find a constant out of all sense.
Units random_units(Random &random) {
  return {.length = random.sized(0.3, 3),
          .force = random.sized(1. / 300, 300),
          .voltage = random.sized(0.01, 100),
          .temperature = random.sized(1. / 300, 300),
          .time = random.sized(0.1, 10)};
}

Sample in_units(Sample sample, const Units &units) {
  for (Eigen::VectorXd &point : sample.mesh.points)
    point *= units.length;
  for (SampleMaterial &material : sample.materials)
    for (auto &[key, value] : material.constants)
      value *= units.factor(dimension_of_key(key));
  for (Condition &condition : sample.conditions) {
    const double factor =
        units.factor(dimension_of_key(condition.key, sample.law_of(condition.table)));
    for (Term &term : condition.terms) {
      term.value *= factor;
      term.gradient *= factor / units.length;
    }
    condition.resistor *= units.factor(dimension_of_key("resistor")) *
                          (sample.dimension() == 2 ? units.length : 1);  // of a metre of depth
  }
  for (auto &[key, value] : sample.numbers)
    value *= units.factor(dimension_of_key(key.substr(key.rfind('.') + 1)));
  sample.end *= units.time;
  return sample;
}

Sample renumbered(Sample sample, Random &random) {
  SampleMesh &mesh = sample.mesh;
  const std::vector<int> old = random_order(mesh.points.size(), random),
                         cells = random_order(mesh.cells.size(), random),
                         facets = random_order(mesh.facets.size(), random);
  std::vector<int> now(old.size());
  for (std::size_t i = 0; i < old.size(); ++i)
    now[old[i]] = static_cast<int>(i);
  mesh.points = in_order(mesh.points, old);
  mesh.cells = in_order(mesh.cells, cells);
  mesh.region = in_order(mesh.region, cells);
  mesh.facets = in_order(mesh.facets, facets);
  mesh.side = in_order(mesh.side, facets);
  for (auto *elements : {&mesh.cells, &mesh.facets})
    for (std::vector<int> &element : *elements)
      for (int &vertex : element)
        vertex = now[vertex];
  for (std::vector<int> &cell : mesh.cells)
    start_elsewhere(cell, mesh.simplices, random);
  return sample;
}

Sample superposed(const Sample &one, double a, const Sample &other, double b) {
  Sample sum = one;
  for (std::size_t i = 0; i < sum.conditions.size(); ++i) {
    if (sum.conditions[i].is_law)
      continue;
    std::vector<Term> &terms = sum.conditions[i].terms;
    for (Term &term : terms)
      term = {term.course, a * term.value, a * term.gradient};
    for (const Term &term : other.conditions[i].terms)
      terms.push_back({term.course, b * term.value, b * term.gradient});
  }
  return sum;
}

}  // namespace tourmaline::verified
