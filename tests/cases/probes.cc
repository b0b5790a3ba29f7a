// What probes tell is what the other files and closed forms say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// A glass plate between two electrodes whose faces are held at different temperatures: potential
// and temperature are linear across it, in every step the same.
const std::string plate = R"(
material = { symmetry = "isotropic", young = 70e9, poisson = 0.2, eps11 = 5, k11 = 1, density = 2500, specific_heat = 800, reference_temperature = 293 }
time = { end = 1, steps = 3, regime = "static" }
)";

std::string plane_plate(const std::string &cell, int degree) {
  return plate + "mesh = { degree = " + std::to_string(degree) +
         ", box = { min = [0, 0], max = [0.3, 0.1], cells = [5, 3], cell = \"" + cell + "\" } }" +
         R"(
boundary = [ { on = "left", displacement = [0, 0], potential = 0, temperature = 1 },
             { on = "right", potential = "600*t", temperature = 4 } ]
)";
}

std::string solid_plate(const std::string &cell, int degree) {
  return plate + "mesh = { degree = " + std::to_string(degree) +
         ", box = { min = [0, 0, 0], max = [0.3, 0.1, 0.1], cells = [3, 2, 2], cell = \"" + cell +
         "\" } }" + R"(
boundary = [ { on = "left", displacement = [0, 0, 0], potential = 0, temperature = 1 },
             { on = "right", potential = "600*t", temperature = 4 } ]
)";
}

Table probe(const RunCase &run, const std::string &name) {
  return read_table(run.folder() / ("probe-" + name + ".csv"));
}

void expect_linear(const Table &table) {
  const std::vector<double> t = table.numbers("time"), x = table.numbers("x"),
                            potential = table.numbers("potential"),
                            temperature = table.numbers("temperature");
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_NEAR(potential[i], 600 * t[i] * x[i] / 0.3, 1e-9);
    EXPECT_NEAR(temperature[i], 1 + 3 * x[i] / 0.3, 1e-11);
  }
}

TEST(AProbeAtAPlace, TellsLinearFieldsExactlyOnEveryCell) {
  for (const int degree : {1, 2}) {
    for (const char *cell : {"triangle", "quadrilateral"}) {
      const Table table = probe(
          run_text(plane_plate(cell, degree) + "probe = [{ name = 'p', at = [0.1234, 0.0567] }]"),
          "p");
      ASSERT_EQ(table.n_rows(), 3u);
      EXPECT_EQ(table.numbers("step"), (std::vector{1., 2., 3.}));
      expect_linear(table);
    }
    for (const char *cell : {"tetrahedron", "hexahedron"})
      expect_linear(probe(run_text(solid_plate(cell, degree) +
                                   "probe = [{ name = 'p', at = [0.1234, 0.0567, 0.0891] }]"),
                          "p"));
  }
}

TEST(AProbeAlongALine, HasARowForEachOfItsPlacesInEveryStep) {
  const Table table = probe(run_text(plane_plate("triangle", 1) + R"(
probe = [{ name = 'p', from = [0.3, 0], to = [0, 0.1], points = 5 }])"),
                            "p");
  ASSERT_EQ(table.n_rows(), 15u);
  expect_linear(table);
  const std::vector<double> s = table.numbers("s"), y = table.numbers("y");
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_NEAR(s[i], std::hypot(0.3, 0.1) * static_cast<double>(i % 5) / 4, 1e-15);
    EXPECT_NEAR(y[i], 0.1 * static_cast<double>(i % 5) / 4, 1e-16);
  }
}

// Of fields that vary in every direction.
TEST(AProbeAtANode, TellsWhatNodesCsvSays) {
  const RunCase run("cases/ouafik-2020/conductive.toml",
                    {"mesh.box.cells=[8,8]", "time.steps=2", "output.report=false",
                     "probe=[{name='node', at=[0.05, 0.0875]}]"});
  const Table table = probe(run, "node"), nodes = run.nodes();
  const std::vector<double> x = nodes.numbers("x"), y = nodes.numbers("y");
  std::size_t node = 0;
  while (std::abs(x[node] - 0.05) + std::abs(y[node] - 0.0875) > 1e-12)
    ++node;
  for (const char *column : {"u_x", "u_y", "potential", "temperature"})
    EXPECT_NEAR(table.numbers(column).back(), nodes.numbers(column)[node],
                1e-13 * largest(nodes, column));
}

TEST(AProbeOutsideOfTheBody, IsRefusedWithTheNearestPlace) {
  const std::string asked = plane_plate("triangle", 1);
  EXPECT_THAT([&] { run_text(asked + "probe = [{ name = 'p', at = [0.2, 0.11] }]"); },
              ThrowsMessage<CaseError>(HasSubstr(
                  "at = [0.2, 0.11]: this place lies outside of the body; the nearest place in it "
                  "is [0.2, 0.1], 0.01 m away")));
  EXPECT_THAT(
      [&] {
        run_text(asked + "probe = [{ name = 'p', from = [0, 0], to = [0.6, 0], points = 4 }]");
      },
      ThrowsMessage<CaseError>(
          HasSubstr("place 3 of the 4 on this line, [0.4, 0], lies outside of the body")));
}

// The circles of a ring lie outside of its cells, which have straight edges.
TEST(AProbeOnACircle, IsToldWhereTheBodyEnds) {
  const std::string ring = plate + R"(
mesh.annulus = { inner = 0.1, outer = 0.2, cells = [2, 16] }
boundary = [{ on = "inner", displacement = [0, 0], potential = 0, temperature = 0 }]
)";
  const double angle = 0.19635, r = 0.2 * std::cos(angle);  // amid two nodes
  const std::string on_circle =
      std::to_string(0.2 * std::cos(angle)) + ", " + std::to_string(0.2 * std::sin(angle));
  std::string nearest;
  try {
    run_text(ring + "probe = [{ name = 'p', at = [" + on_circle + "] }]");
  } catch (const CaseError &error) {
    nearest = error.what();
  }
  const std::size_t begin = nearest.find("in it is ") + 9;
  ASSERT_LT(begin, nearest.size()) << nearest;
  nearest = nearest.substr(begin, nearest.find(']', begin) + 1 - begin);
  const Table table = probe(run_text(ring + "probe = [{ name = 'p', at = " + nearest + " }]"), "p");
  EXPECT_NEAR(std::hypot(table.numbers("x")[0], table.numbers("y")[0]), r, 1e-6);
}

}  // namespace
}  // namespace tourmaline::verified
