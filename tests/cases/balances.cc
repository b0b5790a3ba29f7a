#include "closed_balances.h"
#include "partly_held.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> all_cases() {
  std::vector<std::string> files{"cases/ouafik-2020/conductive.toml",
                                 "cases/ouafik-2020/insulated.toml"};
  const fs::path root = TOURMALINE_SOURCE_DIR;
  for (const auto &entry : fs::directory_iterator(root / "tests" / "reference" / "third"))
    if (entry.is_directory())
      files.push_back(fs::relative(entry.path() / "case.toml", root));
  std::sort(files.begin(), files.end());
  return files;
}

class Balances : public ::testing::TestWithParam<std::string> {};

TEST_P(Balances, OfEnergyForcesChargeAndHeatCloseInEveryStep) {
  const Table history = RunCase(GetParam(), {}).history();
  expect_closed_balances(history, 1e-9);
}

TEST_P(Balances, FrictionAndTheEulerStepOnlyTakeEnergy) {
  const Table history = RunCase(GetParam(), {}).history();
  for (const double dissipated : history.numbers("friction_dissipation"))
    EXPECT_GE(dissipated, 0);
  for (const double lost : history.numbers("time_step_loss"))
    EXPECT_GE(lost, 0);
}

INSTANTIATE_TEST_SUITE_P(Cases, Balances, ::testing::ValuesIn(all_cases()));

TEST(Dissipation, OfFrictionIsTheBoundTimesTheSlipRateOfEverySlippingNode) {
  const RunCase run("cases/ouafik-2020/conductive.toml", {"mesh.box.cells=[16,16]"});
  const Table contact = run.contact();
  const std::vector<double> dissipated = run.history().numbers("friction_dissipation"),
                            rate = contact.numbers("slip_rate");
  for (std::size_t n = 0; n < dissipated.size(); ++n) {
    double by_hand = 0;
    for (std::size_t i = 0; i < 17; ++i)
      by_hand += 15 * rate[17 * n + i] * (i == 0 || i == 16 ? 0.5 : 1) * 0.1 / 16;
    EXPECT_NEAR(dissipated[n], by_hand, 1e-9 * by_hand);
  }
}

// Components that are prescribed slip, too: 1e4 N/m^2 on 0.1 m at 1e-6 m/s, but for what the heat
// of the deformation still moves.
TEST(Dissipation, OfABlockThatIsDraggedAlongHasItsHeldCornerToo) {
  const RunCase run = run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [16, 16] }
material.library = "BaTiO3-Liu2014"
time = { end = 10, steps = 10 }
boundary = [ { on = "right", displacement = ["1e-6*t", "free"], potential = 0, temperature = 0 },
             { on = "top", displacement = ["free", 0] } ]
contact = { on = "bottom", friction = { law = "tresca", bound = 1e4 } }
)toml");
  EXPECT_NEAR(run.history().numbers("friction_dissipation").back(), 1e-3, 1e-9);
  expect_closed_balances(run.history());
}

TEST(Dissipation, IsNeverNegativeWhereNormalsAreTiltedToWhatIsHeld) {
  for (const char *route :
       {"solver.method=condensed", "solver.method=monolithic", "solver.body=iterative"}) {
    const Table history = run_text(rimmed_sleeve, {route}).history();
    EXPECT_GT(largest(history, "friction_dissipation"), 0) << route;
    for (const double dissipated : history.numbers("friction_dissipation"))
      EXPECT_GE(dissipated, 0) << route;
    expect_closed_balances(history, 1e-9);
  }
}

TEST(Heat, NothingCrossesTheContactAtCoefficientZero) {
  const Table history = RunCase("cases/ouafik-2020/conductive.toml",
                                {"mesh.box.cells=[8,8]", "contact.heat.coefficient=0"})
                            .history();
  EXPECT_EQ(largest(history.numbers("heat_left")), 0);
}

}  // namespace
}  // namespace tourmaline::verified
