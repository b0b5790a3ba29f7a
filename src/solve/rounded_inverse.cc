#include "solve/rounded_inverse.h"

#include <cmath>

extern "C" void spotrf_(const char *triangle, const int *n, float *a, const int *leading,
                        int *info);

// strsv_ is among those that Eigen declares.

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A that leaves rigid motions to the contact is singular by itself: what is added to its diagonal
// is far less than the stiffness of a contact that is a hundred times as large as its elements.
RoundedInverse::RoundedInverse(const MatrixXd &a)
    : diagonal_(a.diagonal()),
      scale_(diagonal_.unaryExpr([](double d) { return d == 0 ? 1 : 1 / std::sqrt(std::abs(d)); })),
      upper_(a.rows(), a.cols()) {
  for (float shift = 1e-5F; shift < 1 && !is_factorised_; shift *= 10)
    is_factorised_ = factorise(a, shift);
}

bool RoundedInverse::factorise(const MatrixXd &a, float shift) {
  for (Index j = 0; j < a.cols(); ++j) {
    for (Index i = 0; i <= j; ++i) {
      const bool is_coupled = (diagonal_[i] < 0) == (diagonal_[j] < 0);
      upper_(i, j) = is_coupled ? static_cast<float>(a(i, j) * scale_[i] * scale_[j]) : 0.F;
    }
    if (diagonal_[j] < 0)
      upper_.col(j).head(j + 1) *= -1;
    upper_(j, j) += shift;
  }
  const auto n = static_cast<int>(a.rows());
  int info = 0;
  spotrf_("U", &n, upper_.data(), &n, &info);
  return info == 0;
}

// Of a vector of any size; where A has no factor, with its diagonal.
VectorXd RoundedInverse::operator*(const VectorXd &v) const {
  const VectorXd scaled = v.cwiseProduct(scale_);
  const double size = scaled.cwiseAbs().maxCoeff();
  if (size == 0)
    return VectorXd::Zero(v.size());
  Eigen::VectorXf x = (scaled / size).cast<float>();
  if (is_factorised_) {
    const auto n = static_cast<int>(x.size());
    constexpr int step = 1;
    strsv_("U", "T", "N", &n, upper_.data(), &n, x.data(), &step);
    strsv_("U", "N", "N", &n, upper_.data(), &n, x.data(), &step);
  }
  const VectorXd sign = diagonal_.unaryExpr([](double d) { return d < 0 ? -1. : 1.; });
  return size * x.cast<double>().cwiseProduct(scale_).cwiseProduct(sign);
}

}  // namespace tourmaline::solve
