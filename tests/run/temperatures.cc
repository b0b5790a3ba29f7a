#include "run/temperatures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/survey.h"
#include "tourmaline/case/reader.h"

#include "../cases/run_case.h"

namespace tourmaline::run {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using tourmaline::testing::RunCase;

// A square of 293 K, held and grounded on its right.
casefile::Case square(std::vector<std::string> overrides) {
  overrides.push_back("output.fields=false");
  return casefile::read_text(R"(
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [2, 2] }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 4 }
[[boundary]]
on = "right"
displacement = [0, 0]
potential = 0
temperature = 0
[contact]
on = "left"
heat = { law = "exchange", coefficient = 1, foundation_temperature = 0 }
)",
                             "case.toml", overrides);
}

TEST(Temperatures, OneBelowAbsoluteZeroIsWarnedOf) {
  for (const std::string key :
       {"boundary[0].temperature", "initial.temperature", "contact.heat.foundation_temperature"})
    EXPECT_THAT(temperature_warnings(square({key + "=-300"})),
                ElementsAre(HasSubstr("below absolute zero")));
}

TEST(Temperatures, AnAbsoluteOneIsWarnedOf) {
  for (const std::string key :
       {"boundary[0].temperature", "initial.temperature", "contact.heat.foundation_temperature"}) {
    EXPECT_THAT(temperature_warnings(square({key + "=293"})),
                ElementsAre(HasSubstr("is an absolute one meant?")));
    EXPECT_THAT(temperature_warnings(square({key + "=146"})), IsEmpty());
  }
  EXPECT_THAT(survey(square({"boundary[0].temperature=293"})),
              HasSubstr("# warning: --set boundary[0].temperature=293"));
}

TEST(Temperatures, OnesInTheBodyAreWarnedOfAtTheEnd) {
  const auto warnings = [](const std::string &temperature) {
    const RunCase run(square({"boundary[0].temperature=" + temperature}));
    return run.summary()["warnings"].dump();
  };
  EXPECT_THAT(warnings("\"200*t\""), HasSubstr("the temperature reaches 200 K"));
  EXPECT_THAT(warnings("\"-400*t\""), HasSubstr("below absolute zero"));
  EXPECT_THAT(warnings("\"20*t\""), Not(HasSubstr("temperature")));
}

}  // namespace
}  // namespace tourmaline::run
