#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tourmaline::verified
