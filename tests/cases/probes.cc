// Fields at places that a case asks for.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "run_case.h"
#include "sweep/outputs.h"
#include "tourmaline/error.h"

namespace tourmaline::testing {
namespace {

Table probe(const RunCase &run, const std::string &name) {
  return read_table(run.folder() / ("probe-" + name + ".csv"));
}

// u_x = 1e-6 (x + 2 y) t on all sides, phi = 3 x - y t, theta = 5 y t: fields that every cell has.
std::string linear(int dimension, const std::string &cell, const std::string &probes) {
  const bool solid = dimension == 3;
  return fmt::format(
      R"toml(
mesh.box = {{ min = {}, max = {}, cells = {}, cell = "{}", grading = {{ left = 2, top = 3 }} }}
material = {{ library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0, e31 = 0, e33 = 0, e15 = 0 }}
time = {{ end = 1, steps = 2, regime = "static" }}
{}
[[boundary]]
on = {}
displacement = ["1e-6*(x + 2*y)*t", "-1e-6*x*t"{}]
potential = "3*x - y*t"
temperature = "5*y*t"
)toml",
      solid ? "[0, 0, 0]" : "[0, 0]", solid ? "[0.2, 0.1, 0.1]" : "[0.2, 0.1]",
      solid ? "[4, 3, 2]" : "[4, 3]", cell, probes,
      solid ? R"(["left", "right", "bottom", "top", "front", "back"])"
            : R"(["left", "right", "bottom", "top"])",
      solid ? ", 0" : "");
}

TEST(Probes, FieldsThatCellsHoldAreExactAtAnyPlace) {
  for (const auto &[dimension, cell] : std::vector<std::pair<int, std::string>>{
           {2, "triangle"}, {2, "quadrilateral"}, {3, "tetrahedron"}, {3, "hexahedron"}})
    for (const char *degree : {"mesh.degree=1", "mesh.degree=2"}) {
      SCOPED_TRACE(cell + degree);
      const bool solid = dimension == 3;
      const RunCase run = run_text(
          linear(dimension, cell,
                 fmt::format(
                     "probe = [ {{ name = 'inside', at = {} }}, {{ name = 'corner', at = {} }} ]",
                     solid ? "[0.123, 0.0456, 0.07]" : "[0.123, 0.0456]",
                     solid ? "[0.2, 0.1, 0]" : "[0.2, 0.1]")),
          {degree});
      for (const auto &[name, x, y] : std::vector<std::tuple<std::string, double, double>>{
               {"inside", 0.123, 0.0456}, {"corner", 0.2, 0.1}}) {
        const Table table = probe(run, name);
        ASSERT_EQ(table.numbers("time"), (std::vector{0.5, 1.}));
        EXPECT_EQ(table.numbers("x")[0], x);
        for (std::size_t n = 0; n < 2; ++n) {
          const double t = table.numbers("time")[n];
          EXPECT_NEAR(table.numbers("u_x")[n], 1e-6 * (x + 2 * y) * t, 1e-19);
          EXPECT_NEAR(table.numbers("u_y")[n], -1e-6 * x * t, 1e-19);
          EXPECT_NEAR(table.numbers("potential")[n], 3 * x - y * t, 1e-13);
          EXPECT_NEAR(table.numbers("temperature")[n], 5 * y * t, 1e-13);
        }
      }
    }
}

TEST(Probes, ALineHasItsPointsInEveryStep) {
  const RunCase run = run_text(linear(
      2, "triangle", "probe = [ { name = 'cut', from = [0, 0.1], to = [0.2, 0], points = 5 } ]"));
  const Table table = probe(run, "cut");
  const std::vector<double> s = table.numbers("s"), x = table.numbers("x"),
                            theta = table.numbers("temperature");
  ASSERT_EQ(s.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(s[i], std::hypot(0.2, 0.1) * static_cast<double>(i % 5) / 4, 1e-15);
    EXPECT_NEAR(x[i], 0.05 * static_cast<double>(i % 5), 1e-16);
    EXPECT_NEAR(theta[i], 5 * (0.1 - 0.025 * static_cast<double>(i % 5)) * (i < 5 ? 0.5 : 1),
                1e-14);
  }
}

TEST(Probes, ASweepReadsTheirColumns) {
  const std::string text = linear(2, "triangle", "probe = [ { name = 'tip', at = [0.1, 0.05] } ]");
  const casefile::Case asked = casefile::read_text(text, "case.toml", {});
  const auto outputs =
      sweep::chosen_outputs({"tip.u_y", "max:tip.potential", "tip.temperature@0.5"}, {asked});
  const std::vector<double> values = sweep::read_outputs(run_text(text).folder(), outputs);
  EXPECT_NEAR(values[0], -1e-7, 1e-19);
  EXPECT_NEAR(values[1], 0.275, 1e-14);
  EXPECT_NEAR(values[2], 0.125, 1e-14);
  EXPECT_EQ(outputs[1].unit, "V");
}

TEST(Probes, WhatIsNoProbeIsRefused) {
  const auto complaint = [](const std::string &probes) {
    try {
      run_text(linear(2, "quadrilateral", "probe = [" + probes + "]"));
    } catch (const CaseError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint("{ name = 'a', at = [0.3, 0.05] }"),
              HasSubstr("(0.3, 0.05) m is outside of the body; its nearest node is at (0.2, "));
  EXPECT_THAT(complaint("{ name = 'a', at = [0.1, 0.05] }, { name = 'a', at = [0.1, 0.06] }"),
              HasSubstr("has this name already"));
  EXPECT_THAT(complaint("{ name = '../a', at = [0.1, 0.05] }"), HasSubstr("letters, digits"));
  EXPECT_THAT(complaint("{ name = 'a' }"), HasSubstr("give either `at`"));
  EXPECT_THAT(complaint("{ name = 'a', from = [0, 0] }"), HasSubstr("two ends"));
  EXPECT_THAT(complaint("{ name = 'a', at = [0.1, 0.05, 0] }"), HasSubstr("one for each axis"));
}

}  // namespace
}  // namespace tourmaline::testing
