#include "dense/decompositions.h"

#include <Eigen/Dense>
#include <utility>

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

struct Cholesky::Factor {
  Eigen::LLT<MatrixXd> of;
};

Cholesky::Cholesky() : Cholesky(MatrixXd()) {}
Cholesky::Cholesky(const MatrixXd &matrix)
    : factor_(std::make_unique<Factor>(Factor{Eigen::LLT<MatrixXd>(matrix)})) {}
Cholesky::Cholesky(Cholesky &&) noexcept = default;
Cholesky &Cholesky::operator=(Cholesky &&) noexcept = default;
Cholesky::~Cholesky() = default;

bool Cholesky::is_definite() const {
  return factor_->of.info() == Eigen::Success;
}

VectorXd Cholesky::solve(const VectorXd &right_side) const {
  return factor_->of.solve(right_side);
}

MatrixXd Cholesky::solve(const MatrixXd &right_sides) const {
  return factor_->of.solve(right_sides);
}

double Cholesky::inverse_condition() const {
  return factor_->of.rcond();
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
