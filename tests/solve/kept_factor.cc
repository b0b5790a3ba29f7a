#include "solve/kept_factor.h"

#include <gtest/gtest.h>

#include <random>

namespace tourmaline::solve {
namespace {

using contact::TangentMatrix;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A stiffness of points in a line and systems (1 + D) A + c D of those that are free, D random.
class Systems {
 public:
  explicit Systems(Index n) : a(n, n) {
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j)
        a(i, j) = 1 / (1. + static_cast<double>((i - j) * (i - j))) + (i == j ? 1 : 0);
  }

  InterfaceSystem next(Index held, double strength) {
    std::vector<Index> unknowns;
    SystemRows rows;
    for (Index i = 0; i < a.cols(); ++i)
      if (i % 10 != held) {
        const auto row = static_cast<Index>(unknowns.size());
        const double d = strength * uniform_(random_);
        rows.add_of_force(row, i, TangentMatrix::Constant(1, 1, 1 + d));
        rows.add_local(row, i, TangentMatrix::Constant(1, 1, 2 * d));
        unknowns.push_back(i);
      }
    return rows.system(std::move(unknowns), a.cols(), a.cols());
  }

  VectorXd right_side(const InterfaceSystem &system) {
    return VectorXd::NullaryExpr(system.size(), [&] { return uniform_(random_) - 0.5; });
  }

  MatrixXd a;

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> uniform_;
};

double left(const InterfaceSystem &system, const KeptFactor::Solved &x, const VectorXd &b) {
  return (system.of_force * x.resisted + system.local * x.x - b).norm() / b.norm();
}

TEST(KeptFactor, SolvesSmallSystemsExactly) {
  Systems systems(200);
  const InterfaceSystem system = systems.next(3, 1);
  const VectorXd b = systems.right_side(system);
  const auto x = KeptFactor().solve(system, systems.a, b);
  ASSERT_TRUE(x);
  EXPECT_LT(left(system, *x, b), 1e-13);
  EXPECT_LT((systems.a * x->x - x->resisted).norm(), 1e-13 * x->resisted.norm());
  EXPECT_EQ(x->x[3], 0);
}

TEST(KeptFactor, LeavesALittleOfLargeSystemsThatComeOneAfterTheOther) {
  Systems systems(1300);
  KeptFactor factor;
  for (const Index held : {3, 4, 5}) {
    const InterfaceSystem system = systems.next(held, 0.3);
    ASSERT_TRUE(is_large(system.size()));
    const VectorXd b = systems.right_side(system);
    const auto x = factor.solve(system, systems.a, b);
    ASSERT_TRUE(x);
    EXPECT_LT(left(system, *x, b), 0.31);
    EXPECT_LT((systems.a * x->x - x->resisted).norm(), 1e-13 * x->resisted.norm());
  }
}

// Point by point, then A alone.
TEST(KeptFactor, SolvesALargeSystemThatHasNothingInCommonWithTheLast) {
  Systems systems(1300);
  KeptFactor factor;
  const InterfaceSystem first = systems.next(3, 1e6);
  ASSERT_TRUE(factor.solve(first, systems.a, systems.right_side(first)));
  const InterfaceSystem second = systems.next(3, 0);
  const VectorXd b = systems.right_side(second);
  const auto x = factor.solve(second, systems.a, b);
  ASSERT_TRUE(x);
  EXPECT_LT(left(second, *x, b), 0.31);
}

TEST(KeptFactor, SolvesALargeSystemExactlyWhereTheFactorIsOfNoUse) {
  Systems systems(1200);
  systems.a = MatrixXd::NullaryExpr(1200, 1200, [](Index i, Index j) {
    return std::sin(static_cast<double>(i * j)) + std::cos(static_cast<double>(3 * (i + j)));
  });
  const InterfaceSystem system = systems.next(3, 0);
  const VectorXd b = systems.right_side(system);
  const auto x = KeptFactor().solve(system, systems.a, b);
  ASSERT_TRUE(x);
  EXPECT_LT(left(system, *x, b), 1e-6);  // its condition is what is left
}

TEST(KeptFactor, SaysThatASmallSystemIsNotDefinite) {
  Systems systems(20);
  const InterfaceSystem system = systems.next(3, 0);
  const VectorXd b = systems.right_side(system);
  EXPECT_TRUE(KeptFactor().solve_definite(system, systems.a, b));
  EXPECT_FALSE(KeptFactor().solve_definite(system, -systems.a, b));
}

// What is left of a programme before serves another one no more: a resumed run has nothing of it.
TEST(KeptFactor, GivesTheSameBytesWhateverProgrammeWasBefore) {
  Systems systems(1300);
  KeptFactor factor;
  const InterfaceSystem first = systems.next(3, 0.3), second = systems.next(3, 0.2);
  const VectorXd b = systems.right_side(second);
  ASSERT_TRUE(factor.solve(first, systems.a, systems.right_side(first)));
  const auto alone = KeptFactor().solve(second, systems.a, b);
  KeptFactor same = factor;
  const auto after = same.solve(second, systems.a, b);
  factor.begin();
  const auto anew = factor.solve(second, systems.a, b);
  ASSERT_TRUE(alone && after && anew);
  EXPECT_EQ(anew->x, alone->x);
  EXPECT_NE(after->x, alone->x);  // the first one's directions count
}

}  // namespace
}  // namespace tourmaline::solve
