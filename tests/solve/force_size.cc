#include "solve/force_size.h"

#include <gtest/gtest.h>

namespace tourmaline::solve {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Programme {
  explicit Programme(Index n)
      : stiffness(MatrixXd::NullaryExpr(
            n, n,
            [](Index i, Index j) { return i == j ? 3. : -1. / static_cast<double>(n_of(i, j)); })),
        force(VectorXd::Ones(n)) {}

  static Index n_of(Index i, Index j) { return 1 + (i - j) * (i - j); }
  InterfaceProgramme programme() const { return {stiffness, force, points, 0.5}; }
  double size(const VectorXd &d) const {
    return std::max(1., (stiffness.cwiseAbs() * d.cwiseAbs()).maxCoeff());
  }

  MatrixXd stiffness;
  VectorXd force;
  std::vector<ContactPoint> points;
};

TEST(ForceSize, IsThatOfTheLargestTermAtEachPlace) {
  for (const Index n : {40, 1100}) {
    const Programme own(n);
    const InterfaceProgramme programme = own.programme();
    ForceSize size(programme);
    for (const double scale : {0., 2., 100., 5.}) {
      const VectorXd d = VectorXd::LinSpaced(n, -scale, scale);
      EXPECT_NEAR(size.at(d), own.size(d), 1e-13 * own.size(d)) << n << ' ' << scale;
      EXPECT_TRUE(size.is_within(d, 0.9e-6 * own.size(d), 1e-6));
      EXPECT_FALSE(size.is_within(d, 1.1e-6 * own.size(d), 1e-6));
    }
  }
}

TEST(ForceSize, NoResidualThatIsNotANumberIsWithinIt) {
  const Programme own(1100);
  const InterfaceProgramme programme = own.programme();
  const VectorXd d = VectorXd::Ones(1100);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ForceSize(programme).is_within(d, nan, 1e-6));
  EXPECT_FALSE(ForceSize(programme).is_within(nan * d, 1e-9, 1e-6));
}

}  // namespace
}  // namespace tourmaline::solve
