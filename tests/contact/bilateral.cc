#include "contact/bilateral.h"

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

TEST(Bilateral, WithAnotherBaseANodeIsWhatItIsMadeAnew) {
  const Vector3 normal = Vector3(1, 2, -2) / 3;
  for (const bool is_second : {false, true}) {
    auto moved = bilateral<3>(normal, {1., is_second ? std::optional(5.) : std::nullopt, {}}, 3);
    const std::array<std::optional<double>, 3> other{
        -2e-9, is_second ? std::optional(4e-9) : std::nullopt, {}};
    moved.set_base(other, 1e-9);
    const auto anew = bilateral<3>(normal, other, 1e-9);
    EXPECT_EQ(moved.base, anew.base);
    EXPECT_NEAR(moved.base.dot(normal), 1e-9, 1e-24);
    EXPECT_EQ(moved.tangent(), anew.tangent());
  }
}

TEST(Bilateral, FreeAndHeldDirectionsTogetherAreAnOrthonormalBasisOfTheTangentPlane) {
  for (const Vector3 &normal : {Vector3(1, 0, 0), Vector3(Vector3(1, 2, -2) / 3),
                                Vector3(Vector3(3, 0, 4) / 5), Vector3(Vector3(0, 3, 4) / 5)})
    for (int held = 0; held < 8; ++held) {
      std::array<std::optional<double>, 3> prescribed;
      for (int c = 0; c < 3; ++c)
        if (held & 1 << c)
          prescribed[c] = 1e-9 * (c + 1);
      const auto a = bilateral<3>(normal, prescribed);
      const Eigen::MatrixXd tangent = a.tangent();
      ASSERT_EQ(tangent.cols(), 2);
      EXPECT_LT((tangent.transpose() * tangent - Eigen::Matrix2d::Identity()).norm(), 1e-15);
      EXPECT_LT((tangent.transpose() * normal).norm(), 1e-15);
      const Eigen::MatrixXd directions = a.directions;
      const Eigen::VectorXd along = directions.transpose() * a.base;
      EXPECT_LT(along.norm(), 1e-24);
    }
}

TEST(Bilateral, WhatPrescribedComponentsMoveAlongTheFoundationIsKnownSlip) {
  // Moved along y, free along z; z was somewhere else before.
  const auto a = bilateral<3>(Vector3(-1, 0, 0), {std::nullopt, 3e-9, std::nullopt});
  ASSERT_EQ(a.held.cols(), 1);
  const Vector3 slip = a.held * a.held_slip(Vector3(0, 1e-9, 7e-9));
  EXPECT_LT((slip - Vector3(0, 2e-9, 0)).norm(), 1e-24);
}

TEST(Bilateral, OnATiltedFoundationOneMovedComponentTakesTheNodeAlongIt) {
  // u_x = 8e-9 and u.nu = 0 leave u = 10e-9 (4, -3) / 5.
  const auto a = bilateral<2>(Vector2(3, 4) / 5, {8e-9, std::nullopt});
  ASSERT_EQ(a.held.cols(), 1);
  const Vector2 slip = a.held * a.held_slip(Vector2::Zero());
  EXPECT_LT((slip - 10e-9 * Vector2(4, -3) / 5).norm(), 1e-23);
}

TEST(Bilateral, HeldAtRestANodeHasNoSlipAtAll) {
  const auto a = bilateral<2>(Vector2(3, 4) / 5, {0.1, std::nullopt});
  const Vector2 before = a.base + 1e-17 * Vector2(4, -3);
  EXPECT_TRUE(a.held_slip(before).isZero(0));
  EXPECT_FALSE(a.held_slip(before + 1e-14 * Vector2(4, -3)).isZero(0));
}

TEST(Bilateral, AForceSplitsIntoFrictionPressureAndWhatTheSupportBears) {
  // Normal 7 N, friction 2 N down the foundation, support -3 N in the one prescribed component.
  const Vector2 normal = Vector2(3, 4) / 5, friction = 2 * Vector2(4, -3) / 5;
  const auto a = bilateral<2>(normal, {8e-9, std::nullopt});
  const Vector2 support = a.support(7 * normal + friction + Vector2(-3, 0), friction);
  EXPECT_LT((support - Vector2(-3, 0)).norm(), 1e-14);
  EXPECT_EQ(support[1], 0);
}

TEST(Bilateral, WhereAllIsPrescribedWhatIsNormalIsTheFoundations) {
  const auto a = bilateral<2>(Vector2(0, -1), {1e-9, 0.});
  EXPECT_EQ(a.support(Vector2(5, 7), Vector2(2, 0)), Vector2(3, 0));
}

TEST(Bilateral, AFreeNodeHasNoSupport) {
  const auto a = bilateral<3>(Vector3(Vector3(1, 2, -2) / 3), {});
  EXPECT_TRUE(a.support(Vector3(5, 7, 1), Vector3(1, 0, 0)).isZero(0));
}

}  // namespace
}  // namespace tourmaline::contact
