#include "solve/rounded_inverse.h"

#include <gtest/gtest.h>

#include "solve/kept_factor.h"

namespace tourmaline::solve {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd chain(Index n, double size) {
  return MatrixXd::NullaryExpr(n, n, [size](Index i, Index j) {
    return size / (1. + static_cast<double>((i - j) * (i - j))) + (i == j ? size : 0);
  });
}

VectorXd some(Index n) {
  return VectorXd::NullaryExpr(n, [](Index i) { return std::sin(static_cast<double>(i * i)); });
}

TEST(RoundedInverse, IsTheInverseToFourDigits) {
  for (const double size : {1e-60, 1., 1e60}) {
    const MatrixXd a = chain(120, size);
    const VectorXd x = some(120);
    EXPECT_LT((RoundedInverse(a) * (a * x) - x).norm(), 1e-4 * x.norm()) << size;
  }
}

// With entries of very different sizes, as forces and flows have.
TEST(RoundedInverse, OfAQuasiDefiniteMatrixIsThatOfTheBlocksOfEachSign) {
  MatrixXd a = MatrixXd::Constant(100, 100, 1e-3);
  a.topLeftCorner(60, 60) = chain(60, 1e9);
  a.bottomRightCorner(40, 40) = -chain(40, 1e-12);
  const VectorXd x = some(100);
  VectorXd force(100);
  force << a.topLeftCorner(60, 60) * x.head(60), a.bottomRightCorner(40, 40) * x.tail(40);
  EXPECT_LT((RoundedInverse(a) * force - x).norm(), 1e-4 * x.norm());
}

TEST(RoundedInverse, OfASingularMatrixIsFinite) {
  const MatrixXd laplacian = MatrixXd::NullaryExpr(50, 50, [](Index i, Index j) {
    return i == j ? 2. - (i % 49 == 0) : std::abs(i - j) == 1 ? -1. : 0.;
  });
  EXPECT_TRUE((RoundedInverse(laplacian) * some(50)).allFinite());
  EXPECT_TRUE((RoundedInverse(MatrixXd::Zero(3, 3)) * some(3)).allFinite());
}

TEST(RoundedInverse, OfAMatrixThatIsNotDefiniteIsItsDiagonals) {
  const MatrixXd a{{2, 100}, {100, 2}};
  EXPECT_LT((RoundedInverse(a) * VectorXd::Ones(2) - VectorXd::Constant(2, 0.5)).norm(), 1e-6);
}

TEST(SizesOfTerms, AreTheSameOfSmallAndLargeMatrices) {
  for (const Index n : {50, 1100}) {
    const MatrixXd a = chain(n, 3) - MatrixXd::Constant(n, n, 1);
    const VectorXd v = some(n), sizes = a.cwiseAbs() * v.cwiseAbs();
    EXPECT_LT((sizes_of_terms(a, v) - sizes).norm(), 1e-13 * sizes.norm());
    EXPECT_LT((sizes_of_terms(a, v, 3, 20) - sizes.segment(3, 20)).norm(), 1e-13 * sizes.norm());
  }
}

}  // namespace
}  // namespace tourmaline::solve
