#include "solve/exchange_programme.h"

#include <gtest/gtest.h>

#include <random>

#include "contact/coulomb.h"
#include "contact/heat_exchange.h"
#include "contact/unilateral.h"
#include "solve/natural_map.h"

namespace tourmaline::solve {
namespace {

using contact::Exchange;
using contact::HeatExchange;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A plane contact of some nodes, with normal, slip and temperature each, Coulomb's friction that
/// warms and heat that follows pressure and gap.
struct Problem {
  explicit Problem(int nodes, unsigned seed, double coupling = 0.3) : n(nodes) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Index size = 2 * n;
    MatrixXd root(size, size), field(n, n), couples(size, n);
    for (MatrixXd *m : {&root, &field, &couples})
      for (double &entry : m->reshaped())
        entry = normal(random);
    stiffness.resize(3 * n, 3 * n);
    stiffness.topLeftCorner(size, size) =
        root * root.transpose() / double(size) + MatrixXd::Identity(size, size);
    stiffness.topRightCorner(size, n) = coupling * couples;
    stiffness.bottomLeftCorner(n, size) = coupling * couples.transpose();
    stiffness.bottomRightCorner(n, n) =
        -field * field.transpose() / double(n) - MatrixXd::Identity(n, n);
    force.resize(3 * n);
    for (double &f : force)
      f = 2 * normal(random);
    for (Index i = 0; i < n; ++i) {
      points.push_back(
          {2 * i, 1, 1,
           contact::LocalLaw(contact::NormalPoint(std::make_shared<contact::Unilateral>()))});
      points.push_back({2 * i + 1, 1, 1, contact::PointLaw(contact::Tresca{0})});
      FrictionCoupling &friction = couplings.emplace_back();
      friction.slip = static_cast<std::size_t>(2 * i + 1);
      friction.normal = static_cast<std::size_t>(2 * i);
      friction.bound =
          std::make_shared<contact::Coulomb>(contact::FrictionCoefficient{0.4, 0.2, 1, 0, 1}, 0);
      ExchangePoint &heat = exchanges.emplace_back();
      heat.entry = size + i;
      heat.slip = friction.slip;
      heat.normal = friction.normal;
      heat.of_value = 2;
      heat.of_flow = 0.5;
      HeatExchange::Parameters is;
      is.faded = 0.5;
      is.ramp = contact::Ramp(0.7);
      is.by_pressure = {0.8, 1, 0.95};
      is.foundation = 0.3;
      is.friction_share = 0.4;
      heat.law = std::make_shared<HeatExchange>(is);
    }
  }

  ExchangeProgramme programme() const {
    return {{stiffness, force, points, 0, {{2 * n, n, 0}}}, couplings, exchanges};
  }
  CoupledSolution solve(bool newton) const {
    const SolveHeld held = [&](const InterfaceProgramme &left, const VectorXd &start) {
      return solve_coupled({left, couplings}, start, {});
    };
    return solve_exchanging(programme(), VectorXd::Zero(3 * n), {}, held, newton);
  }

  Index n;
  MatrixXd stiffness;
  VectorXd force;
  std::vector<ContactPoint> points;
  std::vector<FrictionCoupling> couplings;
  std::vector<ExchangePoint> exchanges;
};

/// What a solution's rows of exchanges lack, from the laws alone.
double lack(const Problem &problem, const CoupledSolution &found) {
  const VectorXd row = problem.force - problem.stiffness * found.interface.increment;
  double worst = 0;
  for (const ExchangePoint &at : problem.exchanges) {
    const contact::ContactState state = state_at(at, problem.points, found, problem.couplings);
    const double q = at.law->at(at.of_value * found.interface.increment[at.entry], state).flow;
    worst = std::max(worst, std::abs(row[at.entry] + at.of_flow * q));
  }
  return worst;
}

TEST(ExchangeProgramme, NewtonsMethodAndHeldExchangesFindTheSame) {
  int closed = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Problem problem(5, seed);
    const CoupledSolution newton = problem.solve(true), fixed = problem.solve(false);
    ASSERT_TRUE(newton.interface.converged) << seed;
    ASSERT_TRUE(fixed.interface.converged) << seed;
    EXPECT_EQ(fixed.stage, ContactStage::fixed_point);
    EXPECT_LT(lack(problem, newton), 1e-10) << seed;
    EXPECT_LT((newton.interface.increment - fixed.interface.increment).norm(),
              1e-9 * newton.interface.increment.norm())
        << seed;
    for (const double p : newton.pressure)
      closed += p > 0;
  }
  EXPECT_GT(closed, 30);  // and as many are open
  EXPECT_LT(closed, 120);
}

// The merit beside a solution grows with the square of the distance only if the slopes are right.
TEST(ExchangeProgramme, NewtonsMethodConvergesQuadratically) {
  int checked = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Problem problem(5, seed);
    const CoupledSolution found = problem.solve(true);
    ASSERT_TRUE(found.interface.converged);
    const ExchangeProgramme programme = problem.programme();
    DenseBody body(programme.whole);
    const NaturalMap map(CoupledContact{body, problem.points, problem.couplings, problem.exchanges},
                         1);
    VectorXd aside = found.interface.increment;
    for (Index i = 0; i < aside.size(); ++i)
      if (aside[i] != 0)
        aside[i] *= 1 + 1e-4 * static_cast<double>(i % 3 - 1);
    const auto x = map.at(aside);
    const auto direction = map.newton_direction(x);
    ASSERT_TRUE(direction);
    const double before = (aside - found.interface.increment).norm(),
                 after = (aside + direction->d - found.interface.increment).norm();
    EXPECT_LT(after, 20 * before * before) << seed;
    ++checked;
  }
  EXPECT_EQ(checked, 20);
}

}  // namespace
}  // namespace tourmaline::solve
