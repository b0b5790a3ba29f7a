#include "run/expected_cost.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <regex>

#include "run/machine_speed.h"
#include "small_case.h"
#include "tourmaline/error.h"

namespace tourmaline::run {
namespace {

std::string cost_with(std::vector<std::string> changes, int cells = 20) {
  changes.push_back(fmt::format("mesh.box.cells=[{},{}]", 2 * cells, cells));
  return expected_cost(small_case(changes));
}

/// By number of ranks: memory, set-up, step, and all; the last one 0 where it is not told.
std::map<int, std::array<double, 4>> rows(const std::string &text) {
  std::map<int, std::array<double, 4>> all;
  const std::regex row(R"(# +(\d+) +(\S+) +(\S+) +(\S+) +([^\n]+))");
  for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at)
    all[std::stoi((*at)[1])] = {std::stod((*at)[2]), std::stod((*at)[3]), std::stod((*at)[4]),
                                std::isdigit((*at)[5].str()[0]) ? std::stod((*at)[5]) : 0};
  return all;
}

TEST(ExpectedCost, IsToldForOneTwoAndFourRanksAndAddsUp) {
  const std::string text = cost_with({});
  EXPECT_THAT(text, testing::HasSubstr("page: 3321 unknowns, "));
  const auto costs = rows(text);
  ASSERT_EQ(costs.size(), 3);
  for (const int ranks : {1, 2, 4}) {
    const auto &[memory, set_up, step, all] = costs.at(ranks);
    EXPECT_GT(memory, 0.1 * ranks);
    EXPECT_GT(step, 0);
    EXPECT_NEAR(all, set_up + 10 * step, 0.1 * all);  // of two digits
  }
}

TEST(ExpectedCost, OfMoreCellsIsMoreMemory) {
  const auto few = rows(cost_with({})), many = rows(cost_with({}, 150));
  EXPECT_GT(many.at(1)[0], 1.5 * few.at(1)[0]);
}

TEST(ExpectedCost, IsToldOfWhatTheCaseAllowsOnly) {
  EXPECT_EQ(rows(cost_with({"solver.factorisation=\"own\""})).size(), 1);
  const auto chosen = rows(cost_with({"time.tolerance=1e-3"}));
  EXPECT_EQ(chosen.at(1)[3], 0);
  EXPECT_GT(chosen.at(1)[2], 0);
  EXPECT_THAT(cost_with({"solver.body=\"iterative\""}), testing::HasSubstr("solved iteratively"));
  EXPECT_EQ(rows(cost_with({"solver.method=\"monolithic\""})).size(), 3);
}

TEST(ExpectedCost, OfAWrongCaseIsAnError) {
  EXPECT_THROW(cost_with({"boundary[0].displacement=['sqrt(0.5-t)',0]"}), CaseError);
}

TEST(MachineSpeed, IsThatOfAMachine) {
  const MachineSpeed speed = measured_speed(1);
  EXPECT_GT(speed.reading, 1e8);
  EXPECT_GT(speed.taking, 1e7);
  EXPECT_GT(speed.operations, 1e8);
}

}  // namespace
}  // namespace tourmaline::run
