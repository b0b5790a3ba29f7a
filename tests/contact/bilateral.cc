#include "tourmaline/contact/bilateral.h"

#include <gtest/gtest.h>

namespace tourmaline::contact {
namespace {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

TEST(Bilateral, AFreeNodeMayOnlyMoveAlongTheFoundation) {
  const auto a = bilateral<2>(Vector2(-1, 0), {});
  ASSERT_EQ(a.directions.cols(), 1);
  EXPECT_TRUE(a.base.isZero(0));
  EXPECT_EQ(a.directions(0, 0), 0);
  EXPECT_EQ(std::abs(a.directions(1, 0)), 1);
}

TEST(Bilateral, OnATiltedFoundationDirectionsAreOrthonormalAndTangential) {
  const Vector3 normal = Vector3(1, 2, -2) / 3;
  const auto a = bilateral<3>(normal, {});
  ASSERT_EQ(a.directions.cols(), 2);
  const Eigen::MatrixXd directions = a.directions;
  EXPECT_LT((directions.transpose() * directions - Eigen::Matrix2d::Identity()).norm(), 1e-15);
  EXPECT_LT((directions.transpose() * normal).norm(), 1e-15);
}

TEST(Bilateral, APrescribedTangentialComponentHoldsTheNode) {
  const auto a = bilateral<2>(Vector2(-1, 0), {std::nullopt, 3e-9});
  EXPECT_EQ(a.directions.cols(), 0);
  EXPECT_EQ(a.base, Vector2(0, 3e-9));
}

TEST(Bilateral, APrescribedNormalComponentHoldsInsteadOfZeroNormalDisplacement) {
  const auto a = bilateral<2>(Vector2(-1, 0), {2e-9, std::nullopt});
  ASSERT_EQ(a.directions.cols(), 1);
  EXPECT_EQ(a.base, Vector2(2e-9, 0));
}

TEST(Bilateral, WithOneComponentPrescribedTheNodeStaysOnATiltedFoundation) {
  const Vector2 normal = Vector2(3, 4) / 5;
  const auto a = bilateral<2>(normal, {8e-9, std::nullopt});
  EXPECT_EQ(a.directions.cols(), 0);
  EXPECT_NEAR(a.base.dot(normal), 0, 1e-24);
  EXPECT_EQ(a.base[0], 8e-9);
}

}  // namespace
}  // namespace tourmaline::contact
