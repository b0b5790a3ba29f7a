// Label: exact. Conjugate gradients on free unknowns, beside a decomposition.

#include "solve/conjugate_gradients.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <limits>
#include <random>

namespace tourmaline::solve {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_definite(Index n) {
  std::mt19937 random(7);
  std::normal_distribution<double> entry;
  const MatrixXd half = MatrixXd::NullaryExpr(n, n, [&] { return entry(random); });
  return half * half.transpose() + MatrixXd::Identity(n, n);
}

struct System {
  MatrixXd a = random_definite(12);
  body::NodeSharing sharing{std::vector<bool>(6, true)};  // two unknowns a node
  FreeUnknowns free{sharing, std::vector<bool>(12, true), std::vector<double>(12),
                    [this](const std::vector<double> &x) {
                      std::vector<double> product(x.size());
                      VectorXd::Map(product.data(), 12) = a * VectorXd::Map(x.data(), 12);
                      return product;
                    }};

  System() {
    for (Index i = 0; i < 12; ++i)
      free.diagonal[i] = a(i, i);
    for (const int held : {0, 5, 9})
      free.is_free[held] = false;
  }
};

TEST(ConjugateGradients, SolveForWhatIsFreeAndLeaveTheRest) {
  const System system;
  std::vector<double> x(12, 0.5), residual(12);
  const VectorXd b = VectorXd::LinSpaced(12, -1, 2);
  VectorXd::Map(residual.data(), 12) = b - system.a * VectorXd::Constant(12, 0.5);
  const double enough = 1e-30 * system.free.size_of(residual);
  ASSERT_TRUE(conjugate_gradients(system.free, residual, enough, 100, x));
  std::vector<Index> unknowns;
  for (Index i = 0; i < 12; ++i)
    if (system.free.is_free[i])
      unknowns.push_back(i);
    else
      EXPECT_EQ(x[i], 0.5);
  const VectorXd left = b - system.a * VectorXd::Map(x.data(), 12);
  EXPECT_LE(left(unknowns).norm(), 1e-12 * b.norm());
}

TEST(ConjugateGradients, SayWhereTheyDoNotComeToAnEnd) {
  const System system;
  std::vector<double> x(12, 0.), residual(12, 1.);
  EXPECT_FALSE(conjugate_gradients(system.free, residual, 1e-30, 2, x));
  residual[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(conjugate_gradients(system.free, residual, 1e-30, 100, x));
}

}  // namespace
}  // namespace tourmaline::solve
