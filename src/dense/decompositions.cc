#include "dense/decompositions.h"

#include <Eigen/Dense>
#include <utility>

extern "C" void dpotrf_(const char *triangle, const int *n, double *a, const int *leading,
                        int *info);
extern "C" void dpotrs_(const char *triangle, const int *n, const int *columns, const double *a,
                        const int *leading, double *x, const int *leading_of_x, int *info);

namespace tourmaline::dense {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Spectrum<MatrixXd> spectrum(const MatrixXd &symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> found(symmetric);
  return {found.eigenvalues(), found.eigenvectors()};
}

Spectrum<SmallMatrix> spectrum(const SmallMatrix &symmetric) {
  const Eigen::Index n = symmetric.rows();
  Spectrum<SmallMatrix> found{symmetric.diagonal(), SmallMatrix::Identity(n, n)};
  if (n < 2)
    return found;
  Eigen::JacobiRotation<double> rotation;
  rotation.makeJacobi(symmetric(0, 0), symmetric(1, 0), symmetric(1, 1));
  found.vectors.applyOnTheRight(0, 1, rotation);
  const SmallMatrix whole = symmetric.selfadjointView<Eigen::Lower>();
  found.values = (found.vectors.transpose() * whole * found.vectors).diagonal();
  if (found.values[0] > found.values[1]) {
    std::swap(found.values[0], found.values[1]);
    found.vectors.col(0).swap(found.vectors.col(1));
  }
  return found;
}

Eigen::Vector3d eigenvalues(const Eigen::Matrix3d &symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

VectorXd eigenvalues(const MatrixXd &a, const MatrixXd &b) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(a, b, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

// LAPACK's, as Eigen's copies the matrix and sums up its rows for a norm, which at some hundred
// rows takes as long again.
Cholesky::Cholesky(MatrixXd matrix) : lower_(std::move(matrix)) {
  const int n = static_cast<int>(lower_.rows());
  int info = 0;
  if (n > 0)
    dpotrf_("L", &n, lower_.data(), &n, &info);
  is_definite_ = info == 0;
}

VectorXd Cholesky::solve(const VectorXd &right_side) const {
  return solve(MatrixXd(right_side));
}

MatrixXd Cholesky::solve(const MatrixXd &right_sides) const {
  MatrixXd x = right_sides;
  const int n = static_cast<int>(lower_.rows()), columns = static_cast<int>(x.cols());
  int info = 0;
  if (x.size() > 0)
    dpotrs_("L", &n, &columns, lower_.data(), &n, x.data(), &n, &info);
  return x;
}

double inverse_condition(const MatrixXd &symmetric) {
  const Eigen::LLT<MatrixXd> factor(symmetric);
  return factor.info() == Eigen::Success ? factor.rcond() : 0;
}

VectorXd solve(const MatrixXd &a, const VectorXd &b) {
  return a.partialPivLu().solve(b);
}

MatrixXd inverse(const MatrixXd &a) {
  return a.partialPivLu().inverse();
}

VectorXd least_squares(const MatrixXd &a, const VectorXd &b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

Eigen::Index rank(const MatrixXd &matrix, double tolerance) {
  if (matrix.rows() == 0)
    return 0;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition;
  decomposition.setThreshold(tolerance);
  return decomposition.compute(matrix).rank();
}

}  // namespace tourmaline::dense
