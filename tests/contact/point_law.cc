#include "contact/point_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ellipse.h"
#include "tangents.h"

namespace tourmaline::contact {
namespace {

Friction tresca(double bound) {
  return Tresca{bound};
}
// Half axes a and b, at 30 degrees to the components.
Friction ellipse(double a, double b) {
  const Eigen::Matrix2d axes = Eigen::Rotation2Dd(std::acos(-1) / 6).toRotationMatrix();
  return OwnLaw{std::make_shared<verified::Ellipse>(
      axes * Eigen::Vector2d(a * a, b * b).asDiagonal() * axes.transpose())};
}

TEST(PointLaw, WithoutKnownSlipItIsTheLaw) {
  const PointLaw point(Tresca{5});
  EXPECT_EQ(point.traction(plane(30, 40), 2), Tresca{5}.traction(plane(30, 40)));
  EXPECT_EQ(point.traction_derivative(plane(30, 40), 2),
            Tresca{5}.traction_derivative(plane(30, 40)));
  EXPECT_EQ(point.hessian(plane(3, 4)), Tresca{5}.hessian(plane(3, 4)));
  EXPECT_EQ(point.status(plane(3, 4), 2), ContactStatus::stick);
  EXPECT_TRUE(point.has_kink(2));
  EXPECT_FALSE(point.has_bend(2));
}

TEST(PointLaw, HeldAtRestAcrossItSticksUpToTheBoundAlong) {
  const PointLaw point(Tresca{5}, along(0));
  EXPECT_EQ(point.traction(along(4.9), 2)[0], 4.9);
  EXPECT_EQ(point.traction(along(-7), 2)[0], -5);
  EXPECT_EQ(point.status(along(5), 2), ContactStatus::stick);
  EXPECT_EQ(point.status(along(5.1), 2), ContactStatus::slip);
  EXPECT_EQ(point.traction_derivative(along(4), 2)(0, 0), 1);
  EXPECT_EQ(point.traction_derivative(along(6), 2)(0, 0), 0);
  EXPECT_TRUE(point.has_kink(1));
}

TEST(PointLaw, MovedAcrossTheTractionIsAlongTheWholeSlip) {
  // d = (3, 4): lambda = S d / |d|.
  const PointLaw point(Tresca{5}, along(4));
  EXPECT_DOUBLE_EQ(point.dissipation(along(3)), 25);
  EXPECT_DOUBLE_EQ(point.gradient(along(3))[0], 3);
  EXPECT_NEAR(point.traction(along(3 + 7 * 3.), 7)[0], 3, 1e-14);
  EXPECT_EQ(point.status(along(0), 7), ContactStatus::slip);
  EXPECT_TRUE(point.is_smooth_at(along(0)));
  EXPECT_FALSE(point.has_kink(1));
  EXPECT_TRUE(point.has_bend(1));
  EXPECT_LT((point.whole_traction(along(3), along(3), along(99)) - plane(3, 4)).norm(), 1e-14);
}

TEST(PointLaw, WhollyMovedItSlipsAgainstTheBound) {
  const PointLaw point(Tresca{5}, plane(-3e-9, 4e-9));
  EXPECT_EQ(point.status({}, 1), ContactStatus::slip);
  EXPECT_LT((point.whole_traction({}, {}, plane(99, 99)) - plane(-3, 4)).norm(), 1e-14);
  EXPECT_NEAR(point.dissipation({}), 25e-9, 1e-23);
}

TEST(PointLaw, HeldAtRestItBearsWhatItCanAndNoMore) {
  EXPECT_EQ(PointLaw(Tresca{5}, along(0)).whole_traction({}, {}, along(3))[0], 3);
  EXPECT_EQ(PointLaw(Tresca{5}, along(0)).whole_traction({}, {}, along(-30))[0], -5);
  EXPECT_EQ(PointLaw(Tresca{5}, along(0)).status({}, 1), ContactStatus::stick);
  // 3 along the free direction leaves 4 for the other.
  const PointLaw half(Tresca{5}, along(0));
  EXPECT_EQ(half.whole_traction(along(0), along(3), along(-2)), plane(3, -2));
  EXPECT_LT((half.whole_traction(along(0), along(3), along(-9)) - plane(3, -4)).norm(), 1e-14);
  // It slips along the free direction alone: nothing is left for the other.
  EXPECT_EQ(half.whole_traction(along(1e-9), along(5), along(-9)), plane(5, 0));
}

TEST(PointLaw, WithBoundZeroNothingIsBorne) {
  EXPECT_EQ(PointLaw(Tresca{0}, along(0)).whole_traction({}, {}, along(3))[0], 0);
  EXPECT_EQ(PointLaw(Tresca{0}, along(2)).traction(along(3), 1)[0], 0);
}

// Least by trisection of x z - r z^2 / 2 - j(z), which is what (x - lambda) / r = z maximises.
double best_slip(const PointLaw &point, double x, double r) {
  double low = -2 * std::abs(x) / r - 1, high = -low;
  const auto value = [&](double z) { return r * z * z / 2 - x * z + point.dissipation(along(z)); };
  for (int k = 0; k < 300; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (value(a) < value(b) ? high : low) = value(a) < value(b) ? b : a;
  }
  return (low + high) / 2;
}

class AnyLaw : public ::testing::TestWithParam<int> {
 protected:
  Friction law() const { return GetParam() ? ellipse(1, 0.3) : tresca(1); }
};

TEST_P(AnyLaw, TheTractionIsThatOfTheLeastValueOfThePointsOwnProblem) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const double o = trial % 5 ? normal(random) * std::pow(10., -(trial % 7)) : 0;
    const double x = 2 * normal(random), r = std::pow(10., normal(random));
    const PointLaw point(law(), along(o));
    const double z = (x - point.traction(along(x), r)[0]) / r;
    // Trisection finds the place of a minimum to the root of round-off.
    EXPECT_NEAR(z, best_slip(point, x, r), 1e-6 * (1 + 1 / r)) << o << ' ' << x << ' ' << r;
    if (o != 0) {
      EXPECT_NEAR(point.gradient(along(z))[0], point.traction(along(x), r)[0],
                  1e-12 * (1 + 1 / (r * std::abs(o))));
    }
  }
}

TEST_P(AnyLaw, DerivativesEqualCentralDifferences) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  const double h = 1e-6;
  for (int trial = 0; trial < 300; ++trial) {
    const double o = normal(random), x = 2 * normal(random), r = 0.7;
    if (std::abs(o) < 0.05)
      continue;  // the curvature spoils the difference
    const PointLaw point(law(), along(o));
    EXPECT_NEAR(point.traction_derivative(along(x), r)(0, 0),
                (point.traction(along(x + h), r)[0] - point.traction(along(x - h), r)[0]) / (2 * h),
                1e-7);
    EXPECT_NEAR(point.hessian(along(x))(0, 0),
                (point.gradient(along(x + h))[0] - point.gradient(along(x - h))[0]) / (2 * h),
                1e-6);
    EXPECT_NEAR(point.gradient(along(x))[0],
                (point.dissipation(along(x + h)) - point.dissipation(along(x - h))) / (2 * h),
                1e-8);
  }
}

TEST_P(AnyLaw, TheWholeTractionAnswersTheWholeSlip) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    const double o = normal(random), x = 2 * normal(random), r = 0.7;
    const PointLaw point(law(), along(o)), all(law());
    const Tangent free = point.traction(along(x), r);
    const double z = (x - free[0]) / r;
    const Tangent lambda = point.whole_traction(along(z), free, along(normal(random)));
    EXPECT_LT((lambda - all.gradient(plane(z, o))).norm(), 1e-12);
    EXPECT_NEAR(lambda.dot(plane(z, o)), point.dissipation(along(z)), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(TrescaAndAnEllipse, AnyLaw, ::testing::Values(0, 1));

// The projection of the ellipse on the free direction is longer than its section: without slip the
// law can bear all of it, with a traction across.
TEST(PointLaw, AnEllipseHeldAcrossBearsItsWholeLengthAlong) {
  const PointLaw point(ellipse(1, 0.3), along(0));
  const double length = point.dissipation(along(1));
  EXPECT_EQ(point.status(along(0.999 * length), 1), ContactStatus::stick);
  EXPECT_NEAR(point.traction(along(0.999 * length), 1)[0], 0.999 * length, 1e-14);
  EXPECT_EQ(point.status(along(1.001 * length), 1), ContactStatus::slip);
  EXPECT_NEAR(point.traction(along(9), 1)[0], length, 1e-9);
}

/// Bounds for each component on its own, whose dissipation has kinks along the axes.
class Square : public FrictionLaw {
 public:
  double dissipation(const Tangent &d) const override { return d.lpNorm<1>(); }
  Tangent traction(const Tangent &x) const override { return x.cwiseMax(-1).cwiseMin(1); }
  TangentMatrix traction_derivative(const Tangent &x) const override {
    return (x.array().abs() <= 1).cast<double>().matrix().asDiagonal();
  }
  ContactStatus status(const Tangent &x) const override {
    return traction(x) == x ? ContactStatus::stick : ContactStatus::slip;
  }
  bool is_smooth_at(const Tangent &d) const override { return (d.array() != 0).all(); }
  Tangent gradient(const Tangent &d) const override { return d.array().sign(); }
  TangentMatrix hessian(const Tangent &d) const override {
    return TangentMatrix::Zero(d.size(), d.size());
  }
};

TEST(PointLaw, KinksThatAKnownSlipDoesNotSmoothStay) {
  const Friction square = OwnLaw{std::make_shared<Square>()};
  const PointLaw point(square, along(0.2));
  EXPECT_TRUE(point.has_kink(1));
  EXPECT_FALSE(point.has_bend(1));
  EXPECT_EQ(point.traction(along(0.4), 3)[0], 0.4);
  EXPECT_EQ(point.traction(along(4), 3)[0], 1);
  EXPECT_EQ(point.status(along(0.4), 3), ContactStatus::slip);
  EXPECT_EQ(point.whole_traction(along(0), along(0.4), along(-9)), plane(0.4, 1));
  // Moved along one axis of the square the answer along the other is open: the nearest there is.
  const PointLaw held(square, plane(-0.2, 0));
  EXPECT_EQ(held.whole_traction({}, {}, plane(9, 0.3)), plane(-1, 0.3));
  EXPECT_EQ(held.whole_traction({}, {}, plane(9, 3)), plane(-1, 1));
}

}  // namespace
}  // namespace tourmaline::contact
