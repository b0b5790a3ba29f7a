#include "solve/slip_descent.h"

#include <gtest/gtest.h>

#include "random_contacts.h"
#include "random_programmes.h"

namespace tourmaline::solve {
namespace {

using contact::TangentMatrix;

// The body of a programme whose matrix is at hand, with directions as inexact as those of a Krylov
// iteration.
class Dense : public SlipResponse {
 public:
  Dense(const Problem &problem, double inexact) : problem_(problem), inexact_(inexact) {}

  VectorXd force(const VectorXd &d) override {
    asked_for = d;
    const VectorXd resisted = problem_.stiffness * d;
    size_ = std::max({problem_.force.cwiseAbs().maxCoeff(),
                      (problem_.stiffness.cwiseAbs() * d.cwiseAbs()).maxCoeff(), 1e-300});
    ++forces;
    return problem_.force - resisted;
  }

  VectorXd direction(const std::vector<bool> &is_smooth, const std::vector<TangentMatrix> &hessian,
                     const VectorXd &descent) override {
    MatrixXd matrix = problem_.stiffness;
    for (std::size_t i = 0; i < is_smooth.size(); ++i) {
      const ContactPoint &p = problem_.points[i];
      if (is_smooth[i]) {
        matrix.block(p.offset, p.offset, p.size, p.size) += hessian[i];
        continue;
      }
      matrix.middleRows(p.offset, p.size).setZero();
      matrix.middleCols(p.offset, p.size).setZero();
      matrix.block(p.offset, p.offset, p.size, p.size).setIdentity();
    }
    const VectorXd solved = matrix.llt().solve(descent);
    return solved.cwiseProduct(VectorXd::NullaryExpr(solved.size(), [&] {
      return 1 + inexact_ * std::uniform_real_distribution<>(-1, 1)(random_);
    }));
  }

  double force_size() const override { return size_; }
  double force_accuracy() const override { return 1e-15 * size_; }

  int forces = 0;
  VectorXd asked_for;

 private:
  const Problem &problem_;
  double inexact_, size_ = 1;
  std::mt19937 random_{1};
};

InterfaceSolution descended(const Problem &p, const VectorXd &start, Dense &response,
                            int max_iterations = 100) {
  std::vector<double> curvature;
  for (const ContactPoint &at : p.points)
    curvature.push_back(
        at.size == 0 ? 1 : p.stiffness.block(at.offset, at.offset, at.size, at.size).trace());
  return minimise({p.points, curvature}, response, start, {1e-12, max_iterations});
}

// By turns at rest and anywhere.
template <class Problems>
VectorXd start_of(int k, const Problem &p, Problems &problems) {
  return k % 2 ? problems.vector(p.force.size()) : VectorXd(VectorXd::Zero(p.force.size()));
}

template <class Programme>
void expect_minimiser(const InterfaceSolution &found, const Programme &programme) {
  ASSERT_TRUE(found.converged) << "residual " << found.residual;
  ASSERT_LT(violation(programme, found.increment), 1e-9);
}

TEST(SlipDescent, FindsTheOnlyMinimiserOfAThousandRandomProgrammesFromAnyStart) {
  RandomProblems problems(20260102);
  int most = 0, most_forces = 0;
  for (int k = 0; k < 1000; ++k) {
    const Problem p = problems.next();
    if (p.force.size() == 0)
      continue;
    const VectorXd start = start_of(k, p, problems);
    Dense response(p, 0);
    const InterfaceSolution s = descended(p, start, response, 1000);
    ASSERT_NO_FATAL_FAILURE(expect_minimiser(s, p)) << "programme " << k;
    ASSERT_EQ(response.asked_for, s.increment) << "programme " << k;
    most = std::max(most, s.iterations);
    most_forces = std::max(most_forces, response.forces);
  }
  RecordProperty("largest_number_of_iterations", most);
  RecordProperty("largest_number_of_forces", most_forces);
}

TEST(SlipDescent, InexactDirectionsLeadThereToo) {
  RandomProblems problems(3);
  for (int k = 0; k < 200; ++k) {
    const Problem p = problems.next();
    if (p.force.size() == 0)
      continue;
    Dense response(p, 1e-4);
    const InterfaceSolution s = descended(p, problems.vector(p.force.size()), response, 1000);
    ASSERT_NO_FATAL_FAILURE(expect_minimiser(s, p)) << "programme " << k;
  }
}

// Penetrations are points like others: one that may not be, one that grows against a stiffness.
void expect_all_found(NormalKind normal, FrictionKind friction) {
  for (const int dim : {2, 3}) {
    RandomContacts problems(20260201, normal, friction);
    int most = 0;
    for (int k = 0; k < n_programmes; ++k) {
      const ContactProblem contact = problems.next(dim);
      const Problem p{contact.stiffness, contact.force, contact.points, {}};
      const VectorXd start = start_of(k, p, problems);
      Dense response(p, 0);
      const InterfaceSolution s = descended(p, start, response, 4000);
      ASSERT_NO_FATAL_FAILURE(expect_minimiser(s, contact)) << "programme " << k;
      most = std::max(most, s.iterations);
    }
    ::testing::Test::RecordProperty("largest_number_of_iterations_" + std::to_string(dim) + "D",
                                    most);
  }
}

TEST(SlipDescent, FindsContactThatOpensFromAnyStart) {
  expect_all_found(NormalKind::unilateral, FrictionKind::none);
  expect_all_found(NormalKind::bilateral, FrictionKind::tresca);
}

TEST(SlipDescent, FindsContactThatYieldsFromAnyStart) {
  expect_all_found(NormalKind::compliance, FrictionKind::none);
  expect_all_found(NormalKind::damped, FrictionKind::none);
}

// From 10 m a point moves to where it belongs by the hand calculation, (10 - 2) N / 4 N/m.
TEST(SlipDescent, APointAloneGivesTheHandCalculation) {
  Problem p{MatrixXd::Constant(1, 1, 4),
            VectorXd::Constant(1, 10),
            {{0, 1, 0.5, contact::Tresca{4}}},
            {2}};
  Dense response(p, 0);
  const InterfaceSolution s = descended(p, VectorXd::Constant(1, 10), response);
  EXPECT_DOUBLE_EQ(s.increment[0], 2);
  EXPECT_DOUBLE_EQ(s.force[0], 2);
  EXPECT_EQ(s.status[0], ContactStatus::slip);
}

// A point that something else moves sideways by 3 m: no kink is left, and the force balances the
// law's, 4 d + 2 d / |(d, 3)| = 10.
TEST(SlipDescent, APointThatIsMovedSidewaysHasNoKink) {
  Problem p{MatrixXd::Constant(1, 1, 4),
            VectorXd::Constant(1, 10),
            {{0, 1, 1, contact::PointLaw(contact::Tresca{2}, contact::Tangent::Constant(1, 3))}},
            {2}};
  Dense response(p, 0);
  const double d = descended(p, VectorXd::Zero(1), response).increment[0];
  EXPECT_NEAR(4 * d + 2 * d / std::hypot(d, 3), 10, 1e-11);
}

TEST(SlipDescent, WhenItMayNotIterateItSaysWhichPointsAreUnsettled) {
  Problem p{MatrixXd::Identity(2, 2), VectorXd::Constant(2, 10), {}, {1, 100}};
  p.points = {{0, 1, 1, contact::Tresca{1}}, {1, 1, 1, contact::Tresca{100}}};
  Dense response(p, 0);
  const InterfaceSolution s = descended(p, VectorXd::Zero(2), response, 0);
  EXPECT_FALSE(s.converged);
  EXPECT_EQ(s.unsettled, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace tourmaline::solve
