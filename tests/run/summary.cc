#include <gtest/gtest.h>

#include "../cases/partly_held.h"
#include "../cases/run_case.h"

namespace tourmaline::verified {
namespace {

TEST(Summary, EveryRouteCountsTheSameUnknowns) {
  const auto sizes = [](const std::vector<std::string> &overrides) {
    return RunCase("cases/verification/patch-test.toml", overrides).summary()["sizes"];
  };
  const nlohmann::json condensed = sizes({});
  EXPECT_GT(condensed["electric_and_thermal_unknowns"], 0);
  EXPECT_LT(condensed["electric_and_thermal_unknowns"], condensed["unknowns"]);
  for (const char *route : {"solver.body=iterative", "solver.method=monolithic"})
    for (const char *size : {"unknowns", "electric_and_thermal_unknowns", "ranks"})
      EXPECT_EQ(sizes({route})[size], condensed[size]) << route << ", " << size;
}

// The monolithic route has the multipliers as well.
TEST(Summary, WhatIsPrescribedAtTheContactIsNoUnknown) {
  const auto unknowns = [](const std::string &body) {
    return RunCase(casefile::read_text(quarter_block, "quarter.toml", {"solver.body=" + body}))
        .summary()["sizes"]["unknowns"]
        .get<int>();
  };
  // 125 nodes; prescribed are u_x and u_y on a side each, potentials on two and temperatures on
  // one.
  EXPECT_EQ(unknowns("direct"), 5 * 125 - 5 * 25);
  EXPECT_EQ(unknowns("iterative"), unknowns("direct"));
}

}  // namespace
}  // namespace tourmaline::verified
