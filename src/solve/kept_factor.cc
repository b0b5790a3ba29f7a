#include "solve/kept_factor.h"

#include <algorithm>

#include "dense/decompositions.h"

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = InterfaceSystem::Sparse;

namespace {

constexpr int most_products = 30;
constexpr std::ptrdiff_t most_kept = 12;
constexpr Index few = 700;  // unknowns: of so many a system is factorised in no more time

// How many of the unknowns, which come first, are columns of A.
Index n_of_a(const InterfaceSystem &system, const MatrixXd &a) {
  return std::lower_bound(system.unknowns.begin(), system.unknowns.end(), a.cols()) -
         system.unknowns.begin();
}

enum class Part { whole, lower };

void add_local(const InterfaceSystem &system, MatrixXd &m) {
  std::vector<Index> column_of(static_cast<std::size_t>(system.local.cols()), -1);
  for (Index k = 0; k < system.size(); ++k)
    column_of[static_cast<std::size_t>(system.unknowns[static_cast<std::size_t>(k)])] = k;
  for (Index row = 0; row < system.local.outerSize(); ++row)
    for (Sparse::InnerIterator it(system.local, row); it; ++it)
      if (const Index k = column_of[static_cast<std::size_t>(it.col())]; k >= 0)
        m(row, k) += it.value();
}

// M; a product of Eigen's would copy the columns of A first.
MatrixXd matrix_of(const InterfaceSystem &system, const MatrixXd &a, Part part = Part::whole) {
  MatrixXd m = MatrixXd::Zero(system.size(), system.size());
  for (Index k = 0; k < n_of_a(system, a); ++k) {
    const double *const column = a.col(system.unknowns[static_cast<std::size_t>(k)]).data();
    for (Index row = part == Part::lower ? k : 0; row < system.size(); ++row)
      for (Sparse::InnerIterator it(system.of_force, row); it; ++it)
        m(row, k) += it.value() * column[it.col()];
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

/// What a system's large part is solved with nearly. With N A + C its rows of a point, c the size
/// of the point's own block of A and Z = (c N + C)^-1,
///
///     x = z + Z c N (A^-1 c z - z),    z = Z r:
///
/// as if A were alone where C is small, and point by point where it is large.
class NearlySolved {
 public:
  NearlySolved(const InterfaceSystem &system, const MatrixXd &a, const RoundedInverse &inverse)
      : system_(system), size_(a.rows()), inverse_(inverse) {
    for (Index first = 0; first < system.size(); first += blocks_.back().z.rows())
      blocks_.push_back(block(first, a));
  }

  /// About M^-1 `r`.
  VectorXd operator()(const VectorXd &r) const {
    VectorXd x(r.size()), of_all = VectorXd::Zero(size_);
    for (const Block &b : blocks_) {
      const contact::Tangent z = b.z * r.segment(b.first, b.z.rows());
      x.segment(b.first, b.z.rows()) = z;
      for (Index i = 0; b.curvature != 0 && i < z.size(); ++i)
        of_all[unknown(b.first + i)] = b.curvature * z[i];
    }
    of_all = inverse_ * of_all;
    for (const Block &b : blocks_) {
      contact::Tangent change = -x.segment(b.first, b.z.rows());
      for (Index i = 0; b.curvature != 0 && i < change.size(); ++i)
        change[i] += of_all[unknown(b.first + i)];
      x.segment(b.first, b.z.rows()) += b.share * change;
    }
    return x;
  }

 private:
  /// Rows of one point.
  struct Block {
    Index first = 0;
    double curvature = 0;             // c; 0 where A has no such columns
    contact::TangentMatrix z, share;  // Z and Z c N
  };

  Index unknown(Index k) const { return system_.unknowns[static_cast<std::size_t>(k)]; }

  // Two rows that `SystemRows` was given as one block's.
  bool are_of_one_point(Index k) const {
    return k + 1 < system_.size() && unknown(k + 1) == unknown(k) + 1 &&
           has_entry(system_.of_force, k, k + 1) && has_entry(system_.of_force, k + 1, k);
  }
  bool has_entry(const Sparse &matrix, Index row, Index k) const {
    for (Sparse::InnerIterator it(matrix, row); it; ++it)
      if (it.col() == unknown(k))
        return true;
    return false;
  }

  contact::TangentMatrix own_part(const Sparse &matrix, Index first, Index n) const {
    contact::TangentMatrix part = contact::TangentMatrix::Zero(n, n);
    for (Index i = 0; i < n; ++i)
      for (Sparse::InnerIterator it(matrix, first + i); it; ++it)
        if (const Index j = it.col() - unknown(first); j >= 0 && j < n)
          part(i, j) = it.value();
    return part;
  }

  Block block(Index first, const MatrixXd &a) const {
    const Index n = are_of_one_point(first) ? 2 : 1, at = unknown(first);
    Block b{first, 0, own_part(system_.local, first, n), contact::TangentMatrix::Zero(n, n)};
    if (at < size_) {
      b.curvature = a.diagonal().segment(at, n).mean();
      b.share = b.curvature * own_part(system_.of_force, first, n);
    }
    b.z = (b.z + b.share).inverse();
    if (!b.z.allFinite())
      b.z = contact::TangentMatrix::Identity(n, n) / (b.curvature == 0 ? 1 : b.curvature);
    b.share = (b.z * b.share).eval();
    return b;
  }

  const InterfaceSystem &system_;
  Index size_;  // of A
  const RoundedInverse &inverse_;
  std::vector<Block> blocks_;
};

/// Generalised conjugate residuals: a solution as a sum of directions whose products with M have
/// the size 1 and are perpendicular to each other.
class Residuals {
 public:
  Residuals(const InterfaceSystem &system, const MatrixXd &a, const VectorXd &b)
      : system_(system), left_(b), found_{VectorXd::Zero(system.local.cols()), {}} {
    found_.resisted = VectorXd::Zero(a.rows());
  }

  /// Takes what the direction can from the rest; false where it is a sum of those before it, or
  /// not of numbers.
  bool take(KeptFactor::Solved direction) {
    VectorXd product = system_.of_force * direction.resisted + system_.local * direction.x;
    const double size = product.norm();
    for (std::size_t k = 0; k < products_.size(); ++k) {
      const double common = products_[k].dot(product);
      product -= common * products_[k];
      direction.x -= common * directions_[k].x;
      direction.resisted -= common * directions_[k].resisted;
    }
    const double new_part = product.norm();
    if (!(new_part > 1e-6 * size))
      return false;
    product /= new_part;
    direction.x /= new_part;
    direction.resisted /= new_part;
    const double share = product.dot(left_);
    left_ -= share * product;
    found_.x += share * direction.x;
    found_.resisted += share * direction.resisted;
    directions_.push_back(std::move(direction));
    products_.push_back(std::move(product));
    return true;
  }

  const VectorXd &left() const { return left_; }
  const KeptFactor::Solved &found() const { return found_; }
  std::vector<KeptFactor::Solved> directions() && { return std::move(directions_); }

 private:
  const InterfaceSystem &system_;
  VectorXd left_;  // of the right side
  KeptFactor::Solved found_;
  std::vector<KeptFactor::Solved> directions_;
  std::vector<VectorXd> products_;
};

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

// Products of Eigen's would make |A| first.
VectorXd sizes_of_terms(const MatrixXd &a, const VectorXd &v, Index first, Index n) {
  VectorXd sizes = VectorXd::Zero(n);
  for (Index j = 0; j < a.cols(); ++j)
    if (v[j] != 0)
      sizes += std::abs(v[j]) * a.col(j).segment(first, n).cwiseAbs();
  return sizes;
}

VectorXd sizes_of_terms(const MatrixXd &a, const VectorXd &v) {
  if (!is_large(a.rows()))
    return sizes_of_terms(a, v, 0, a.rows());
  VectorXd sizes = (a.diagonal().cwiseProduct(v)).cwiseAbs();
  for (Index j = 0; j + 1 < a.cols(); ++j) {
    const Index below = a.rows() - j - 1;
    const auto column = a.col(j).tail(below).cwiseAbs();
    sizes[j] += column.dot(v.tail(below).cwiseAbs());
    sizes.tail(below) += std::abs(v[j]) * column;
  }
  return sizes;
}

void subtract_product(const MatrixXd &a, const VectorXd &v, VectorXd &from) {
  if (is_large(a.rows()))
    from -= symmetric_product(a, v);
  else
    from.noalias() -= a * v;
}

// Nothing where it must be solved exactly. The products of M with directions of systems before it
// cost nothing, as those of A are known.
std::optional<KeptFactor::Solved> KeptFactor::solve_large(const InterfaceSystem &system,
                                                          const MatrixXd &a, const VectorXd &b,
                                                          double left) {
  if (!is_large(a.rows()) || system.size() <= few)
    return std::nullopt;
  if (!inverse_)
    inverse_.emplace(a);
  const NearlySolved nearly_solved(system, a, *inverse_);
  Residuals residuals(system, a, b);
  if (std::includes(system.unknowns.begin(), system.unknowns.end(), unknowns_.begin(),
                    unknowns_.end()))
    for (KeptFactor::Solved &direction : directions_)
      residuals.take(std::move(direction));
  const double enough = left * b.norm();
  bool is_new = true;
  for (int k = 0; is_new && residuals.left().norm() > enough && k < most_products; ++k)
    is_new = residuals.take(spread(system, a, nearly_solved(residuals.left())));
  const bool is_solved = residuals.left().norm() <= 2 * enough;
  std::optional<Solved> found = is_solved ? std::optional(residuals.found()) : std::nullopt;
  unknowns_ = system.unknowns;
  directions_ = std::move(residuals).directions();
  if (std::ssize(directions_) > most_kept)
    directions_.erase(directions_.begin(), directions_.end() - most_kept);
  return found;
}

std::optional<KeptFactor::Solved> KeptFactor::solve(const InterfaceSystem &system,
                                                    const MatrixXd &a, const VectorXd &b,
                                                    double left) {
  if (auto found = solve_large(system, a, b, left))
    return found;
  const VectorXd x = dense::solve(matrix_of(system, a), b);
  return x.allFinite() ? std::optional(spread(system, a, x)) : std::nullopt;
}

std::optional<KeptFactor::Solved> KeptFactor::solve_definite(const InterfaceSystem &system,
                                                             const MatrixXd &a, const VectorXd &b,
                                                             double left) {
  if (auto found = solve_large(system, a, b, left))
    return found;
  const dense::Cholesky factor(matrix_of(system, a, Part::lower));
  if (!factor.is_definite())
    return std::nullopt;
  return spread(system, a, factor.solve(b));
}

}  // namespace tourmaline::solve
