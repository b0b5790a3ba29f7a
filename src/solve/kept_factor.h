#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <optional>
#include <vector>

#include "solve/rounded_inverse.h"
#include "tourmaline/contact/tangent.h"

namespace tourmaline::solve {

/// A linear system of the interface. With A the contact's stiffness [N/m] of n rows, its matrix is
///
///     M = (L A 0 + B)(all, unknowns),
///
/// whose sparse parts L, of n columns, and B, of n and as many as there are unknowns beside those
/// of A, act point by point.
struct InterfaceSystem {
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  std::vector<Eigen::Index> unknowns;  ///< columns of B that are asked for, in ascending order
  Sparse of_force, local;              ///< L and B

  Eigen::Index size() const { return static_cast<Eigen::Index>(unknowns.size()); }
};

/// The rows of such a system, one block after the other.
class SystemRows {
 public:
  /// The entries of `block` are added to those that stand from that row and column on.
  void add_of_force(Eigen::Index row, Eigen::Index column, const contact::TangentMatrix &block) {
    add(of_force_, row, column, block);
  }
  void add_local(Eigen::Index row, Eigen::Index column, const contact::TangentMatrix &block) {
    add(local_, row, column, block);
  }
  /// `n`: columns of L, `n_local`: of B.
  InterfaceSystem system(std::vector<Eigen::Index> unknowns, Eigen::Index n,
                         Eigen::Index n_local) const;

 private:
  using Entries = std::vector<Eigen::Triplet<double>>;
  static void add(Entries &to, Eigen::Index row, Eigen::Index column,
                  const contact::TangentMatrix &block);

  Entries of_force_, local_;
};

/// A v, and `from` - A v; of large A only one half is read.
Eigen::VectorXd symmetric_product(const Eigen::MatrixXd &a, const Eigen::VectorXd &v);
void subtract_product(const Eigen::MatrixXd &a, const Eigen::VectorXd &v, Eigen::VectorXd &from);

/// |A| |v|, of which likewise, and `n` of its rows from `first` on.
Eigen::VectorXd sizes_of_terms(const Eigen::MatrixXd &a, const Eigen::VectorXd &v);
Eigen::VectorXd sizes_of_terms(const Eigen::MatrixXd &a, const Eigen::VectorXd &v,
                               Eigen::Index first, Eigen::Index n);

/// Whether a system of so many unknowns is large: then it costs far more to factorise it than to
/// multiply with A, and its factor is worth keeping.
bool is_large(Eigen::Index unknowns);

/// Solves systems of one A that come one after the other. Small ones are factorised. Large ones are
/// solved by conjugate residuals with the inverse of A, of which a factor is kept in single
/// precision: each costs one or two products with A.
class KeptFactor {
 public:
  struct Solved {
    Eigen::VectorXd x;         ///< spread among zeros to the entries of B's columns
    Eigen::VectorXd resisted;  ///< A x
  };
  /// How much of the right side a large system may leave: the next Newton iteration takes it, which
  /// will find the same points slipping, or there is none.
  static constexpr double for_the_next = 0.3, for_the_same = 0.05, for_none = 0.01;
  /// Exactly, or of large ones until such a part of the right side is left. Nothing where the
  /// system cannot be solved.
  std::optional<Solved> solve(const InterfaceSystem &system, const Eigen::MatrixXd &a,
                              const Eigen::VectorXd &right_side, double left = for_the_next);
  /// Likewise where a small M is symmetric; nothing where it is not positive definite then.
  std::optional<Solved> solve_definite(const InterfaceSystem &system, const Eigen::MatrixXd &a,
                                       const Eigen::VectorXd &right_side,
                                       double left = for_the_next);

  /// What comes is of another programme.
  void begin() {
    unknowns_.clear();
    directions_.clear();
  }

 private:
  std::optional<Solved> solve_large(const InterfaceSystem &system, const Eigen::MatrixXd &a,
                                    const Eigen::VectorXd &b, double left);

  std::optional<RoundedInverse> inverse_;
  std::vector<Eigen::Index> unknowns_;  // of the system before
  std::vector<Solved> directions_;      // that its solution was sought in
};

}  // namespace tourmaline::solve
