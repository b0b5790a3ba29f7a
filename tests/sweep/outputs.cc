#include "sweep/chosen_outputs.h"
#include "sweep/read_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "../output/temporary_folder.h"
#include "report/table.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"
#include "tourmaline/run/simulation.h"

namespace tourmaline::sweep {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

casefile::Case shipped(const std::string &file, std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"output.fields=false", "output.report=false"});
  return casefile::read_file(std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases" / file,
                             overrides);
}

std::set<std::string> names_of(const std::vector<Output> &outputs) {
  std::set<std::string> names;
  for (const Output &output : outputs)
    names.insert(output.name);
  return names;
}

const std::string laws = "tests/reference/contact_laws/cases/";

struct Shipped {
  std::string file;
  std::vector<std::string> overrides;
};

class OutputsOf : public testing::TestWithParam<Shipped> {};

TEST_P(OutputsOf, ACaseAreTheColumnsOfItsHistoryAndThePlacesOfTheExtremes) {
  const output::TemporaryFolder folder;
  const casefile::Case asked = shipped(GetParam().file, GetParam().overrides);
  run::simulate(asked, folder.path(), {.quiet = true});
  const std::vector<Output> outputs = outputs_of(asked);
  const report::Table history = report::read_table(folder / "history.csv");
  std::set<std::string> columns(history.names.begin(), history.names.end());
  std::set<std::string> names = names_of(outputs);
  EXPECT_EQ(names.size(), outputs.size());
  EXPECT_EQ(std::erase_if(names, [](const auto &name) { return name.starts_with("at_"); }),
            static_cast<std::size_t>(6 * asked.dimension));
  EXPECT_EQ(names, columns);
  for (const double value : read_outputs(folder.path(), outputs))
    EXPECT_TRUE(std::isfinite(value));
}

INSTANTIATE_TEST_SUITE_P(
    Shipped, OutputsOf,
    testing::Values(Shipped{"ouafik-2020/conductive.toml",
                            {"mesh.box.cells=[8,8]", "time.steps=2"}},
                    Shipped{"ouafik-2020/insulated.toml", {"mesh.box.cells=[8,8]", "time.steps=2"}},
                    Shipped{"devices/friction-sensor-loaded.toml", {"time.steps=2"}},
                    Shipped{"block-3d/twisted.toml", {"mesh.box.cells=[3,3,3]", "time.steps=1"}},
                    Shipped{"clamped-block/block.toml", {"time.steps=2"}},
                    Shipped{"ring/ring.toml", {"mesh.annulus.cells=[2,16]", "time.steps=1"}},
                    Shipped{"../" + laws + "coulomb-warmed.toml", {"time.steps=2"}},
                    Shipped{"../" + laws + "hertz.toml", {"time.steps=1"}},
                    Shipped{"../" + laws + "foundation-slides.toml", {"time.steps=1"}},
                    Shipped{"../" + laws + "layer-slip-weakening.toml", {}}));

const std::vector<casefile::Case> &paper() {
  static const std::vector<casefile::Case> both{shipped("ouafik-2020/insulated.toml", {}),
                                                shipped("ouafik-2020/conductive.toml", {})};
  return both;
}

TEST(ChosenOutputs, WithoutNamesTheyAreWhatOneLooksAtFirst) {
  EXPECT_EQ(names_of(chosen_outputs({}, paper())),
            (std::set<std::string>{"slip", "max_displacement", "min_potential", "max_potential",
                                   "min_temperature", "max_temperature"}));
}

TEST(ChosenOutputs, TheyStandInTheOrderOfTheirNamesWithTheirUnits) {
  const auto chosen =
      chosen_outputs({"max_potential", "at_max_potential_y", "elastic_energy"}, paper());
  ASSERT_EQ(chosen.size(), 3u);
  EXPECT_EQ(chosen[0].unit, "V");
  EXPECT_EQ(chosen[1].unit, "m");
  EXPECT_EQ(chosen[2].unit, "J/m");  // of one metre of thickness
}

TEST(ChosenOutputs, OnlyInThreeDimensionsTheyAreOfTheWholeBody) {
  const std::vector<casefile::Case> block{shipped("block-3d/twisted.toml", {})};
  EXPECT_EQ(chosen_outputs({"elastic_energy"}, block)[0].unit, "J");
  EXPECT_EQ(chosen_outputs({"load_x"}, block)[0].unit, "N");
  EXPECT_EQ(chosen_outputs({"load_x"}, paper())[0].unit, "N/m");
  EXPECT_EQ(chosen_outputs({"heat_left"}, paper())[0].unit, "W/m");
}

TEST(ChosenOutputs, OneOfTheCasesHasToHaveThem) {
  // Only the conductive foundation takes heat.
  EXPECT_EQ(chosen_outputs({"heat_left"}, paper()).size(), 1u);
  EXPECT_THAT([] { chosen_outputs({"heat_left"}, {paper().front()}); },
              ThrowsMessage<CaseError>(HasSubstr("--columns heat_left: no column")));
}

TEST(ChosenOutputs, AMisspeltNameIsAnsweredWithTheNearest) {
  EXPECT_THAT([] { chosen_outputs({"max_displacment"}, paper()); },
              ThrowsMessage<CaseError>(HasSubstr("did you mean \"max_displacement\"?")));
  EXPECT_THAT(
      [] {
        chosen_outputs({"slip", "slip"}, paper());
      },
      ThrowsMessage<CaseError>(HasSubstr("asked for twice")));
}

TEST(ChosenOutputs, AColumnIsTakenAsItsNameSays) {
  const auto chosen =
      chosen_outputs({"slip", "max:slip", "rms:elastic_energy", "slip@0.1"}, paper());
  using Kind = Reduction::Kind;
  EXPECT_EQ(chosen[0].reduction.kind, Kind::last);
  EXPECT_EQ(chosen[1].reduction.kind, Kind::max);
  EXPECT_EQ(chosen[1].column, "slip");
  EXPECT_EQ(chosen[2].unit, "J/m");
  EXPECT_EQ(chosen[3].reduction.kind, Kind::at);
  EXPECT_EQ(chosen[3].reduction.time, 0.1);
  EXPECT_EQ(chosen[3].name, "slip@0.1");
}

TEST(ChosenOutputs, APartOfTheTimeStandsBehindAColumn) {
  const auto chosen = chosen_outputs(
      {"mean:elastic_energy@0.1..0.2", "rms:elastic_energy@.05..2e-1", "mean:elastic_energy"},
      paper());
  EXPECT_EQ(chosen[0].reduction.kind, Reduction::Kind::mean);
  EXPECT_EQ(chosen[0].reduction.window, (Reduction::Window{0.1, 0.2}));
  EXPECT_EQ(chosen[0].column, "elastic_energy");
  EXPECT_EQ(chosen[0].unit, "J/m");
  EXPECT_EQ(chosen[1].reduction.window, (Reduction::Window{0.05, 0.2}));
  EXPECT_FALSE(chosen[2].reduction.window);
}

TEST(ChosenOutputs, NamesOfBoundariesMayHaveAllThatStandsAroundAColumn) {
  casefile::Case odd = paper().back();
  for (casefile::BoundaryCase &boundary : odd.boundaries)
    if (boundary.temperature)
      boundary.on = {"max:a@b"};
  const auto chosen =
      chosen_outputs({"heat_max:a@b", "rms:heat_max:a@b", "heat_max:a@b@0.1"}, {odd});
  for (const Output &output : chosen)
    EXPECT_EQ(output.column.empty() ? output.name : output.column, "heat_max:a@b");
  EXPECT_EQ(chosen[2].reduction.time, 0.1);
}

struct WrongOutput {
  const char *name, *reason;
};

class WrongOutputs : public testing::TestWithParam<WrongOutput> {};

TEST_P(WrongOutputs, AreAnsweredWithWhatIsAllowed) {
  EXPECT_THAT([] { chosen_outputs({GetParam().name}, paper()); },
              ThrowsMessage<CaseError>(HasSubstr(GetParam().reason)));
}

INSTANTIATE_TEST_SUITE_P(
    Grammar, WrongOutputs,
    testing::Values(WrongOutput{"slop", "did you mean \"slip\"?; allowed: step, time, "},
                    WrongOutput{"slop", ", and at_min_displacement_x"},
                    WrongOutput{"max:slop", "did you mean \"max:slip\"?"},
                    WrongOutput{"slop@0.1", "did you mean \"slip@0.1\"?"},
                    WrongOutput{"max:", "no column of history.csv"},
                    WrongOutput{"results", "the folder of a study is said by -o or --output"},
                    WrongOutput{":slip", "allowed: last:NAME"},
                    WrongOutput{"average:slip", "allowed: last:NAME, min:NAME"},
                    WrongOutput{"slip@", "write NAME@TIME"}, WrongOutput{"slip@0", "above 0"},
                    WrongOutput{"slip@nan", "above 0"}, WrongOutput{"slip@0.3", "at most 0.2"},
                    WrongOutput{"max:slip@0.1", "write max:slip or slip@0.1"},
                    WrongOutput{
                        "rms:max_potential@0.1",
                        "rms: and @0.1 each make one number of a column, and here are both"},
                    WrongOutput{"max:slop@0.1", "did you mean \"max:slip\"?"},
                    WrongOutput{"max:slop@0.1..0.2", "did you mean \"max:slip@0.1..0.2\"?"},
                    WrongOutput{"max:slip@0.1", "or max:slip@FROM..TO of a part of the time"},
                    WrongOutput{"slip@0.1..0.2", "write mean:slip@0.1..0.2, or rms:"},
                    WrongOutput{"last:slip@0.1..0.2", "is slip@0.2; write that"},
                    WrongOutput{"mean:slip@0.2..0.1", "the second above it"},
                    WrongOutput{"mean:slip@0.1..0.3", "at most 0.2"},
                    WrongOutput{"mean:slip@-1..0.1", "at least 0"},
                    WrongOutput{"mean:slip@0.1..", "must be two numbers of seconds"},
                    WrongOutput{"max:at_max_potential_x", "is a place"},
                    WrongOutput{"at_max_potential_x@0.1", "is a place"}));

TEST(ChosenOutputs, LastIsWhatANameAloneSays) {
  EXPECT_THAT(
      [] {
        chosen_outputs({"slip", "last:slip"}, paper());
      },
      ThrowsMessage<CaseError>(HasSubstr("asked for twice")));
}

// Of a place, `{name = "max.a"}`, in the paper's body.
std::vector<casefile::Case> probed() {
  return {shipped("ouafik-2020/insulated.toml",
                  {"mesh.box.cells=[8,8]", "time.steps=2",
                   "probe=[{name=\"max.a\",at=[0.03,0.1]},"
                   "{name=\"l\",from=[0,0],to=[0.1,0],points=3},{name=\"clamp\",on=\"right\"}]"})};
}

TEST(ChosenOutputs, AProbeHasItsColumnsBehindAPoint) {
  const auto chosen =
      chosen_outputs({"max.a.u_y", "min:max.a.potential", "max.a.temperature@0.1"}, probed());
  EXPECT_EQ(chosen[0].unit, "m");
  EXPECT_EQ(chosen[1].unit, "V");
  EXPECT_EQ(chosen[1].column, "max.a.potential");
  EXPECT_EQ(chosen[2].reduction.time, 0.1);
  EXPECT_THAT([] { chosen_outputs({"max.a.u_z"}, probed()); },
              ThrowsMessage<CaseError>(HasSubstr("did you mean \"max.a.u_")));
  EXPECT_THAT([] { chosen_outputs({"l.u_x"}, probed()); },  // which has many rows in each step
              ThrowsMessage<CaseError>(HasSubstr("no column")));
}

TEST(ChosenOutputs, AProbeOfABoundaryHasAllColumnsOfItsTable) {
  const output::TemporaryFolder folder;
  run::simulate(probed().front(), folder.path(), {.quiet = true});
  for (const std::string name : {"clamp", "max.a"})
    for (const std::string &column : report::read_table(folder / ("probe-" + name + ".csv")).names)
      if (column != "step" && column != "time") {
        EXPECT_NO_THROW(chosen_outputs({name + "." + column}, probed())) << column;
      }
  EXPECT_EQ(chosen_outputs({"clamp.moment_z"}, probed()).front().unit, "N m/m");
}

TEST(ReadOutputs, OfAProbeAreTakenFromItsTable) {
  const output::TemporaryFolder folder;
  run::simulate(probed().front(), folder.path(), {.quiet = true});
  const report::Table table = report::read_table(folder / "probe-max.a.csv");
  const auto values = read_outputs(
      folder.path(), chosen_outputs({"max.a.u_y", "max.a.u_y@0.1", "max.a.x"}, probed()));
  EXPECT_EQ(values[0], table.find("u_y")->back());
  EXPECT_EQ(values[1], table.find("u_y")->front());
  EXPECT_EQ(values[2], 0.03);
}

TEST(ReadOutputs, OfAProbeThatTheRunDoesNotHaveAreNoNumbers) {
  const output::TemporaryFolder folder;
  run::simulate(shipped("ouafik-2020/insulated.toml", {"mesh.box.cells=[8,8]", "time.steps=2"}),
                folder.path(), {.quiet = true});
  EXPECT_TRUE(std::isnan(read_outputs(folder.path(), {{"max.a.u_y", "m"}}).front()));
}

TEST(ReadOutputs, ADamagedSummaryIsToldByItsName) {
  const output::TemporaryFolder folder;
  std::ofstream(folder / "history.csv") << "step,time,slip\n1,0.5,3\n";
  for (const char *text : {"", "{}", "[]", R"({"extremes": [{"field": 3}]})",
                           R"({"extremes": [{"field": "potential", "at_minimum": ["x"]}]})"}) {
    std::ofstream(folder / "summary.json") << text;
    EXPECT_THAT(
        [&] {
          read_outputs(folder.path(), {{"slip", ""}});
        },
        ThrowsMessage<CaseError>(HasSubstr("is no summary")))
        << text;
  }
}

TEST(ReadOutputs, WhatARunLacksIsNoNumber) {
  const output::TemporaryFolder folder;
  std::ofstream(folder / "history.csv") << "step,time,slip\n1,0.5,3\n2,1,5\n";
  std::ofstream(folder / "summary.json")
      << R"({"extremes": [{"field": "potential", "at_minimum": [1, 2], "at_maximum": [3, 4]}]})";
  const auto values =
      read_outputs(folder.path(), {{"slip", ""}, {"heat_left", "W"}, {"at_max_potential_y", "m"}});
  EXPECT_EQ(values[0], 5);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_EQ(values[2], 4);
}

}  // namespace
}  // namespace tourmaline::sweep
