#pragma once

#include <Eigen/Core>

/// Decompositions of dense matrices, compiled once: Eigen's are templates of thousands of lines,
/// which every source that calls one would compile anew.
namespace tourmaline::dense {

/// A matrix of a contact point, at most 2 x 2.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;

/// Of a symmetric matrix, of which the lower triangle counts: eigenvalues, increasing, and the
/// eigenvectors, of length 1, as columns.
template <class Matrix>
struct Spectrum {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Matrix::MaxRowsAtCompileTime, 1> values;
  Matrix vectors;
};
Spectrum<Eigen::MatrixXd> spectrum(const Eigen::MatrixXd &symmetric);
Spectrum<SmallMatrix> spectrum(const SmallMatrix &symmetric);
Eigen::Vector3d eigenvalues(const Eigen::Matrix3d &symmetric);

/// The eigenvalues x of a v = x b v, increasing; `a` symmetric, `b` positive definite.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b);

/// L L^T of a symmetric matrix, of which the lower triangle counts.
class Cholesky {
 public:
  /// Of no unknowns.
  Cholesky() = default;
  /// In the place of `matrix`.
  explicit Cholesky(Eigen::MatrixXd matrix);

  /// Whether all pivots were positive; otherwise nothing else can be asked.
  bool is_definite() const { return is_definite_; }
  Eigen::VectorXd solve(const Eigen::VectorXd &right_side) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd &right_sides) const;

 private:
  Eigen::MatrixXd lower_;
  bool is_definite_ = true;
};

/// An estimate of the inverse of the condition number of a symmetric positive definite matrix; 0
/// where it is not definite.
double inverse_condition(const Eigen::MatrixXd &symmetric);

/// x of a x = b, by elimination with partial pivoting; not finite where `a` is singular.
Eigen::VectorXd solve(const Eigen::MatrixXd &a, const Eigen::VectorXd &b);
Eigen::MatrixXd inverse(const Eigen::MatrixXd &a);

/// The shortest of all x that make |a x - b| least.
Eigen::VectorXd least_squares(const Eigen::MatrixXd &a, const Eigen::VectorXd &b);

/// The number of independent rows; a pivot below `tolerance` of the largest counts as zero.
Eigen::Index rank(const Eigen::MatrixXd &matrix, double tolerance);

}  // namespace tourmaline::dense
