#include "report/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "../output/temporary_folder.h"
#include "drawn.h"
#include "report/ticks.h"

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

// Ratio of the two distances between the three points of the first line.
double spacing(const std::string &svg) {
  const auto points = drawn_lines(svg).at(0).pieces.at(0);
  return (points.at(2)[0] - points.at(1)[0]) / (points.at(1)[0] - points.at(0)[0]);
}

TEST_F(PlotFile, OnALogarithmicAbscissaEqualRatiosAreEqualDistances) {
  plot.panels[0].lines[0] = {0, 2, 1};  // of three points on one straight line cairo draws two
  // 1e-3: the file has six digits.
  EXPECT_NEAR(spacing(written(FigureFormat::svg)), 10, 1e-3);
  plot.logarithmic = true;
  EXPECT_NEAR(spacing(written(FigureFormat::svg)), 1, 1e-3);
}

TEST_F(PlotFile, AGapIsNotDrawnAndLeavesTheOtherLineAsItWas) {
  const std::vector<DrawnLine> whole = drawn_lines(written(FigureFormat::svg));
  plot.panels[0].lines[0][1] = std::nan("");
  const std::string svg = written(FigureFormat::svg);
  const std::vector<DrawnLine> lines = drawn_lines(svg);
  std::size_t strokes = 0;  // of the first colour, the legend's among them
  for (const DrawnLine &line : lines)
    if (line.colour == whole.at(0).colour)
      for (const auto &piece : line.pieces)
        strokes += piece.size() > 1;
  EXPECT_EQ(strokes, 1);
  EXPECT_EQ(marks(svg, whole.at(0).colour).size(), 2 + 1);
  EXPECT_EQ(marks(svg, whole.at(1).colour).size(), 3 + 1);
}

TEST_F(PlotFile, OnePointIsAMarkAndNoPointNone) {
  const std::string colour = drawn_lines(written(FigureFormat::svg)).at(0).colour;
  for (const double value : {0., 5., -1e-300, 1e300, std::nan("")}) {
    plot.abscissae = {7};
    plot.panels[0].lines = {{value}, {value}};
    EXPECT_EQ(marks(written(FigureFormat::svg), colour).size(), (std::isnan(value) ? 0 : 1) + 1)
        << value;
  }
}

TEST_F(PlotFile, LogarithmsSpanAllNumbers) {
  plot.logarithmic = true;
  plot.abscissae = {1e-300, 1, 1e300};
  plot.panels[0].lines[0] = {0, 2, 1};
  const std::string svg = written(FigureFormat::svg);
  EXPECT_NEAR(spacing(svg), 1, 1e-3);
  // Of the frame's 210 points 6 % of what is shown are left free at either end.
  const auto points = drawn_lines(svg).at(0).pieces.at(0);
  EXPECT_NEAR(points.at(2)[0] - points.at(0)[0], 210 / 1.12, 1e-3);
}

TEST_F(PlotFile, ManyLinesHaveAsManyColours) {
  plot.line_names.clear();
  plot.panels[0].lines.clear();
  for (int i = 0; i < 40; ++i) {
    plot.line_names.push_back("contact.friction.bound = " + std::to_string(i));
    plot.panels[0].lines.push_back({1. * i, 2. * i, 3. * i});
  }
  std::set<std::string> colours;
  for (const DrawnLine &line : drawn_lines(written(FigureFormat::svg)))
    colours.insert(line.colour);
  EXPECT_EQ(colours.size(), 40);
}

}  // namespace
}  // namespace tourmaline::report
