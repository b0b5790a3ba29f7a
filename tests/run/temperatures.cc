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
using tourmaline::verified::RunCase;

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

TEST(Temperatures, OnesInTheBodyAreWarnedOf) {
  const auto warnings = [](const std::string &temperature) {
    const RunCase run(square({"boundary[0].temperature=" + temperature}));
    return run.summary()["warnings"].dump();
  };
  EXPECT_THAT(warnings("\"200*t\""), HasSubstr("the temperature reaches 200 K (step 4, t = 1 s)"));
  EXPECT_THAT(warnings("\"-400*t\""), HasSubstr("below absolute zero"));
  EXPECT_THAT(warnings("\"20*t\""), Not(HasSubstr("temperature")));
  // Gone again at the end.
  EXPECT_THAT(warnings("\"800*t*(1-t)\""),
              HasSubstr("the temperature reaches 200 K (step 2, t = 0.5 s)"));
  EXPECT_THAT(warnings("\"-1600*t*(1-t)\""),
              HasSubstr("the temperature reaches -400 K, which is below absolute zero (step 2"));
}

TEST(Temperatures, OneOfTheBeginningIsWarnedOf) {
  const RunCase run(square({"initial.temperature=\"1e4*(0.01-x)*2\""}));
  EXPECT_THAT(run.summary()["warnings"].dump(), HasSubstr("reaches 200 K (step 0, t = 0 s)"));
}

output::HistoryRow row(int step, double lowest, double highest) {
  output::HistoryRow row;
  row.step = step;
  row.time = 0.1 * step;
  row.quantities = {{"min_temperature", lowest}, {"max_temperature", highest}};
  return row;
}

TEST(Temperatures, ThePeakGoesOnBehindACheckpoint) {
  TemperaturePeak before;
  before.step(row(1, -250, 200));
  before.step(row(2, 0, 220));
  output::SavedNumbers numbers;
  before.save(numbers);
  TemperaturePeak behind;
  behind.restore(numbers);
  behind.step(row(3, -249, 249));
  EXPECT_EQ(behind.warning(293), before.warning(293));
  EXPECT_THAT(behind.warning(293), HasSubstr("reaches -250 K (step 1, t = 0.1 s)"));
  behind.step(row(4, 0, 251));
  EXPECT_THAT(behind.warning(293), HasSubstr("reaches 251 K (step 4, t = 0.4 s)"));
  EXPECT_EQ(behind.warning(503), "");
}

}  // namespace
}  // namespace tourmaline::run
