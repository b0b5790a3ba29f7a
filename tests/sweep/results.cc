#include "sweep/results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace tourmaline::sweep {
namespace {

using testing::ElementsAre;

/// Row i of the product has the value i.
Results results_of(const std::vector<std::string> &assignments) {
  Results results;
  results.variations = read_variations(assignments);
  results.members = members_of(results.variations);
  results.outputs = {{"max_potential", "V"}};
  for (std::size_t i = 0; i < results.members.size(); ++i)
    results.rows.push_back({"done", {static_cast<double>(i)}});
  return results;
}

TEST(SweepTable, ARowHoldsFolderValuesStatusAndOutputs) {
  Results results = results_of({"contact.friction.bound=5,15"});
  results.rows[0].values[0] = 0.1;
  results.rows[1] = {"failed", {std::nan("")}};
  EXPECT_EQ(table_text(results),
            "member,contact.friction.bound,status,max_potential\n"
            "bound=5,5,done,0.10000000000000001\n"
            "bound=15,15,failed,nan\n");
}

TEST(SweepTable, AValueWithCommasOrQuotesIsOneCell) {
  EXPECT_EQ(table_text(results_of({"mesh.box.cells=[4,4]", "title=\"a\""})),
            "member,mesh.box.cells,title,status,max_potential\n"
            "cells=4_4_title=a,\"[4,4]\",\"\"\"a\"\"\",done,0\n");
}

TEST(SweepPlot, TheFirstKeyIsTheAbscissaAndTheOthersMakeLines) {
  Results results =
      results_of({"contact.heat.coefficient=log:1:100:3", "contact.friction.bound=5,15"});
  results.key_unit = "W/(K m^2)";
  const report::Plot plot = plot_of(results);
  EXPECT_EQ(plot.abscissa_name, "contact.heat.coefficient");
  EXPECT_EQ(plot.abscissa_unit, "W/(K m^2)");
  EXPECT_TRUE(plot.logarithmic);
  EXPECT_THAT(plot.abscissae, ElementsAre(1, 10, 100));
  EXPECT_THAT(plot.line_names,
              ElementsAre("contact.friction.bound = 5", "contact.friction.bound = 15"));
  ASSERT_EQ(plot.panels.size(), 1u);
  EXPECT_EQ(plot.panels[0].unit, "V");
  EXPECT_THAT(plot.panels[0].lines, ElementsAre(ElementsAre(0, 2, 4), ElementsAre(1, 3, 5)));
}

TEST(SweepPlot, PointsStandFromLeftToRight) {
  const report::Plot plot = plot_of(results_of({"time.end=3,1,2"}));
  EXPECT_THAT(plot.abscissae, ElementsAre(1, 2, 3));
  EXPECT_THAT(plot.panels[0].lines, ElementsAre(ElementsAre(1, 2, 0)));
}

TEST(SweepPlot, WordsStandInTheirOrder) {
  const report::Plot plot = plot_of(results_of({"solver.method=monolithic,condensed"}));
  EXPECT_THAT(plot.words, ElementsAre("monolithic", "condensed"));
  EXPECT_THAT(plot.abscissae, ElementsAre(0, 1));
}

}  // namespace
}  // namespace tourmaline::sweep
