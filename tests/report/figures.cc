#include "report/figures.h"

#include "report/feature_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "../output/temporary_folder.h"
#include "drawn.h"
#include "report/number_text.h"
#include "report/raster.h"
#include "report/scale.h"
#include "report/setting.h"
#include "result_folder.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

std::vector<std::string> names_of_files(const std::vector<std::filesystem::path> &files) {
  std::vector<std::string> names;
  for (const auto &file : files)
    names.push_back(file.filename().string());
  return names;
}

class Figures : public testing::Test {
 protected:
  ResultFolder run{{"time.steps=3"}, "[8, 8]"};
  output::TemporaryFolder out;
};

TEST_F(Figures, TheyAreThoseOfThePaper) {
  EXPECT_EQ(names_of_files(write_figures(run.path(), out / "new/folder", {})),
            (std::vector<std::string>{"setting.svg", "deformed.svg", "potential.svg",
                                      "temperature.svg", "von_mises.svg"}));
}

TEST_F(Figures, EachFormatIsWhatItsNameSays) {
  const auto begin_of = [&](FigureFormat format) {
    return output::content_of(
        write_figures(run.path(), out.path(), {format, {"potential"}, {}}).front());
  };
  EXPECT_THAT(begin_of(FigureFormat::svg), StartsWith("<?xml"));
  EXPECT_THAT(begin_of(FigureFormat::png), StartsWith("\x89PNG"));
  EXPECT_THAT(begin_of(FigureFormat::pdf), StartsWith("%PDF"));
}

TEST_F(Figures, TheSameResultsMakeTheSameFigure) {
  // As SVG too, but there cairo numbers its definitions through the life of the program.
  const FigureRequest request{FigureFormat::png, {"temperature"}, {}};
  const auto file = write_figures(run.path(), out.path(), request).front();
  const std::string first = output::content_of(file);
  write_figures(run.path(), out.path(), request);
  EXPECT_TRUE(first == output::content_of(file));
}

/// What stands at a field's colour bar: numbers, of the largest three digits, and the unit.
std::vector<Written> bar_of(const Result &result, const Field &field, std::size_t component) {
  const ShownRange shown = shown_range(result, field, component);
  const auto [low, high, diverging] = colour_range(shown.low, shown.high);
  const double size = std::max(-low, high), digit = std::pow(10, std::floor(std::log10(size)) - 2);
  std::vector<Written> texts;
  for (int i = 0; i < 5; ++i) {
    const double value = std::round((low + i / 4. * (high - low)) / digit) * digit;
    const char *beyond = i == 0 && shown.cut_below ? "≤ " : i == 4 && shown.cut_above ? "≥ " : "";
    texts.push_back({beyond + number_text(value / std::pow(10, shown_power(size)), 3), 7});
  }
  texts.push_back({unit_text(shown_power(size), field.unit), 7.5});
  return texts;
}

TEST_F(Figures, AFieldAComponentAndAMomentCanBeChosen) {
  struct Moment {
    std::optional<double> asked;
    double recorded;
    std::string text;
  };
  std::set<std::string> bars;
  const auto expect_drawn = [&](const Moment &moment, const Field &field, std::size_t component) {
    const std::string &name = field.components[component];
    const auto files = write_figures(run.path(), out.path(),
                                     {FigureFormat::svg, {field.name + "." + name}, moment.asked});
    EXPECT_EQ(names_of_files(files), std::vector<std::string>{field.name + "_" + name + ".svg"});
    const std::string svg = output::content_of(files.front());
    const std::string title = (field.name == "stress" ? "Stress " : "Displacement ") + name +
                              ", t = " + moment.text + " s";
    EXPECT_TRUE(shows(svg, {{title, 9.5, true}})) << title;
    const Result result = read_result(run.path(), {0, moment.recorded, true});
    const std::vector<Written> bar = bar_of(result, *result.field(field.name), component);
    EXPECT_TRUE(shows(svg, bar)) << title << ": " << bar[0].text << " to " << bar[4].text;
    bars.insert(bar[0].text + " to " + bar[4].text);
  };
  const Result any = read_result(run.path(), {0, std::nullopt, true});
  for (const Moment &moment :
       {Moment{0.07, 0.2 / 3, "0.06667"}, Moment{0.14, 0.4 / 3, "0.1333"}, Moment{{}, 0.2, "0.2"}})
    for (const char *name : {"displacement", "stress"})
      for (std::size_t c = 0; c < any.field(name)->components.size(); ++c)
        expect_drawn(moment, *any.field(name), c);
  EXPECT_EQ(bars.size(), 3U * (2 + 4));
}

TEST_F(Figures, AMomentOutsideOfTheRunIsRefused) {
  for (const char *name : {"potential", "contact.gap"})
    for (const double time : {-0.1, 0.21, 5., std::nan("")})
      EXPECT_THAT(
          [&] {
            write_figures(run.path(), out.path(), {FigureFormat::svg, {name}, time});
          },
          ThrowsMessage<CaseError>(
              HasSubstr("is not in the results, which go from t = 0 to 0.2 s")))
          << name << " " << time;
  EXPECT_FALSE(
      write_figures(run.path(), out.path(), {FigureFormat::svg, {"potential"}, 0.2 * (1 + 1e-15)})
          .empty());
}

TEST_F(Figures, AFieldWithComponentsIsAnsweredWithThese) {
  EXPECT_THAT(
      [&] {
        write_figures(run.path(), out.path(), {FigureFormat::svg, {"displacement"}, {}});
      },
      ThrowsMessage<CaseError>(HasSubstr("the field \"displacement\" has components, and a figure "
                                         "shows one number at each place; give one of "
                                         "displacement.")));
}

TEST_F(Figures, AnUnknownFieldIsAnsweredWithTheKnownOnes) {
  EXPECT_THAT(
      [&] {
        write_figures(run.path(), out.path(), {FigureFormat::svg, {"stres"}, {}});
      },
      ThrowsMessage<CaseError>(HasSubstr("stress.xx, stress.yy")));
  EXPECT_THROW(figure_format("gif"), CaseError);
}

/// That marks stand by these numbers, in one direction of the paper.
void expect_by(const std::vector<Place> &marks, int direction, const std::vector<double> &numbers) {
  ASSERT_EQ(marks.size(), numbers.size());
  const auto [least, greatest] = std::minmax_element(numbers.begin(), numbers.end());
  const double from = marks[least - numbers.begin()][direction],
               to = marks[greatest - numbers.begin()][direction];
  // 1e-3 pt: the file has six digits.
  for (std::size_t i = 0; i < marks.size(); ++i)
    EXPECT_NEAR(
        marks[i][direction] - from,
        *least == *greatest ? 0 : (to - from) * (numbers[i] - *least) / (*greatest - *least), 1e-3);
  if (*least < *greatest) {
    EXPECT_GT(direction == 0 ? to - from : from - to, 50);
  }
}

TEST_F(Figures, CurvesAlongTheContactAreDrawnByTheirColumns) {
  struct Curve {
    const char *name, *title;
    std::vector<double> values;  ///< of all rows of contact.csv
  };
  const Result result = read_result(run.path(), {});
  const auto column = [&](const char *name) { return *result.contact->find(name); };
  std::vector<double> pressure = column("normal_traction");
  for (double &value : pressure)
    value = -value;
  const ContactPiece &piece = result.contact_pieces.at(0);
  for (const Curve &curve : {Curve{"pressure", "Contact pressure", pressure},
                             {"normal_traction", "Normal traction", column("normal_traction")},
                             {"gap", "Opening of the contact", column("gap")},
                             {"friction_bound", "Friction bound", result.friction_bound},
                             {"slip_y", "Slip y", column("slip_y")},
                             {"temperature", "Temperature", column("temperature")}})
    for (const bool first_step : {false, true}) {
      SCOPED_TRACE(curve.name);
      const auto files = write_figures(run.path(), out.path(),
                                       {FigureFormat::svg,
                                        {std::string("contact.") + curve.name},
                                        first_step ? std::optional(0.07) : std::nullopt});
      EXPECT_EQ(names_of_files(files),
                std::vector<std::string>{std::string("contact_") + curve.name + ".svg"});
      const std::string svg = output::content_of(files.front());
      const std::string title =
          curve.title + std::string(first_step ? ", t = 0.06667 s [" : ", t = 0.2 s [");
      EXPECT_TRUE(shows(svg, {{title, 8.5, true}})) << title;
      const std::size_t begin = first_step ? 0 : curve.values.size() / 3 * 2;
      std::vector<double> values;
      for (const std::uint32_t row : piece.rows)
        values.push_back(curve.values.at(begin + row));
      const std::vector<Place> points = marks(svg, drawn_lines(svg).at(0).colour);
      expect_by(points, 0, piece.along);
      expect_by(points, 1, values);
    }
}

TEST_F(Figures, TheStatusOfTheContactIsDrawnWithALineAcrossForEachWord) {
  const auto files =
      write_figures(run.path(), out.path(), {FigureFormat::svg, {"contact.status"}, {}});
  EXPECT_EQ(names_of_files(files), std::vector<std::string>{"contact_status.svg"});
  const auto across = drawn_lines(output::content_of(files.front()), "0.5");
  ASSERT_EQ(across.size(), 1U);
  EXPECT_EQ(across[0].pieces.size(), 3U);
}

TEST_F(Figures, CurvesStandBesideFieldsInOneRequest) {
  EXPECT_EQ(names_of_files(write_figures(run.path(), out.path(),
                                         {FigureFormat::svg, {"contact.gap", "potential"}, {}})),
            (std::vector<std::string>{"potential.svg", "contact_gap.svg"}));
}

TEST_F(Figures, AnUnknownCurveIsAnsweredWithTheKnownOnes) {
  for (const char *name : {"contact.gp", "contact.contact", "contact.x", "contact."})
    EXPECT_THAT(
        [&] {
          write_figures(run.path(), out.path(), {FigureFormat::svg, {name}, {}});
        },
        ThrowsMessage<CaseError>(HasSubstr("contact.pressure, contact.normal_traction")))
        << name;
  EXPECT_THAT(
      [&] {
        write_figures(run.path(), out.path(), {FigureFormat::svg, {"gap"}, {}});
      },
      ThrowsMessage<CaseError>(HasSubstr("along the contact contact.pressure")));
}

TEST(ContactCurves, NeedNoFieldFilesAndArePiecesApart) {
  const ResultFolder run({"time.steps=1", "output.fields=false", "output.report=false",
                          "contact.on=[\"left\", \"right\"]",
                          "boundary=[{on=\"top\", "
                          "displacement=[0, 0], potential=0, temperature=0}]"});
  const output::TemporaryFolder out;
  EXPECT_EQ(names_of_files(write_figures(run.path(), out.path(),
                                         {FigureFormat::svg, {"contact.pressure"}, {}})),
            (std::vector<std::string>{"contact_pressure_1.svg", "contact_pressure_2.svg"}));
  EXPECT_THROW(
      write_figures(run.path(), out.path(), {FigureFormat::svg, {"contact.gap", "potential"}, {}}),
      CaseError);
}

TEST(ContactCurves, OfASolidBodyAreRefusedWithWhatThereIsInstead) {
  const auto file = std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/block-3d/twisted.toml";
  const output::TemporaryFolder run;
  run::simulate(casefile::read_file(
                    file, {"mesh.box.cells=[2, 2, 2]", "time.steps=1", "output.report=false"}),
                run.path(), {.quiet = true});
  EXPECT_THAT(
      [&] {
        write_figures(run.path(), run / "figures", {FigureFormat::svg, {"contact.gap"}, {}});
      },
      ThrowsMessage<CaseError>(HasSubstr("contact.pvd")));
}

TEST_F(Figures, TheSettingShowsThePoling) {
  for (const auto &[x, y] : {Place{0, 1}, Place{0, -1}, Place{-0.6, 0.8}}) {
    const ResultFolder turned(
        {"time.steps=1", "material.poling=[" + std::to_string(x) + ", " + std::to_string(y) + "]"},
        "[8, 8]");
    const std::string svg =
        output::content_of(write_figures(turned.path(), out.path(), {}).front());
    std::vector<std::vector<Place>> heads;  // of arrows
    for (const DrawnArea &area : drawn_areas(svg))
      if (area.corners.size() == 3)
        heads.push_back(area.corners);
    ASSERT_GT(heads.size(), 20U);
    heads.pop_back();  // the legend's
    for (const auto &head : heads) {
      const double along = head[0][0] - (head[1][0] + head[2][0]) / 2,
                   down = head[0][1] - (head[1][1] + head[2][1]) / 2;
      // 1e-3: the file has six digits.
      EXPECT_NEAR(along / std::hypot(along, down), x, 1e-3);
      EXPECT_NEAR(-down / std::hypot(along, down), y, 1e-3);
    }
  }
}

TEST(FiguresOfARunWithoutFields, AreRefusedWithTheReason) {
  const ResultFolder run({"time.steps=1", "output.fields=false"});
  EXPECT_THAT([&] { write_figures(run.path(), run.path() / "figures", {}); },
              ThrowsMessage<CaseError>(HasSubstr("output.fields = true")));
}

TEST(NumberText, PowersOfTenAreRaised) {
  EXPECT_EQ(number_text(-3.96e-11, 3), "−3.96·10⁻¹¹");
  EXPECT_EQ(number_text(0.03120, 4), "0.0312");
  EXPECT_EQ(number_text(6e7, 1), "6·10⁷");
  EXPECT_EQ(number_text(0, 3), "0");
  EXPECT_EQ(number_text(0.0999999, 3), "0.1");
}

TEST(NumberText, UnitsTakeThePowerOfTheirValues) {
  EXPECT_EQ(unit_text(shown_power(1.24e-3), "K"), "10⁻³ K");
  EXPECT_EQ(unit_text(shown_power(942), "Pa"), "Pa");
  EXPECT_EQ(unit_text(shown_power(2e9), ""), "10⁹");
}

/// A square of side 2 that does not move.
Result square() {
  Result result;
  result.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}};
  result.skin.nodes = {0, 1, 2, 3};
  result.skin.cells = {0, 1};
  result.skin.triangles = {{0, 1, 2}, {1, 3, 2}};
  result.skin.triangle_cells = {0, 1};
  result.times = {1};
  result.fields = {{"displacement", "m", true, {"x", "y"}, {{0, 0, 0, 0}, {0, 0, 0, 0}}}};
  return result;
}

/// A square of side 2 with a layer of a thousandth at its foot, whose top moves up by `top` while
/// that of the layer moves by `layer`.
Result layered(float top, float layer) {
  Result result;
  for (const double y : {0., 0.002, 2.})
    for (const double x : {0., 2.})
      result.points.push_back({x, y, 0});
  result.skin.nodes = {0, 1, 2, 3, 4, 5};
  result.skin.cells = {0, 1};
  result.skin.triangles = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}};
  result.skin.triangle_cells = {0, 0, 1, 1};
  result.times = {1};
  result.fields = {{"displacement",
                    "m",
                    true,
                    {"x", "y"},
                    {{0, 0, 0, 0, 0, 0}, {0, 0, layer, layer, top, top}}}};
  return result;
}

TEST(Scale, TheGreatestDisplacementIsShownAsAtMostATenthOfTheBody) {
  // 0.2 / 4e-11 = 5e9
  EXPECT_DOUBLE_EQ(suitable_scale(layered(4e-11F, 4e-14F)), 5e9);
  EXPECT_DOUBLE_EQ(suitable_scale(layered(0, 0)), 1);
}

TEST(Scale, NoCellIsFoldedHoweverFewAreStrained) {
  // The layer is 0.002 - s 3e-11 high, of which a tenth is left at s = 6e7.
  EXPECT_DOUBLE_EQ(suitable_scale(layered(4e-11F, -3e-11F)), 6e7);
  // What is stretched does not fold.
  EXPECT_DOUBLE_EQ(suitable_scale(layered(4e-11F, 3e-11F)), 5e9);
}

/// A cube, its skin in triangles, with this strain in its one cell.
Result cube(std::array<float, 6> strain) {
  Result result;
  result.dimension = 3;
  for (const double z : {0., 1.})
    for (const double y : {0., 1.})
      for (const double x : {0., 1.})
        result.points.push_back({x, y, z});
  result.skin.nodes = {0, 1, 2, 3, 4, 5, 6, 7};
  result.skin.cells = {0};
  for (const auto &[a, b, c, d] : std::vector<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    result.skin.triangles.push_back({a, b, c});
    result.skin.triangles.push_back({a, c, d});
  }
  result.skin.triangle_cells.assign(12, 0);
  result.times = {1};
  const std::vector<float> still(8, 0);
  std::vector<float> moved(8, 0);
  moved[7] = 1e-12F;
  result.fields = {{"displacement", "m", true, {"x", "y", "z"}, {moved, still, still}},
                   {"strain", "", false, {"xx", "yy", "zz", "xy", "yz", "xz"}, {}}};
  for (const float component : strain)
    result.fields[1].values.push_back({component});
  return result;
}

TEST(Scale, NoCellOfASolidBodyIsPressedToNothing) {
  EXPECT_DOUBLE_EQ(suitable_scale(cube({0, 0, -3e-9F, 0, 0, 0})), 3e8);
  // Sheared by 3e-9 it is pressed by as much across.
  EXPECT_DOUBLE_EQ(suitable_scale(cube({0, 0, 0, 0, 3e-9F, 0})), 3e8);
  EXPECT_DOUBLE_EQ(suitable_scale(cube({3e-9F, 0, 0, 0, 0, 0})), 1e11);
}

TEST(FeatureEdges, OfACubeAreItsTwelve) {
  EXPECT_EQ(feature_edges(cube({})).size(), 12U);
}

TEST(Setting, BoundariesWithTheSameConditionsShareAColourAndContactComesFirst) {
  Result result;
  result.boundaries = {{"a", {"free", {}}, {}},
                       {"b", {"displacement", {"u = 0"}}, {}},
                       {"c", {"contact", {"bilateral contact"}}, {}},
                       {"d", {"free", {}}, {}},
                       {"e", {"displacement", {"u = 1"}}, {}}};
  const std::vector<SettingGroup> groups = groups_of(result);
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups[0].boundaries[0]->name, "c");
  EXPECT_EQ(groups[3].boundaries.size(), 2U);
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(groups[i].colour, groups[j].colour);
}

TEST(Setting, FacetsWithoutANameAreToldOfUnlessAllHaveOne) {
  Result result = square();
  result.skin.n_facets = 4;
  EXPECT_FALSE(has_unnamed_facets(result));  // nothing is known of the boundary
  result.boundaries = {{"a", {"free", {}}, {{0, 1}, {1, 3}}},
                       {"b", {"free", {}}, {{3, 1}, {2, 3}}}};
  EXPECT_TRUE(has_unnamed_facets(result));
  result.boundaries[1].facets.push_back({0, 2});
  EXPECT_FALSE(has_unnamed_facets(result));
  EXPECT_EQ(name_of_unnamed(result), "other sides");
}

TEST(Raster, WithSomeSlackTheLastOfWhatIsAtOnePlaceIsSeen) {
  for (const double slack : {0., 1e-6}) {
    Raster raster(view_of(square(), 0), 10);
    for (const Colour &colour : {Colour{1, 0, 0}, Colour{2, 0, 0}})
      raster.triangle(
          {0, 0, 1}, {2, 0, 1}, {0, 2, 1}, [&](double, double, double) { return colour; }, slack);
    EXPECT_EQ(raster.pixels()[15 * 20 + 2], slack > 0 ? 0xff020000U : 0xff010000U);
  }
}

TEST(Raster, WhatIsNearerHidesWhatIsBehindInEitherOrder) {
  const View view = view_of(square(), 0);
  const Colour near{255, 0, 0}, far{0, 0, 255};
  for (const bool near_first : {true, false}) {
    Raster raster(view, 10);
    for (const bool draw_near : {near_first, !near_first})
      raster.triangle({0, 0, draw_near ? 1. : 2.}, {2, 0, draw_near ? 1. : 2.},
                      {0, 2, draw_near ? 1. : 2.},
                      [&](double, double, double) { return draw_near ? near : far; });
    EXPECT_EQ(raster.pixels()[15 * 20 + 2], 0xffff0000U);
    EXPECT_EQ(raster.pixels()[2 * 20 + 17], 0U);  // above the hypotenuse
  }
}

TEST(Raster, ThePaintGetsTheWeightsOfTheCorners) {
  Raster raster(view_of(square(), 0), 10);
  double worst = 0;
  int pixels = 0;
  // The weight of the corner at x = 2 is x / 2.
  raster.triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, [&](double a, double b, double c) {
    worst = std::max(worst, std::abs(a + b + c - 1));
    ++pixels;
    return Colour{static_cast<std::uint8_t>(std::lround(200 * b)), 0, 0};
  });
  EXPECT_LT(worst, 1e-14);
  EXPECT_NEAR(pixels, 200, 12);  // half of 20 x 20, and the diagonal's pixels
  EXPECT_EQ(raster.pixels()[19 * 20 + 10] >> 16 & 0xff, 105U);  // x = 1.05
}

}  // namespace
}  // namespace tourmaline::report
