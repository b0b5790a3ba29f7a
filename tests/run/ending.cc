#include "run/ending.h"

#include <gmock/gmock.h>

#include <cmath>

#include "../output/temporary_folder.h"

namespace tourmaline::run {
namespace {

using testing::HasSubstr;
using testing::Not;

output::HistoryRow row(int step, double energy, double heat) {
  output::HistoryRow row;
  row.step = step;
  row.time = 0.5 * step;
  row.stick = 3;
  row.slip = 2;
  row.quantities = {{"load_power", 7}, {"energy_imbalance", energy}, {"heat_imbalance", heat}};
  return row;
}

const std::vector<output::Extreme> extremes{{"displacement", 0, 2e-9, {0, 0, 0}, {0.1, 0, 0}},
                                            {"potential", -1, 3, {0, 0.5, 0}, {1, -0., 0}}};

TEST(Ending, ItNamesExtremesWithTheirPlacesContactAndTheWorstBalance) {
  Highlights highlights;
  highlights.see(row(1, 1e-9, 1e-13));
  highlights.see(row(2, 1e-12, -1e-8));
  EXPECT_EQ(ending_text(2, highlights, extremes, 1),
            "2 steps done, t = 1 s\n"
            "  displacement  at most 2e-09 m, at (0.1, 0)\n"
            "  potential     -1 V at (0, 0.5) to 3 V at (1, 0)\n"
            "  contact       3 of 5 nodes stick, 2 slip, 0 are open\n"
            "  balances      closed up to 1.0e-08 (heat, step 2)\n");
}

TEST(Ending, ACoordinateThatIsRoundOffBesideTheBodysSizeIsZero) {
  const std::vector<output::Extreme> rounded{
      {"potential", -1, 3, {1.2e-18, -3e-17, 0}, {2e-13, 1e-3, 0}}};
  Highlights highlights;
  highlights.see(row(1, 0, 0));
  EXPECT_THAT(ending_text(2, highlights, rounded, 1),
              HasSubstr("-1 V at (0, 0) to 3 V at (0, 0.001)"));
  // In a body of nanometres it is a place.
  EXPECT_THAT(ending_text(2, highlights, rounded, 1e-9),
              HasSubstr("-1 V at (1.2e-18, -3e-17) to 3 V at (2e-13, 0.001)"));
}

TEST(Ending, WhereTheContactMayOpenItTellsPressureAndOpening) {
  Highlights highlights;
  output::HistoryRow last = row(1, 0, 0);
  last.quantities.emplace_back("max_pressure", 2.5e6);
  last.quantities.emplace_back("max_opening", 3e-9);
  highlights.see(last);
  EXPECT_THAT(ending_text(2, highlights, extremes, 1),
              HasSubstr("  pressure      at most 2.5e+06 N/m^2, opening at most 3e-09 m\n"));
}

TEST(Ending, WhatIsClosedToTheLastDigitNamesNoBalanceAndNoStep) {
  Highlights highlights;
  highlights.see(row(1, 0, 0));
  EXPECT_THAT(ending_text(2, highlights, extremes, 1),
              HasSubstr("  balances      closed to the last digit\n"));
}

TEST(Ending, WithoutContactThereIsNoneToTell) {
  Highlights highlights;
  output::HistoryRow free = row(1, 0, 0);
  free.stick = free.slip = 0;
  highlights.see(free);
  EXPECT_THAT(ending_text(3, highlights, {}, 1),
              testing::AllOf(HasSubstr("1 step done"), Not(HasSubstr("contact"))));
}

TEST(Ending, AnImbalanceThatIsNoNumberIsTheWorst) {
  Highlights highlights;
  highlights.see(row(1, 1e-9, std::nan("")));
  EXPECT_THAT(ending_text(2, highlights, {}, 1), HasSubstr("nan (heat, step 1)"));
}

TEST(Ending, ACheckpointKeepsTheWorstBalance) {
  Highlights before, after;
  before.see(row(1, 1e-3, 0));
  output::SavedNumbers numbers;
  before.save(numbers);
  after.restore(numbers);
  after.see(row(2, 1e-9, 0));
  EXPECT_THAT(ending_text(2, after, {}, 1), HasSubstr("1.0e-03 (energy, step 1)"));
}

TEST(Ending, APageIsNamedWhereThereIsOne) {
  const output::TemporaryFolder folder;
  EXPECT_THAT(places_text(folder.path()), Not(HasSubstr("report")));
  std::ofstream(folder / "report.html") << "";
  EXPECT_THAT(places_text(folder.path()), HasSubstr("report.html\n"));
}

}  // namespace
}  // namespace tourmaline::run
