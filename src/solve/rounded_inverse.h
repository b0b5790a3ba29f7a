#pragma once

#include <Eigen/Dense>

namespace tourmaline::solve {

/// About the inverse of a large symmetric matrix A that is positive definite, or quasi-definite:
/// positive in some rows and negative in the others. Between such groups it couples nothing. Its
/// Cholesky factor, of A scaled to a diagonal of ones, is kept in single precision.
class RoundedInverse {
 public:
  explicit RoundedInverse(const Eigen::MatrixXd &a);

  Eigen::VectorXd operator*(const Eigen::VectorXd &v) const;

 private:
  bool factorise(const Eigen::MatrixXd &a, float shift);

  Eigen::VectorXd diagonal_, scale_;  // scale_: 1 / sqrt of its size
  Eigen::MatrixXf upper_;             // R of R^T R; what is below it is not used
  bool is_factorised_ = false;
};

}  // namespace tourmaline::solve
