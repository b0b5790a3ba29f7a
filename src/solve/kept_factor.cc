#include "solve/kept_factor.h"

#include <algorithm>

#include "dense/decompositions.h"

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;
using Sparse = InterfaceSystem::Sparse;

namespace {

constexpr double reduction = 0.2;  // the next Newton iteration takes what is left
constexpr std::size_t most_products = 12;
constexpr double usual_products = 2;
// A factor of n rows is made again when n / 300 more products than usual were needed since.
// Measured at 3,025 points in 3D, whose systems have 1,400 to 4,400 rows: with this and the
// reduction above a solution costs 2.8 products with A (Coulomb) or 2.7 (Tresca), and all of them
// with all factors a fifth less than with n / 100 and a reduction by 3e-2.
constexpr double rows_by_product = 300;

// How many of the unknowns, which come first, are columns of A.
Index n_of_a(const InterfaceSystem &system, const MatrixXd &a) {
  return std::lower_bound(system.unknowns.begin(), system.unknowns.end(), a.cols()) -
         system.unknowns.begin();
}

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

enum class Part { whole, lower };

// M; a product of Eigen's would copy the columns of A first.
template <class Matrix>
Matrix matrix_of(const InterfaceSystem &system, const MatrixXd &a, Part part = Part::whole) {
  Matrix m = Matrix::Zero(system.size(), system.size());
  for (Index k = 0; k < n_of_a(system, a); ++k) {
    const double *const column = a.col(system.unknowns[static_cast<std::size_t>(k)]).data();
    for (Index row = part == Part::lower ? k : 0; row < system.size(); ++row) {
      double sum = 0;
      for (Sparse::InnerIterator it(system.of_force, row); it; ++it)
        sum += it.value() * column[it.col()];
      m(row, k) = static_cast<typename Matrix::Scalar>(sum);
    }
  }
  add_local(system, m);
  return m;
}

KeptFactor::Solved spread(const InterfaceSystem &system, const MatrixXd &a, const VectorXd &x) {
  KeptFactor::Solved all{VectorXd::Zero(system.local.cols()), {}};
  all.x(system.unknowns) = x;
  const Index n = n_of_a(system, a);
  if (2 * n >= a.cols()) {
    all.resisted = symmetric_product(a, all.x.head(a.cols()));
    return all;
  }
  all.resisted = VectorXd::Zero(a.rows());
  const auto column = [&](Index k) { return a.col(system.unknowns[static_cast<std::size_t>(k)]); };
  Index k = 0;
  for (; k + 3 < n; k += 4)
    all.resisted += x[k] * column(k) + x[k + 1] * column(k + 1) + x[k + 2] * column(k + 2) +
                    x[k + 3] * column(k + 3);
  for (; k < n; ++k)
    all.resisted += x[k] * column(k);
  return all;
}

// M x.
VectorXd product(const InterfaceSystem &system, const KeptFactor::Solved &x) {
  return system.of_force * x.resisted + system.local * x.x;
}

/// M with a copy, in single precision, of the entries of A that it reads: where most points stick
/// these are few. `place` is where the copy stands.
class CopiedSystem {
 public:
  CopiedSystem(const InterfaceSystem &system, const MatrixXd &a, std::vector<float> &place)
      : local_(with_columns(system.local, system.unknowns)) {
    const std::vector<Index> rows = forces_of(system);
    of_force_ = with_columns(system.of_force, rows);
    const Index n = n_of_a(system, a);
    place.resize(std::max(place.size(), rows.size() * static_cast<std::size_t>(n)));
    float *to = place.data();
    const std::vector<Run> runs = runs_of(rows);
    for (Index k = 0; k < n; ++k) {
      const double *column = a.col(system.unknowns[static_cast<std::size_t>(k)]).data();
      for (const Run &run : runs)
        to = std::transform(column + run.begin, column + run.end, to,
                            [](double entry) { return static_cast<float>(entry); });
    }
    a_.emplace(place.data(), static_cast<Index>(rows.size()), n);
  }

  VectorXd operator*(const VectorXd &x) const {
    const double size = std::max(x.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
    const Eigen::VectorXf of_a = (x.head(a_->cols()) / size).cast<float>();
    return of_force_ * (size * (*a_ * of_a).cast<double>()) + local_ * x;
  }

 private:
  struct Run {
    Index begin, end;
  };

  // Rows of A that are read.
  static std::vector<Index> forces_of(const InterfaceSystem &system) {
    std::vector<bool> is_read(static_cast<std::size_t>(system.of_force.cols()));
    for (Index row = 0; row < system.of_force.outerSize(); ++row)
      for (Sparse::InnerIterator it(system.of_force, row); it; ++it)
        is_read[static_cast<std::size_t>(it.col())] = true;
    std::vector<Index> rows;
    for (std::size_t i = 0; i < is_read.size(); ++i)
      if (is_read[i])
        rows.push_back(static_cast<Index>(i));
    return rows;
  }

  static std::vector<Run> runs_of(const std::vector<Index> &rows) {
    std::vector<Run> runs;
    for (const Index row : rows)
      if (!runs.empty() && runs.back().end == row)
        ++runs.back().end;
      else
        runs.push_back({row, row + 1});
    return runs;
  }

  static Sparse with_columns(const Sparse &matrix, const std::vector<Index> &columns) {
    std::vector<Index> new_of(static_cast<std::size_t>(matrix.cols()), -1);
    for (std::size_t k = 0; k < columns.size(); ++k)
      new_of[static_cast<std::size_t>(columns[k])] = static_cast<Index>(k);
    std::vector<Eigen::Triplet<double>> entries;
    for (Index row = 0; row < matrix.outerSize(); ++row)
      for (Sparse::InnerIterator it(matrix, row); it; ++it)
        if (const Index k = new_of[static_cast<std::size_t>(it.col())]; k >= 0)
          entries.emplace_back(static_cast<int>(row), static_cast<int>(k), it.value());
    Sparse result(matrix.rows(), static_cast<Index>(columns.size()));
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  Sparse of_force_, local_;
  std::optional<Eigen::Map<MatrixXf>> a_;
};

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
struct PartOfSolution {
  VectorXd x, product;

  void add(double factor, const PartOfSolution &other) {
    x += factor * other.x;
    product += factor * other.product;
  }
  void scale(double factor) {
    x *= factor;
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
  const CopiedSystem m(system, a, copied_);
  VectorXd x = VectorXd::Zero(system.size()), left = b;
  std::vector<PartOfSolution> directions;
  while (left.norm() > reduction * b.norm() && directions.size() < most_products) {
    PartOfSolution next{nearly_solved(system, diagonal, left), {}};
    next.product = m * next.x;
    for (const PartOfSolution &before : directions)
      next.add(-before.product.dot(next.product), before);
    next.scale(1 / next.product.norm());
    const double share = next.product.dot(left);
    x += share * next.x;
    left -= share * next.product;
    directions.push_back(std::move(next));
  }
  excess_ = std::max(excess_ + static_cast<double>(directions.size()) - usual_products, 0.);
  Solved found = spread(system, a, x);
  left = b - product(system, found);
  return left.norm() <= 2 * reduction * b.norm() ? std::optional(std::move(found)) : std::nullopt;
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
  const VectorXd x = dense::solve(matrix_of<MatrixXd>(system, a), b);
  return x.allFinite() ? std::optional(spread(system, a, x)) : std::nullopt;
}

std::optional<KeptFactor::Solved> KeptFactor::solve_definite(const InterfaceSystem &system,
                                                             const MatrixXd &a, const VectorXd &b) {
  if (auto found = solve_large(system, a, b))
    return found;
  const dense::Cholesky factor(matrix_of<MatrixXd>(system, a, Part::lower));
  if (!factor.is_definite())
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
