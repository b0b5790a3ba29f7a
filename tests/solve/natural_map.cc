#include "solve/natural_map.h"

#include <gtest/gtest.h>

#include <functional>

#include "random_contacts.h"

namespace tourmaline::solve {
namespace {

using contact::FrictionCoefficient;
using contact::Tangent;
using Place = NaturalMap::Place;

// How the bound of a problem's points depends on their state.
using Bounds = std::function<std::shared_ptr<const contact::FrictionBound>()>;

std::shared_ptr<const contact::FrictionBound> falling(double before) {
  return std::make_shared<contact::Coulomb>(FrictionCoefficient{0.8, 0.3, 0.5, before, 1}, 0.1, 3);
}

// F at d + h e, and with the shares of the place moved.
VectorXd difference(const NaturalMap &map, const Place &x, const VectorXd &along,
                    const VectorXd &shares, double h) {
  const auto at = [&](double t) {
    const VectorXd share = x.share + t * shares;
    return map.value(map.at(x.d + t * along, share));
  };
  return (at(h) - at(-h)) / (2 * h);
}

// Newton's direction z solves F + F' z = 0: what the difference quotient of F along z lacks of -F,
// but for points that are held, which go to d = 0.
double error_of_direction(const NaturalMap &map, const Place &x) {
  const auto direction = map.newton_direction(x);
  if (!direction)
    return HUGE_VAL;
  const double size = 1 + direction->d.norm() + direction->share.norm();
  const VectorXd value = map.value(x);
  const VectorXd change = difference(map, x, direction->d, direction->share, 1e-7 / size);
  return (value + change).norm() / (value.norm() + change.norm());
}

class NewtonsDirection : public ::testing::Test {
 protected:
  // Where a kink lies within the difference the comparison means nothing; that is rare.
  void check(RandomContacts problems, const std::optional<double> ramp, const Bounds &bounds = {}) {
    int wrong = 0, all = 0;
    for (int k = 0; k < 60; ++k)
      for (const int dim : {2, 3}) {
        ContactProblem p = problems.next(dim);
        if (bounds)
          for (FrictionCoupling &coupling : p.couplings)
            coupling.bound = bounds();
        if (k % 3 == 0 && dim == 2)
          move_across(p, problems);
        const InterfaceProgramme convex{p.stiffness, p.force, p.points};
        const NaturalMap map({convex, p.couplings}, 1, ramp);
        const Place x = map.at(problems.vector(p.force.size()));
        wrong += !(error_of_direction(map, x) < 1e-5);
        ++all;
      }
    EXPECT_LE(wrong, all / 30);
  }

  // Something else moves every other point along a direction that the problem does not have.
  static void move_across(ContactProblem &p, RandomContacts &problems) {
    for (std::size_t j = 0; j < p.couplings.size(); j += 2) {
      contact::LocalLaw &law = p.points[p.couplings[j].slip].law;
      law = contact::PointLaw(law.friction().law(), Tangent(problems.vector(1)));
    }
  }
};

TEST_F(NewtonsDirection, SolvesTheLinearisedMapWhereFrictionDependsOnThePressure) {
  for (const auto normal :
       {NormalKind::bilateral, NormalKind::unilateral, NormalKind::compliance, NormalKind::damped})
    check(RandomContacts(1, normal, FrictionKind::coulomb), {});
}

TEST_F(NewtonsDirection, SolvesItWhereAnOpenPointCarriesNoFriction) {
  for (const auto normal : {NormalKind::unilateral, NormalKind::compliance, NormalKind::damped})
    check(RandomContacts(2, normal, FrictionKind::tresca), {});
}

TEST_F(NewtonsDirection, SolvesItWhereTheCoefficientFallsWithTheSlip) {
  for (const auto normal : {NormalKind::bilateral, NormalKind::unilateral, NormalKind::compliance})
    for (const double before : {0., 0.4})
      check(RandomContacts(3, normal, FrictionKind::coulomb), {},
            [before] { return falling(before); });
}

TEST_F(NewtonsDirection, SolvesItWithSharesOfWhatPointsCarryThatJustTouch) {
  for (const double ramp : {0.1, 10.})
    for (const auto friction : {FrictionKind::tresca, FrictionKind::coulomb})
      for (const auto normal : {NormalKind::unilateral, NormalKind::compliance})
        check(RandomContacts(4, normal, friction), ramp);
}

TEST(NaturalMap, TurnsAreWherePointsChangeTheirBranch) {
  // Two points alone on a unit stiffness: one opens at a half, the other slips at a quarter.
  const MatrixXd stiffness = MatrixXd::Identity(2, 2);
  const VectorXd force = VectorXd::Zero(2);
  const std::vector<ContactPoint> points{
      {0, 1, 1, contact::NormalPoint(std::make_shared<contact::Compliance>(1, 1))},
      {1, 1, 2, contact::Tresca{1}}};
  const InterfaceProgramme convex{stiffness, force, points};
  const std::vector<FrictionCoupling> couplings;
  const NaturalMap map({convex, couplings}, 1);
  // y = f - d + d is that of the force alone: move it instead
  const Place x{VectorXd::Zero(2), VectorXd{{1, 1}}, {}};
  const std::vector<double> turns =
      map.turns(x, {VectorXd::Zero(2), VectorXd{{2, -4}}, VectorXd()});
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_NEAR(turns[0], 0.25, 1e-5);
  EXPECT_NEAR(turns[1], 0.5, 1e-5);
}

TEST(NaturalMap, ItIsZeroAtTheSolutionAndNowhereNear) {
  // One node, A = diag(2, 2), pressed with 4 N, pulled with 3 N, mu = 1/2: slips by 1/2 m.
  const MatrixXd stiffness = 2 * MatrixXd::Identity(2, 2);
  const VectorXd force{{4, 3}};
  const std::vector<ContactPoint> points{
      {0, 1, 0.5, contact::NormalPoint(std::make_shared<contact::Unilateral>())},
      {1, 1, 0.5, contact::Tresca{0}}};
  const std::vector<FrictionCoupling> couplings{
      {1, 0, 0, false, std::make_shared<contact::Coulomb>(FrictionCoefficient{0.5, 0.5}, 0)}};
  const InterfaceProgramme convex{stiffness, force, points};
  const NaturalMap map({convex, couplings}, 1);
  EXPECT_LT(map.merit(map.at(VectorXd{{0, 0.5}})), 1e-30);
  EXPECT_NEAR(map.value(map.at(VectorXd{{0, 0.75}}))[1], -0.5, 1e-15);
  EXPECT_NEAR(map.value(map.at(VectorXd{{0.25, 0.5}}))[0], -0.5, 1e-15);
  // Half of the friction: (3 - 1) / 2.
  EXPECT_LT(NaturalMap({convex, couplings}, 0.5).merit(map.at(VectorXd{{0, 1}})), 1e-30);
}

}  // namespace
}  // namespace tourmaline::solve
