#include "solve/kept_factor.h"

#include <algorithm>

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;
using Sparse = InterfaceSystem::Sparse;

namespace {

constexpr double reduction = 3e-2;  // the next Newton iteration takes what is left
constexpr std::size_t most_products = 12;
constexpr double usual_products = 2;
// A factor of n rows costs as much as some n / 100 products with what belongs to them (measured at
// n = 7,000): when so many more than usual were needed, another one would have been worth it.
constexpr double rows_by_product = 100;

// Column `unknown` of the system's matrix for the rows from `first` on.
template <class Block>
void add_local(const InterfaceSystem &system, Block &&block) {
  std::vector<Index> column_of(static_cast<std::size_t>(system.local.cols()), -1);
  for (Index k = 0; k < system.size(); ++k)
    column_of[static_cast<std::size_t>(system.unknowns[static_cast<std::size_t>(k)])] = k;
  using Scalar = typename std::decay_t<Block>::Scalar;
  for (Index row = 0; row < system.local.outerSize(); ++row)
    for (Sparse::InnerIterator it(system.local, row); it; ++it)
      if (const Index k = column_of[static_cast<std::size_t>(it.col())]; k >= 0)
        block(row, k) += static_cast<Scalar>(it.value());
}

// M, by groups of columns: a copy of A's would take as much memory as A.
template <class Matrix>
Matrix matrix_of(const InterfaceSystem &system, const MatrixXd &a) {
  constexpr Index group = 256;
  Matrix m = Matrix::Zero(system.size(), system.size());
  const auto of_a = static_cast<Index>(
      std::lower_bound(system.unknowns.begin(), system.unknowns.end(), a.cols()) -
      system.unknowns.begin());
  for (Index first = 0; first < of_a; first += group) {
    const Index n = std::min(group, of_a - first);
    const std::vector<Index> columns(system.unknowns.begin() + first,
                                     system.unknowns.begin() + first + n);
    const MatrixXd some = system.of_force * a(Eigen::all, columns);
    m.middleCols(first, n) = some.template cast<typename Matrix::Scalar>();
  }
  add_local(system, m);
  return m;
}

KeptFactor::Solved spread(const InterfaceSystem &system, const MatrixXd &a, const VectorXd &x) {
  KeptFactor::Solved all{VectorXd::Zero(system.local.cols()), {}};
  all.x(system.unknowns) = x;
  all.resisted = symmetric_product(a, all.x.head(a.cols()));
  return all;
}

// M x.
VectorXd product(const InterfaceSystem &system, const KeptFactor::Solved &x) {
  return system.of_force * x.resisted + system.local * x.x;
}

// The diagonal of M.
VectorXd diagonal_of(const InterfaceSystem &system, const MatrixXd &a) {
  VectorXd diagonal(system.size());
  for (Index k = 0; k < system.size(); ++k) {
    const Index unknown = system.unknowns[static_cast<std::size_t>(k)];
    diagonal[k] = system.local.coeff(k, unknown);
    if (unknown < a.cols())
      for (Sparse::InnerIterator it(system.of_force, k); it; ++it)
        diagonal[k] += it.value() * a(it.col(), unknown);
  }
  return diagonal;
}

/// A part of the solution and M times it, which has the size 1.
struct Direction {
  KeptFactor::Solved moved;
  VectorXd product;

  void add(double factor, const Direction &other) {
    moved.x += factor * other.moved.x;
    moved.resisted += factor * other.moved.resisted;
    product += factor * other.product;
  }
  void scale(double factor) {
    moved.x *= factor;
    moved.resisted *= factor;
    product *= factor;
  }
};

std::vector<double> as_numbers(const Sparse &matrix) {
  std::vector<double> numbers;
  for (Index row = 0; row < matrix.outerSize(); ++row)
    for (Sparse::InnerIterator it(matrix, row); it; ++it)
      numbers.insert(numbers.end(),
                     {static_cast<double>(it.row()), static_cast<double>(it.col()), it.value()});
  return numbers;
}

Sparse from_numbers(std::span<const double> numbers, Index rows, Index columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    entries.emplace_back(static_cast<int>(numbers[i]), static_cast<int>(numbers[i + 1]),
                         numbers[i + 2]);
  Sparse matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

void SystemRows::add(Entries &to, Index row, Index column, const contact::TangentMatrix &block) {
  for (Index i = 0; i < block.rows(); ++i)
    for (Index j = 0; j < block.cols(); ++j)
      to.emplace_back(static_cast<int>(row + i), static_cast<int>(column + j), block(i, j));
}

InterfaceSystem SystemRows::system(std::vector<Index> unknowns, Index n, Index n_local) const {
  InterfaceSystem system;
  system.unknowns = std::move(unknowns);
  system.of_force.resize(system.size(), n);
  system.of_force.setFromTriplets(of_force_.begin(), of_force_.end());
  system.local.resize(system.size(), n_local);
  system.local.setFromTriplets(local_.begin(), local_.end());
  return system;
}

bool is_large(Index unknowns) {
  return unknowns > 1000;
}

VectorXd symmetric_product(const MatrixXd &a, const VectorXd &v) {
  if (is_large(a.rows()))
    return a.selfadjointView<Eigen::Lower>() * v;
  return a * v;
}

void subtract_product(const MatrixXd &a, const VectorXd &v, VectorXd &from) {
  if (is_large(a.rows()))
    from -= symmetric_product(a, v);
  else
    from.noalias() -= a * v;
}

void KeptFactor::keep(const InterfaceSystem &system, const MatrixXd &a) {
  factor_.reset();
  of_ = system;
  excess_ = 0;
  factor_.emplace(matrix_of<MatrixXf>(system, a));
}

// With the unknowns that the factor does not know taken each by itself.
VectorXd KeptFactor::nearly_solved(const InterfaceSystem &system, const VectorXd &diagonal,
                                   const VectorXd &b) const {
  VectorXd x = b.cwiseQuotient(diagonal);
  VectorXd kept = VectorXd::Zero(of_->size());
  const auto for_each_common = [&](auto use) {
    const std::vector<Index> &new_ones = system.unknowns, &old = of_->unknowns;
    for (std::size_t i = 0, k = 0; i < new_ones.size() && k < old.size();)
      if (new_ones[i] == old[k])
        use(static_cast<Index>(i++), static_cast<Index>(k++));
      else
        ++(new_ones[i] < old[k] ? i : k);
  };
  for_each_common([&](Index i, Index k) { kept[k] = b[i]; });
  const double size = kept.cwiseAbs().maxCoeff();
  if (size > 0) {
    kept = size * factor_->solve((kept / size).cast<float>()).cast<double>();
    for_each_common([&](Index i, Index k) { x[i] = kept[k]; });
  }
  return x;
}

// Generalised conjugate residuals. Nothing where the factor does not serve.
std::optional<KeptFactor::Solved> KeptFactor::iterate(const InterfaceSystem &system,
                                                      const MatrixXd &a, const VectorXd &b) {
  const VectorXd diagonal = diagonal_of(system, a);
  Solved x{VectorXd::Zero(system.local.cols()), VectorXd::Zero(a.rows())};
  std::vector<Direction> directions;
  VectorXd left = b;
  while (left.norm() > reduction * b.norm() && directions.size() < most_products) {
    Direction next{spread(system, a, nearly_solved(system, diagonal, left)), {}};
    next.product = product(system, next.moved);
    for (const Direction &before : directions)
      next.add(-before.product.dot(next.product), before);
    next.scale(1 / next.product.norm());
    const double share = next.product.dot(left);
    x.x += share * next.moved.x;
    x.resisted += share * next.moved.resisted;
    left -= share * next.product;
    directions.push_back(std::move(next));
  }
  excess_ = std::max(excess_ + static_cast<double>(directions.size()) - usual_products, 0.);
  return left.norm() <= 10 * reduction * b.norm() ? std::optional(x) : std::nullopt;
}

// Nothing where it must be solved exactly.
std::optional<KeptFactor::Solved> KeptFactor::solve_large(const InterfaceSystem &system,
                                                          const MatrixXd &a, const VectorXd &b) {
  if (!is_large(system.size()))
    return std::nullopt;
  if (of_ && !factor_) {
    const double excess = excess_;
    keep(InterfaceSystem(*of_), a);
    excess_ = excess;
  }
  std::optional<Solved> found;
  if (of_ && excess_ * rows_by_product < static_cast<double>(of_->size()))
    found = iterate(system, a, b);
  if (!found) {
    keep(system, a);
    found = iterate(system, a, b);
  }
  return found;
}

std::optional<KeptFactor::Solved> KeptFactor::solve(const InterfaceSystem &system,
                                                    const MatrixXd &a, const VectorXd &b) {
  if (auto found = solve_large(system, a, b))
    return found;
  const VectorXd x = matrix_of<MatrixXd>(system, a).partialPivLu().solve(b);
  return x.allFinite() ? std::optional(spread(system, a, x)) : std::nullopt;
}

std::optional<KeptFactor::Solved> KeptFactor::solve_definite(const InterfaceSystem &system,
                                                             const MatrixXd &a, const VectorXd &b) {
  if (auto found = solve_large(system, a, b))
    return found;
  const Eigen::LLT<MatrixXd> factor(matrix_of<MatrixXd>(system, a));
  if (factor.info() != Eigen::Success)
    return std::nullopt;
  return spread(system, a, factor.solve(b));
}

void KeptFactor::save(const std::string &name, output::SavedNumbers &numbers) const {
  if (!of_)
    return;
  const std::vector<double> unknowns(of_->unknowns.begin(), of_->unknowns.end());
  const std::vector<double> of_force = as_numbers(of_->of_force), local = as_numbers(of_->local);
  numbers.put(name + ", sizes",
              {static_cast<double>(unknowns.size()), static_cast<double>(of_force.size()),
               static_cast<double>(local.size()), static_cast<double>(of_->local.cols()), excess_});
  numbers.put(name + ", unknowns", unknowns);
  numbers.put(name + ", of forces", of_force);
  numbers.put(name + ", local", local);
}

void KeptFactor::restore(const std::string &name, const output::SavedNumbers &numbers,
                         Index n_entries) {
  factor_.reset();
  of_.reset();
  if (!numbers.all().contains(name + ", sizes"))
    return;
  const std::span<const double> sizes = numbers.get(name + ", sizes", 5);
  const auto part = [&](const char *what, int k) {
    return numbers.get(name + what, static_cast<std::size_t>(sizes[static_cast<std::size_t>(k)]));
  };
  InterfaceSystem system;
  for (const double unknown : part(", unknowns", 0))
    system.unknowns.push_back(static_cast<Index>(unknown));
  system.of_force = from_numbers(part(", of forces", 1), system.size(), n_entries);
  system.local = from_numbers(part(", local", 2), system.size(), static_cast<Index>(sizes[3]));
  of_ = std::move(system);
  excess_ = sizes[4];
}

}  // namespace tourmaline::solve
