// Label: analytic. Steps of bodies with random loads, from random states: what one route finds in
// one way another finds in another.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "random_contacts.h"
#include "solve/condensed_route.h"
#include "solve/iterative_route.h"
#include "solve/monolithic_route.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {
namespace {

// Laws whose numbers change from place to place by powers of ten.
struct Laws {
  const char *normal, *friction;
  std::size_t n_statuses;  // that contact points come to have
};
void PrintTo(const Laws &laws, std::ostream *out) {
  *out << laws.normal << ' ' << laws.friction;
}

const char *const bilateral = R"("bilateral")", *const unilateral = R"("unilateral")";
const char *const coulomb = R"toml({ law = "coulomb", coefficient = "0.1 + 0.7*x" })toml";
const char *const none = R"("none")";
const char *const tresca = R"toml({ law = "tresca", bound = "10^(6 + 3*sin(40*x + 7))" })toml";
const char *const compliance =
    R"toml({ law = "compliance", coefficient = "10^(11 + 3*sin(50*x + 1))" })toml";
const char *const damped =
    R"toml({ law = "damped", coefficient = "10^(11 + 3*sin(50*x + 1))" })toml";

template <int dim>
casefile::Case body_with(const Laws &laws) {
  const std::string mesh =
      dim == 2
          ? R"({ min = [0, 0], max = [1, 0.5], cells = [5, 2] })"
          : R"({ min = [0, 0, 0], max = [1, 1, 0.5], cells = [2, 2, 1], cell = "hexahedron" })";
  return casefile::read_text("mesh.box = " + mesh + R"toml(
material = { library = "BaTiO3-Liu2014" }
time = { end = 1, steps = 1 }
boundary = [ { on = "top", displacement = [)toml" +
                                 (dim == 2 ? "0, 0" : "0, 0, 0") +
                                 R"toml(], potential = 0, temperature = 0 } ]
contact = { on = "bottom", normal = )toml" +
                                 laws.normal + ", friction = " + laws.friction + " }\n",
                             "body.toml", {});
}

// One after the other: the multipliers, increments and states that routes begin with are those of
// another step.
template <int dim>
class RandomSteps {
 public:
  explicit RandomSteps(const Laws &laws)
      : model_(body_with<dim>(laws)),
        is_prescribed_(body::mask_of(model_.prescribed, model_.n_unknowns())),
        scales_(model_.op.scales(model_.step)) {}

  const Model<dim> &model() const { return model_; }

  void next() {
    before_ = random_state(toss(0.3) ? 0 : 1);
    start_ = random_state(1);
    right_side_.assign(model_.n_unknowns(), 0.);
    if (toss(0.5))  // as rough as loads can be
      model_.op.multiply(model_.step, random_state(1), right_side_);
    else
      for (std::size_t i = 0; i < right_side_.size(); ++i)
        right_side_[i] = is_prescribed_[i] ? 0 : normal_(random_) / scales_[i % n];
  }

  struct Found {
    std::vector<double> state;
    StepOutcome outcome;
  };
  Found solved_by(Route &route) const {
    Found found{start_, {}};
    found.outcome = route.advance(1, right_side_, before_, found.state);
    return found;
  }

  // Over the largest of the field, the worst of all.
  double difference(const Found &a, const Found &b) const {
    std::array<double, n> largest{}, worst{};
    for (std::size_t i = 0; i < a.state.size(); ++i) {
      largest[i % n] = std::max(largest[i % n], std::abs(b.state[i]));
      worst[i % n] = std::max(worst[i % n], std::abs(a.state[i] - b.state[i]));
    }
    double difference = (a.outcome.contact_forces - b.outcome.contact_forces).norm() /
                        std::max(b.outcome.contact_forces.norm(), 1 / scales_[0]);
    for (int c = 0; c < n; ++c)
      difference = std::max(difference, worst[c] / std::max(largest[c], scales_[c]));
    return difference;
  }

 private:
  static constexpr int n = body::Fields<dim>::count;

  bool toss(double chance) { return std::bernoulli_distribution(chance)(random_); }
  std::vector<double> random_state(double size) {
    std::vector<double> state(model_.n_unknowns());
    for (std::size_t i = 0; i < state.size(); ++i)
      state[i] = is_prescribed_[i] ? 0 : size * normal_(random_) * scales_[i % n];
    return state;
  }

  Model<dim> model_;
  std::vector<bool> is_prescribed_;
  std::array<double, n> scales_;
  std::vector<double> before_, start_, right_side_;
  std::mt19937 random_{20261127};
  std::normal_distribution<double> normal_;
};

template <int dim>
using RouteOf = std::unique_ptr<Route>(const Model<dim> &);

template <int dim>
void expect_one_answer(const Laws &laws, int n_steps, RouteOf<dim> route_of) {
  RandomSteps<dim> steps(laws);
  const auto condensed = condensed_route<dim>(steps.model()), other = route_of(steps.model());
  double worst = 0;
  std::set<ContactStatus> seen;
  for (int k = 0; k < n_steps; ++k) {
    steps.next();
    const auto expected = steps.solved_by(*condensed);
    seen.insert(expected.outcome.status.begin(), expected.outcome.status.end());
    try {
      worst = std::max(worst, steps.difference(steps.solved_by(*other), expected));
    } catch (const SolveError &error) {
      ADD_FAILURE() << dim << " dimensions, step " << k << ": " << error.what();
    }
  }
  EXPECT_LT(worst, 1e-8) << dim;
  EXPECT_EQ(seen.size(), laws.n_statuses) << dim;
}

class ConvexLaws : public ::testing::TestWithParam<Laws> {};

TEST_P(ConvexLaws, HaveOneAnswerOnTheMonolithicRouteToo) {
  expect_one_answer<2>(GetParam(), n_programmes, monolithic_route<2>);
  expect_one_answer<3>(GetParam(), n_programmes, monolithic_route<3>);
}

TEST_P(ConvexLaws, HaveOneAnswerOnTheIterativeRouteToo) {
  expect_one_answer<2>(GetParam(), n_programmes, iterative_route<2>);
  expect_one_answer<3>(GetParam(), n_programmes, iterative_route<3>);
}

INSTANTIATE_TEST_SUITE_P(Random, ConvexLaws,
                         ::testing::Values(Laws{bilateral, none, 1}, Laws{bilateral, tresca, 2},
                                           Laws{unilateral, none, 2}, Laws{compliance, none, 2},
                                           Laws{damped, none, 2}));

// No proof says that there is one answer; with these bodies and coefficients there is.
class CoulombsLaw : public ::testing::TestWithParam<Laws> {};

TEST_P(CoulombsLaw, IsSolvedByEveryRoute) {
  constexpr int n_steps = n_programmes / 5;
  expect_one_answer<2>(GetParam(), n_steps, monolithic_route<2>);
  expect_one_answer<3>(GetParam(), n_steps, monolithic_route<3>);
  expect_one_answer<2>(GetParam(), n_steps, iterative_route<2>);
  expect_one_answer<3>(GetParam(), n_steps, iterative_route<3>);
}

INSTANTIATE_TEST_SUITE_P(Random, CoulombsLaw,
                         ::testing::Values(Laws{bilateral, coulomb, 2},
                                           Laws{unilateral, coulomb, 3},
                                           Laws{compliance, coulomb, 3}));

}  // namespace
}  // namespace tourmaline::solve
