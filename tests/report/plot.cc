#include "tourmaline/report/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../output/temporary_folder.h"
#include "tourmaline/report/ticks.h"

namespace tourmaline::report {
namespace {

using testing::DoubleEq;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::StartsWith;

TEST(Ticks, LinearOnesAreRoundNumbers) {
  EXPECT_THAT(ticks(0, 1), ElementsAre(0, DoubleNear(0.2, 1e-15), DoubleNear(0.4, 1e-15),
                                       DoubleNear(0.6, 1e-15), DoubleNear(0.8, 1e-15), 1));
}

TEST(Ticks, LogarithmicOnesArePowersOfTen) {
  EXPECT_THAT(logarithmic_ticks(0.1, 100), ElementsAre(0.1, 1, 10, 100));
  EXPECT_THAT(logarithmic_ticks(0.09, 150), ElementsAre(0.1, 1, 10, 100));
}

TEST(Ticks, OfManyDecadesSomeAreShown) {
  const std::vector<double> few = logarithmic_ticks(1e-300, 1e300);
  EXPECT_GE(few.size(), 8u);
  EXPECT_LE(few.size(), 12u);
  EXPECT_DOUBLE_EQ(few[1] / few[0], few[3] / few[2]);
}

TEST(Ticks, WithinOneDecadeMultiplesOfThemHelp) {
  EXPECT_THAT(logarithmic_ticks(1.5, 9), ElementsAre(DoubleEq(2), DoubleEq(5)));
}

class PlotFile : public testing::Test {
 protected:
  std::string written(FigureFormat format) {
    write_plot(plot, format, folder / "plot");
    return output::content_of(folder / "plot");
  }

  output::TemporaryFolder folder;
  Plot plot{.abscissa_name = "bound",
            .abscissa_unit = "N/m^2",
            .abscissae = {1, 10, 100},
            .line_names = {"one", "other"},
            .panels = {{"slip", "", {{0, 1, 2}, {3, 4, 5}}}}};
};

TEST_F(PlotFile, EachFormatIsWhatItsNameSays) {
  EXPECT_THAT(written(FigureFormat::svg), StartsWith("<?xml"));
  EXPECT_THAT(written(FigureFormat::png), StartsWith("\x89PNG"));
}

TEST_F(PlotFile, LogarithmicSpacingMovesThePoints) {
  const std::string linear = written(FigureFormat::png);
  plot.logarithmic = true;
  EXPECT_FALSE(written(FigureFormat::png) == linear);
}

TEST_F(PlotFile, AGapIsNotDrawn) {
  const std::string whole = written(FigureFormat::png);
  plot.panels[0].lines[0][1] = std::nan("");
  EXPECT_FALSE(written(FigureFormat::png) == whole);
}

TEST_F(PlotFile, OnePointAndNoPointAtAllAreDrawnToo) {
  for (const double value : {0., 5., -1e-300, 1e300, std::nan("")}) {
    plot.abscissae = {7};
    plot.panels[0].lines = {{value}, {value}};
    EXPECT_THAT(written(FigureFormat::svg), StartsWith("<?xml"));
  }
}

TEST_F(PlotFile, LogarithmsSpanAllNumbers) {
  plot.logarithmic = true;
  plot.abscissae = {1e-300, 1, 1e300};
  EXPECT_THAT(written(FigureFormat::svg), StartsWith("<?xml"));
}

TEST_F(PlotFile, ManyLinesHaveAsManyColours) {
  plot.line_names.clear();
  plot.panels[0].lines.clear();
  for (int i = 0; i < 40; ++i) {
    plot.line_names.push_back("contact.friction.bound = " + std::to_string(i));
    plot.panels[0].lines.push_back({1. * i, 2. * i, 3. * i});
  }
  EXPECT_THAT(written(FigureFormat::svg), StartsWith("<?xml"));
}

}  // namespace
}  // namespace tourmaline::report
