#include "run/adrift.h"

#include <gmock/gmock.h>

#include "tourmaline/case/case.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A block on a foundation, which supports keep from moving along x alone.
class OnItsFoundation : public testing::Test {
 protected:
  static solve::StepOutcome with(ContactStatus left, ContactStatus right) {
    solve::StepOutcome outcome;
    outcome.status = {left, right};
    outcome.friction_forces = outcome.contact_forces = Eigen::VectorXd::Zero(4);
    return outcome;
  }

  static casefile::Case on_foundation(const std::vector<std::string> &overrides = {}) {
    return casefile::read_text(R"toml(
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [1, 1], cell = "quadrilateral" }
material.library = "silicon"
time = { end = 1, steps = 9 }
[[boundary]]
on = "left"
displacement = [0, "free"]
potential = 0
[contact]
on = "bottom"
normal = "unilateral"
)toml",
                               "case.toml", overrides);
  }

  const casefile::Case asked = on_foundation();
  const std::vector<double> near = std::vector<double>(4 * body::Fields<2>::count, 1e-6);
  const std::vector<double> none = std::vector<double>(near.size(), 0.);
  const solve::Model<2> model{asked};
  Adrift<2> adrift{model};
};

TEST_F(OnItsFoundation, ItIsHeldByOneNodeThatTouches) {
  adrift.step(1, with(ContactStatus::slip, ContactStatus::open), none, near);
  EXPECT_EQ(adrift.warning(), "");
}

TEST_F(OnItsFoundation, ItIsAdriftWhereAllNodesAreOpen) {
  adrift.step(1, with(ContactStatus::slip, ContactStatus::slip), none, near);
  adrift.step(2, with(ContactStatus::open, ContactStatus::open), none, near);
  EXPECT_THAT(adrift.warning(), AllOf(HasSubstr("nothing held the body in step 2:"),
                                      HasSubstr("keeps it from, a translation along y.")));
}

// Displacements may look sound: round-off of a stiffness that has nothing there holds the body.
TEST_F(OnItsFoundation, ItIsNoSolutionWhereALoadWorksOnAMotionThatNothingResists) {
  const auto pulled = [&](int component, std::vector<double> forces) {
    std::vector<double> loads = none;
    for (std::size_t i = 0; i < forces.size(); ++i)
      loads[body::unknown<2>(static_cast<body::Node>(i), component)] = forces[i];
    return loads;
  };
  const auto lifted = with(ContactStatus::open, ContactStatus::open);
  adrift.step(1, lifted, pulled(1, {1, -1, 0.5, -0.5}), near);
  adrift.step(2, lifted, pulled(0, {1, 1, 1, 1}), near);
  EXPECT_THAT(
      [&] {
        adrift.step(4, lifted, pulled(1, {1, -1, 0.5, -0.4}), near);
      },
      ThrowsMessage<SolveError>(HasSubstr("nothing keeps the body from a translation along y")));
}

TEST_F(OnItsFoundation, ItIsNoSolutionWhereContactForcesDoNotBalanceTheLoads) {
  solve::StepOutcome pressed = with(ContactStatus::slip, ContactStatus::slip);
  std::vector<double> loads = none;
  loads[body::unknown<2>(3, 0)] = 1000;
  loads[body::unknown<2>(3, 1)] = -1;
  pressed.contact_forces[1] = 0.25;
  pressed.contact_forces[3] = 0.75;
  adrift.step(1, pressed, loads, near);
  pressed.contact_forces[3] = 0.7;
  EXPECT_THAT([&] { adrift.step(2, pressed, loads, near); },
              ThrowsMessage<SolveError>(HasSubstr("loads and contact forces differ by")));
}

// Loads may be given to six digits; but a body that has moved by a fifth of its size may do so
// until round-off of its stiffness bears what friction does not.
TEST_F(OnItsFoundation, FarAwayForcesBalanceToMoreDigits) {
  solve::StepOutcome pressed = with(ContactStatus::slip, ContactStatus::slip);
  std::vector<double> loads = none, far = near;
  loads[body::unknown<2>(3, 1)] = -1;
  pressed.contact_forces[1] = 1 - 1e-6;
  far[body::unknown<2>(3, 0)] = 2e-3;
  adrift.step(1, pressed, loads, near);
  EXPECT_THAT([&] { adrift.step(2, pressed, loads, far); },
              ThrowsMessage<SolveError>(HasSubstr("loads and contact forces differ by 4")));
  pressed.contact_forces[1] = 1 - 1e-12;
  adrift.step(2, pressed, loads, far);
}

TEST_F(OnItsFoundation, WhereItIsPrescribedItIsNotFarAway) {
  const casefile::Case dragged = on_foundation({"boundary[0].displacement=['0.3*t','free']"});
  const solve::Model<2> model_of(dragged);
  solve::StepOutcome pressed = with(ContactStatus::slip, ContactStatus::slip);
  std::vector<double> loads = none, state = near;
  loads[body::unknown<2>(3, 1)] = -1;
  pressed.contact_forces[1] = 1 - 1e-6;
  for (body::Node node = 0; node < 4; ++node)
    state[body::unknown<2>(node, 0)] = 0.3;
  Adrift<2>(model_of).step(9, pressed, loads, state);
}

TEST_F(OnItsFoundation, ItIsNotAdriftWhereItsMassDampingHoldsIt) {
  const casefile::Case damped = on_foundation({"material.mass_damping=1"});
  const solve::Model<2> model_of(damped);
  Adrift<2> never(model_of);
  never.step(1, with(ContactStatus::open, ContactStatus::open), none, near);
  EXPECT_EQ(never.warning(), "");
}

TEST_F(OnItsFoundation, ARunThatGoesOnKnowsOfTheStepsBefore) {
  adrift.step(2, with(ContactStatus::open, ContactStatus::open), none, near);
  output::SavedNumbers numbers;
  adrift.save(numbers);
  Adrift<2> later(model);
  later.restore(numbers);
  later.step(3, with(ContactStatus::open, ContactStatus::open), none, near);
  EXPECT_THAT(later.warning(), HasSubstr("in 2 steps, first in step 2:"));
}

TEST_F(OnItsFoundation, ABodyThatIsGoneIsNoSolution) {
  adrift.step(1, with(ContactStatus::open, ContactStatus::open), none, near);
  try {
    adrift.step(2, with(ContactStatus::slip, ContactStatus::open), none,
                std::vector<double>(near.size(), 1e9));
    FAIL();
  } catch (const SolveError &error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("step 2: the body has left by 1.4e+09 m"),
                                    HasSubstr("keeps it from a translation along y,")));
  }
}

}  // namespace
}  // namespace tourmaline::run
