// Contact where nothing happens yet, nothing happens any more, or a support or an electrode has the
// last word.

#include <gmock/gmock.h>

#include "closed_balances.h"
#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

const std::string square = R"toml(
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [3, 3], cell = "quadrilateral" }
time = { end = 1, steps = 10 }
)toml";
const std::string ceramic = "material.library = \"BaTiO3-Liu2014\"\n",
                  not_piezoelectric = "material.library = \"silicon\"\n";

class QuietContact : public ::testing::TestWithParam<const char *> {};

TEST_P(QuietContact, WaitsBeforeAGapUntilTheLoadComes) {
  const RunCase run = run_text(square + ceramic + R"toml(
[[boundary]]
on = "bottom"
displacement = [0, 0]
potential = 0
[[boundary]]
on = "top"
traction = ["1e6*max(0, t - 0.5)", 0]
[contact]
on = "right"
gap = 1e-8
normal = "unilateral"
)toml",
                               {GetParam()});
  const Table history = run.history();
  expect_closed_balances(history);
  EXPECT_LT(history.numbers("max_displacement")[3], 1e-20);
  EXPECT_GT(history.numbers("max_pressure").back(), 0);
}

// Charges that do not change any more have no work but that of round-off, or of what iterations
// leave.
TEST_P(QuietContact, HoldsAVoltageThatHasNothingToDoWithWhatMoves) {
  const RunCase run = run_text(square + not_piezoelectric + R"toml(
[[boundary]]
on = "top"
displacement = ["1e-9*t", "-1e-9*t"]
potential = 1
[[boundary]]
on = "left"
potential = 0
[contact]
on = "bottom"
normal = "unilateral"
)toml",
                               {GetParam()});
  EXPECT_EQ(run.history().n_rows(), 10u);
  EXPECT_LT(largest(run.history(), "energy_imbalance"), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(OnEachRoute, QuietContact,
                         ::testing::Values("solver.method='condensed'",
                                           "solver.method='monolithic'",
                                           "solver.body='iterative'"));

TEST(Leak, EndsWhereThePotentialIsThatOfTheFoundation) {
  const RunCase run = run_text(square + not_piezoelectric + R"toml(
[[boundary]]
on = "top"
displacement = ["1e-9*t", "-1e-9*t"]
potential = 0
[contact]
on = "bottom"
normal = "unilateral"
electric = { law = "leak", coefficient = 1e-3, foundation_potential = 1 }
)toml");
  for (const double potential : run.contact().numbers("potential"))
    EXPECT_NEAR(potential, 1, 0.01);
  EXPECT_LT(largest(run.history(), "energy_imbalance"), 1e-10);
}

// The facets of the one reach a node of the other.
TEST(Leak, BesideAnotherContactIsBookedWhole) {
  const RunCase run = run_text(square + ceramic + R"toml(
[[boundary]]
on = "bottom"
displacement = [0, 0]
potential = 0
[[contact]]
on = "left"
name = "a"
normal = "unilateral"
[[contact]]
on = "top"
name = "b"
normal = "unilateral"
electric = { law = "leak", coefficient = 1e-7, foundation_potential = 2 }
)toml");
  const Table history = run.history();
  expect_closed_balances(history);
  EXPECT_NEAR(history.numbers("charge_bottom").back() / history.numbers("charge_top").back(), -1,
              1e-10);
}

// What crosses there would have to enter the circuit.
TEST(ChargeExchange, ByTheContactsStateIsRefusedWhereAnElectrodeFloats) {
  const auto with = [](const std::string &electrode, const std::string &ramp) {
    return run_text(square + not_piezoelectric + R"toml(
[[boundary]]
on = "bottom"
displacement = [0, "1e-9*t"]
potential = 0
[[electrode]]
name = "e"
on = "right"
)toml" + electrode + R"toml(
[contact]
on = "top"
electric = { law = "exchange", coefficient = 1e-4, foundation_potential = 3)toml" +
                    ramp + " }\n");
  };
  try {
    with("charge = 1e-7", ", ramp = 1e-6");
    FAIL();
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("touches electrode \"e\", whose voltage is not"));
  }
  expect_closed_balances(with("charge = 1e-7", "").history());
  expect_closed_balances(with("voltage = 5", ", ramp = 1e-6").history());
}

// On both routes, and though nothing presses it any more.
TEST(DampedContact, RubsANodeThatASupportMovesAsLongAsItIsInside) {
  for (const std::string route : {"condensed", "monolithic"}) {
    const Table contact = run_text(square + ceramic + R"toml(
[[boundary]]
on = ["top", "right"]
displacement = ["1e-8*t", "-1e-8*sin(pi*t)"]
[[boundary]]
on = "top"
potential = 0
[contact]
on = "bottom"
normal = { law = "damped", coefficient = 1e14 }
friction = { law = "tresca", bound = 1e4 }
)toml",
                                   {"time={end=0.9,steps=9}", "solver.method='" + route + "'"})
                              .contact();
    const std::vector<double> x = contact.numbers("x"), p = contact.numbers("normal_traction"),
                              tau = contact.numbers("tangential_traction_x"),
                              step = contact.numbers("step");
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] < 0.0099)
        continue;
      EXPECT_EQ(p[i] < 0, step[i] <= 5) << route << ", step " << step[i];
      EXPECT_NEAR(tau[i], -1e4, 1e-6) << route << ", step " << step[i];
      EXPECT_EQ(contact.columns.at("status")[i], "slip") << route << ", step " << step[i];
    }
  }
}

}  // namespace
}  // namespace tourmaline::verified
