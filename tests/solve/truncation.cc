#include "solve/truncation.h"

#include <gtest/gtest.h>

#include <limits>

namespace tourmaline::solve {
namespace {

using contact::PointLaw;
using contact::Tangent;
using contact::Tresca;
using Eigen::VectorXd;

constexpr double never = std::numeric_limits<double>::infinity();

VectorXd vector(const std::vector<double> &entries) {
  return VectorXd::Map(entries.data(), static_cast<Eigen::Index>(entries.size()));
}

double turn(const PointLaw &law, const VectorXd &d, const VectorXd &direction,
            Turns turns = Turns::kinks) {
  return length_to_turn({0, d.size(), 0.5, law}, d, direction, turns);
}

TEST(LengthToTurn, IsWhereNothingOfTheSlipIsLeftAlongItself) {
  const VectorXd d = vector({3, 4});
  EXPECT_DOUBLE_EQ(turn(Tresca{1}, d, vector({-6, -8})), 0.5);
  EXPECT_DOUBLE_EQ(turn(Tresca{1}, d, vector({-1, 0})), 25. / 3);
  EXPECT_EQ(turn(Tresca{1}, d, vector({6, 8})), never) << "slips on";
  EXPECT_EQ(turn(Tresca{1}, d, vector({4, -3})), never) << "neither on nor back";
}

TEST(LengthToTurn, IsInfiniteWhereTheLawHasNoKink) {
  EXPECT_EQ(turn(Tresca{0}, vector({3, 4}), vector({-6, -8})), never);
}

TEST(LengthToTurn, IsThatToTheBendOfAPointThatIsMovedAcrossOnlyWhenAskedFor) {
  const PointLaw across(Tresca{1}, Tangent::Constant(1, 4));
  const VectorXd d = vector({2}), back = vector({-8});
  EXPECT_EQ(turn(across, d, back, Turns::kinks), never);
  EXPECT_DOUBLE_EQ(turn(across, d, back, Turns::kinks_and_bends), 0.25);
}

TEST(TruncatedStep, StopsAPointAtItsTurnAndNoOther) {
  const std::vector<ContactPoint> points{{0, 1, 1, Tresca{1}}, {1, 1, 1, Tresca{1}}};
  const VectorXd d = vector({1, 1}), direction = vector({-4, -0.5});
  const auto at = [&](double length) {
    return truncated_step(points, d, direction, length, Turns::kinks);
  };
  EXPECT_EQ(at(0.125), vector({0.5, 0.9375}));
  EXPECT_EQ(at(0.25), vector({0, 0.875}));
  EXPECT_EQ(at(1), vector({0, 0.5}));
}

}  // namespace
}  // namespace tourmaline::solve
