// Electrodes between cells, as of stacks and parallel bimorphs.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "closed_balances.h"
#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

double last(const RunCase &run, const std::string &column) {
  return run.history().numbers(column).back();
}

// Layers of one material, poled to and fro, with comb electrodes of 0 and 1 V between them.
std::string stack(int layers, int cells_each, bool is_solid = false,
                  const std::string &signal = "voltage = 1") {
  const double height = 1e-2;
  const std::string up = is_solid ? "z" : "y",
                    at = fmt::format("cos(pi*{}*{}/{})", layers, up, height);
  return fmt::format(
      R"toml(
mesh.box = {0}
model.thermal = false
time = {{ end = 1, steps = 1 }}
boundary = [ {{ on = "bottom", displacement = {1} }}, {{ on = "left", displacement = {2} }}{3} ]
[[region]]
where = "sin(pi*{4}*{5}/{6}) > 0"
material = {{ library = "PZT-5A", poling = {7} }}
{8}
[[electrode]]
name = "ground"
on = {9}
{10}
voltage = 0
[[electrode]]
name = "signal"
{11}
{12}
{13}
)toml",
      is_solid ? fmt::format("{{ min = [0, 0, 0], max = [0.005, 0.005, {}], cells = [1, 1, {}], "
                             "cell = 'hexahedron' }}",
                             height, layers * cells_each)
               : fmt::format("{{ min = [0, 0], max = [0.005, {}], cells = [2, {}], cell = "
                             "'quadrilateral' }}",
                             height, layers * cells_each),
      is_solid ? "['free', 'free', 0]" : "['free', 0]",
      is_solid ? "[0, 'free', 'free']" : "[0, 'free']",
      is_solid ? ", { on = 'front', displacement = ['free', 0, 'free'] }" : "", layers, up, height,
      is_solid ? "[0, 0, 1]" : "[0, 1]",
      layers > 1
          ? fmt::format("[[region]]\nwhere = 'sin(pi*{}*{}/{}) <= 0'\nmaterial = {{ library = "
                        "'PZT-5A', poling = {} }}",
                        layers, up, height, is_solid ? "[0, 0, -1]" : "[0, -1]")
          : "",
      layers % 2 == 1 ? "'bottom'" : "['bottom', 'top']",
      layers > 2 ? fmt::format("where = '{} > 0.999'", at) : "",
      layers % 2 == 1 ? "on = 'top'" : "",
      layers > 1 ? fmt::format("where = '{} < -0.999'", at) : "", signal);
}

// N layers of a stack are N^2 times the capacitor that one layer of the same height is, and
// lengthen N times as much.
TEST(InnerElectrodes, AStackHasTheSquareOfItsLayersTimesTheCapacitance) {
  for (const bool is_solid : {false, true}) {
    const RunCase single = run_text(stack(1, 2, is_solid));
    const double charge = last(single, "electrode_signal_charge"),
                 stroke = largest(single.nodes(), is_solid ? "u_z" : "u_y");
    for (const int layers : {2, 3, 100}) {
      SCOPED_TRACE(layers);
      const RunCase run = run_text(stack(layers, 1, is_solid));
      expect_closed_balances(run.history());
      EXPECT_NEAR(last(run, "electrode_signal_charge") / charge, layers * layers,
                  1e-9 * layers * layers);
      EXPECT_NEAR(last(run, "electrode_ground_charge") / charge, -layers * layers,
                  1e-9 * layers * layers);
      EXPECT_NEAR(largest(run.nodes(), is_solid ? "u_z" : "u_y") / stroke, layers, 1e-9 * layers);
    }
  }
}

TEST(InnerElectrodes, AGivenChargeAndACapacitorFindTheirVoltage) {
  const double capacitance = last(run_text(stack(4, 1)), "electrode_signal_charge");
  const RunCase charged = run_text(stack(4, 1, false, "charge = 1e-6"));
  EXPECT_NEAR(last(charged, "electrode_signal_voltage") * capacitance, 1e-6, 1e-14);
  const RunCase loaded =
      run_text(stack(4, 1, false, fmt::format("voltage = 2\ncapacitor = {:.17g}", capacitance)));
  EXPECT_NEAR(last(loaded, "electrode_signal_voltage"), 1, 1e-9);
}

TEST(InnerElectrodes, AreThoseOfEveryRouteWhereTheirVoltageIsGiven) {
  const RunCase direct = run_text(stack(4, 2));
  for (const char *route : {"solver.method=monolithic", "solver.body=iterative"}) {
    const RunCase other = run_text(stack(4, 2), {route, "solver.linear_tolerance=1e-13"});
    for (const char *column : {"u_x", "u_y", "potential"})
      EXPECT_LT(difference(other.nodes(), direct.nodes(), column), 1e-9) << route << column;
  }
}

TEST(InnerElectrodes, EveryRouteFindsTheVoltageOfAGivenCharge) {
  const RunCase direct = run_text(stack(4, 2, false, "charge = 1e-6"));
  for (const char *route : {"solver.method=monolithic", "solver.body=iterative"}) {
    const RunCase other =
        run_text(stack(4, 2, false, "charge = 1e-6"), {route, "solver.linear_tolerance=1e-13"});
    EXPECT_NEAR(last(other, "electrode_signal_voltage") / last(direct, "electrode_signal_voltage"),
                1, 1e-9);
    for (const char *column : {"u_x", "u_y", "potential"})
      EXPECT_LT(difference(other.nodes(), direct.nodes(), column), 1e-9) << route << column;
  }
}

// A group of Gmsh's on curves inside says the same as a formula.
TEST(InnerElectrodes, AGroupOfAMeshFileMayLieInside) {
  const output::TemporaryFolder folder;
  std::ofstream(folder.path() / "pair.geo") << R"(
Point(1) = {0, 0, 0}; Point(2) = {5e-3, 0, 0}; Point(3) = {5e-3, 5e-3, 0}; Point(4) = {0, 5e-3, 0};
Point(5) = {5e-3, 1e-2, 0}; Point(6) = {0, 1e-2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {3, 5}; Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(2) = {2};
Physical Curve("ground") = {1, 6}; Physical Curve("left") = {4, 7}; Physical Curve("right") = {2, 5};
Physical Curve("middle") = {3}; Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
)";
  const std::string by_name = R"toml(
mesh = { file = "pair.geo", size = 2e-3, unnamed = "natural" }
model.thermal = false
time = { end = 1, steps = 1 }
boundary = [ { on = "left", displacement = [0, 0] } ]
region = [ { on = "lower", material = { library = "PZT-5A", poling = [0, 1] } },
           { on = "upper", material = { library = "PZT-5A", poling = [0, -1] } } ]
electrode = [ { name = "signal", on = "middle", voltage = 100 }, { name = "ground", on = "ground", voltage = 0 } ]
)toml";
  std::string by_formula = by_name;
  by_formula.replace(by_formula.find(R"(on = "middle")"), 13, R"(where = "abs(y - 5e-3) < 1e-8")");
  const RunCase named = run_text(by_name, {}, folder.path()),
                found = run_text(by_formula, {}, folder.path());
  EXPECT_GT(last(named, "electrode_signal_charge"), 0);
  for (const char *column : {"u_x", "u_y", "potential"})
    EXPECT_EQ(named.nodes().columns.at(column), found.nodes().columns.at(column));
  EXPECT_EQ(last(named, "electrode_signal_charge"), last(found, "electrode_signal_charge"));
}

TEST(InnerElectrodes, ThatCoverNothingAreRefused) {
  const auto complaint = [](const std::string &text) {
    try {
      run_text(text);
    } catch (const CaseError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  std::string off = stack(4, 1), none = stack(4, 1);
  off.replace(off.find("< -0.999"), 8, "< -2");
  EXPECT_THAT(complaint(off), ::testing::HasSubstr("electrode \"signal\" covers none"));
  const std::string where = "where = 'cos(pi*4*y/0.01) < -0.999'";
  none.erase(none.find(where), where.size());
  EXPECT_THAT(complaint(none), ::testing::HasSubstr("or `where`, a formula for facets inside"));
}

TEST(InnerElectrodes, ThatShareFacetsAreRefusedAndThoseThatCrossAreNot) {
  const auto complaint = [](const std::string &one, const std::string &other, bool is_solid) {
    try {
      run_text(fmt::format(R"toml(
mesh.box = {}
model.thermal = false
material.library = "PZT-5A"
time = {{ end = 1, steps = 1 }}
[[boundary]]
on = "bottom"
displacement = {}
potential = 0
[[electrode]]
name = "one"
where = "{}"
voltage = 1
[[electrode]]
name = "other"
where = "{}"
voltage = 1
)toml",
                           is_solid
                               ? "{ min = [0, 0, 0], max = [4, 4, 4], cells = [4, 4, 4], cell = "
                                 "\"hexahedron\" }"
                               : "{ min = [0, 0], max = [4, 4], cells = [4, 4] }",
                           is_solid ? "[0, 0, 0]" : "[0, 0]", one, other));
    } catch (const CaseError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const bool is_solid : {false, true}) {
    EXPECT_THAT(complaint("abs(y-2) < 1e-6 && x < 2.1", "abs(y-2) < 1e-6 && x < 3.1", is_solid),
                ::testing::HasSubstr("\"other\" covers facets between cells that the electrode "
                                     "\"one\" covers as well"));
    EXPECT_EQ(complaint("abs(y-2) < 1e-6", "abs(x-2) < 1e-6", is_solid), "");
    EXPECT_EQ(complaint("abs(y-2) < 1e-6 && x < 2.1", "abs(y-2) < 1e-6 && x > 1.9", is_solid), "");
  }
}

}  // namespace
}  // namespace tourmaline::verified
