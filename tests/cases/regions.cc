// Label: analytic. Bodies of several materials against closed forms; what the regions of a case
// must be.
#include <gmock/gmock.h>

#include "material/composition.h"
#include "run/survey.h"
#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

using output::content_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

casefile::Case read(const std::string &text, std::vector<std::string> overrides = {}) {
  overrides.push_back("output.fields=false");
  return casefile::read_text(text, "case.toml", overrides, mesh::read_mesh_file);
}

std::string complaint(const std::string &text, const std::vector<std::string> &overrides = {}) {
  try {
    run::survey(read(text, overrides));
  } catch (const CaseError &error) {
    return error.what();
  }
  return "";
}

const std::string square = R"(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [8, 8] }
time = { end = 1, steps = 2 }
boundary = [
  { on = "right", displacement = [0, 0], potential = 0 },
  { on = "top", traction = [0, "-50*t"] },
]
[contact]
on = "left"
friction = { law = "tresca", bound = 15 }
)";

TEST(Regions, OneRegionOfTheWholeBodyGivesTheSameBytes) {
  const RunCase whole(read(square + "[material]\nlibrary = \"BaTiO3-Liu2014\"\n"));
  const RunCase region(read(square + R"([[region]]
where = "1"
material.library = "BaTiO3-Liu2014"
)"));
  const RunCase halves(read(square + R"([[region]]
where = "x < 0.05"
material.library = "BaTiO3-Liu2014"
[[region]]
where = "x >= 0.05"
material.library = "BaTiO3-Liu2014"
)"));
  for (const char *file : {"nodes.csv", "contact.csv", "history.csv"}) {
    EXPECT_EQ(content_of(whole.folder() / file), content_of(region.folder() / file)) << file;
    EXPECT_EQ(content_of(whole.folder() / file), content_of(halves.folder() / file)) << file;
  }
}

TEST(Regions, EveryCellMustBeInExactlyOne) {
  const std::string left = "[[region]]\nwhere = \"x < 0.05\"\nmaterial.library = \"steel\"\n";
  EXPECT_THAT(complaint(square + left), HasSubstr("is in no region"));
  EXPECT_THAT(complaint(square + left + left), HasSubstr("is in the regions 0 and 1"));
  EXPECT_THAT(complaint(square + left + "[material]\nlibrary = \"steel\"\n"),
              HasSubstr("stands beside [[region]]"));
  EXPECT_THAT(complaint(square + "[[region]]\nmaterial.library = \"steel\"\n"),
              HasSubstr("give either `on`"));
  EXPECT_THAT(complaint(square), HasSubstr("material"));
}

TEST(Regions, OneThatHoldsNoCellIsRefusedWithWhereTheCellsAre) {
  const std::string whole = "[[region]]\nwhere = \"1\"\nmaterial.library = \"steel\"\n";
  EXPECT_THAT(
      complaint(square + whole + "[[region]]\nwhere = \"y > 2\"\nmaterial.library = \"steel\"\n"),
      AllOf(HasSubstr("[region[1]]"), HasSubstr("holds no cell: where = \"y > 2\""),
            HasSubstr("y from 0.00416667 to 0.0958333 m")));
  EXPECT_THAT(complaint(square + "[[region]]\nwhere = \"x < 0.05\"\nmaterial.library = "
                                 "\"steel\"\n"),
              HasSubstr("case.toml [[region]]: the cell"));
}

TEST(Regions, ReferenceTemperaturesMustAgree) {
  EXPECT_THAT(complaint(square + R"([[region]]
where = "x < 0.05"
material.library = "steel"
[[region]]
where = "x >= 0.05"
material = { library = "BaTiO3-Liu2014", reference_temperature = 300 }
)"),
              HasSubstr("reference temperatures 293 K and 300 K"));
}

TEST(Regions, TheSurveyTellsSizesAndPoling) {
  const std::string text = run::survey(read(square + R"([[region]]
where = "x < 0.025"
material.library = "steel"
[[region]]
where = "x >= 0.025"
material = { library = "BaTiO3-Liu2014", poling = [-3, 4] }
)"));
  EXPECT_THAT(text, HasSubstr("steel, area 0.0025 m^2, centre (0.0125, 0.05), not poled"));
  EXPECT_THAT(text, HasSubstr("area 0.0075 m^2, centre (0.0625, 0.05), poled along (-0.6, 0.8)"));
}

TEST(Regions, TheSurveyTellsOfASideOnTheAxisOfABodyOfRevolution) {
  const std::string text = run::survey(read(square + R"([[region]]
where = "1"
material.library = "BaTiO3-Liu2014"
)",
                                            {"model.plane=axisymmetric", "contact.on=bottom"}));
  EXPECT_THAT(text, HasSubstr("# boundary \"left\": on the axis, without area\n"));
}

TEST(Regions, AreListedByTheirNames) {
  const std::string text = run::survey(read(square + R"([[region]]
name = "foot"
where = "y < 0.05"
material.library = "steel"
[[region]]
where = "y >= 0.05"
material.library = "BaTiO3-Liu2014"
)"));
  EXPECT_THAT(text, HasSubstr("# region \"foot\": steel"));
  EXPECT_THAT(text, HasSubstr("# region \"y >= 0.05\": BaTiO3"));
}

// Layers of a stack under pressure s and voltage V, sides held: in each layer strain and field are
// uniform, and s and D are common,
//     s = c33 eps + e33 phi',   D = e33 eps - beta33 phi',   sum of h phi' = V,
// with e33 of the sign of the layer's poling; in a conductor phi' = 0 and eps = s / c33.
struct Layer {
  double height, c, e, beta;
  bool conductor = false;
};

struct Stack {
  double pressure, charge;  // s and D
  std::vector<double> strain, slope;
};

Stack solved(const std::vector<Layer> &layers, double s, double volts) {
  // phi' = (e s / c - D) / (beta + e^2 / c)
  double by_stress = 0, by_charge = 0;
  for (const Layer &layer : layers)
    if (!layer.conductor) {
      const double stiff = layer.beta + layer.e * layer.e / layer.c;
      by_stress += layer.height * layer.e * s / layer.c / stiff;
      by_charge += layer.height / stiff;
    }
  Stack stack{s, (by_stress - volts) / by_charge, {}, {}};
  for (const Layer &layer : layers) {
    const double stiff = layer.beta + layer.e * layer.e / layer.c;
    const double slope = layer.conductor ? 0 : (layer.e * s / layer.c - stack.charge) / stiff;
    stack.slope.push_back(slope);
    stack.strain.push_back((s - layer.e * slope) / layer.c);
  }
  return stack;
}

// Without couplings to heat, which would warm the layers.
const std::string laminate = R"(
mesh.box = { min = [0, 0], max = [0.01, 0.03], cells = [2, 6] }
time = { end = 1, steps = 1 }
boundary = [
  { on = ["left", "right"], displacement = [0, "free"] },
  { on = "bottom", displacement = ["free", 0], potential = 0 },
  { on = "top", traction = [0, 2e6], potential = 300 },
]
[[region]]
where = "y < 0.01"
material = { library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0 }
[[region]]
where = "y > 0.01 && y < 0.02"
material = { library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0, c33 = 100e9, e33 = 5, beta33 = 3e-9, poling = [0, -1] }
[[region]]
where = "y > 0.02"
)";

void expect_stack(const RunCase &run, const std::vector<Layer> &layers, double tolerance) {
  const Stack stack = solved(layers, 2e6, 300);
  const Table nodes = run.nodes();
  const auto y = nodes.numbers("y"), u = nodes.numbers("u_y"), phi = nodes.numbers("potential");
  double top = 0;
  for (std::size_t i = 0; i < layers.size(); ++i)
    top += layers[i].height * std::abs(stack.strain[i]);
  for (std::size_t node = 0; node < y.size(); ++node) {
    double displacement = 0, potential = 0, below = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const double height = std::clamp(y[node] - below, 0., layers[i].height);
      displacement += height * stack.strain[i];
      potential += height * stack.slope[i];
      below += layers[i].height;
    }
    EXPECT_NEAR(u[node], displacement, tolerance * top) << "at y = " << y[node];
    EXPECT_NEAR(phi[node], potential, tolerance * 300) << "at y = " << y[node];
  }
  // D.nu on the top, per metre of depth.
  const double charge = run.history().numbers("charge_top").back();
  EXPECT_NEAR(charge, 0.01 * stack.charge, tolerance * 0.01 * std::abs(stack.charge));
}

TEST(Laminate, TwoPiezoelectricLayersAndADielectricAreExactAtEveryNode) {
  const RunCase run(read(
      laminate +
      R"(material = { symmetry = "isotropic", young = 80e9, poisson = 0.25, eps11 = 100, k11 = 1, density = 3000, specific_heat = 500, reference_temperature = 293 }
)"));
  const double modulus = 80e9 * 0.75 / (1.25 * 0.5);
  expect_stack(run,
               {{0.01, 162e9, 18.6, 12.6e-9},
                {0.01, 100e9, -5, 3e-9},
                {0.01, modulus, 0, 100 * 8.8541878128e-12}},
               1e-10);
}

// The conductor is a dielectric of a millionfold permittivity: an error of that order.
TEST(Laminate, AFloatingConductorCarriesNoFieldAndPassesTheChargeOn) {
  const RunCase run(read(
      laminate +
      R"(material = { symmetry = "isotropic", conductor = true, young = 80e9, poisson = 0.25, k11 = 1, density = 3000, specific_heat = 500, reference_temperature = 293 }
)"));
  expect_stack(run,
               {{0.01, 162e9, 18.6, 12.6e-9},
                {0.01, 100e9, -5, 3e-9},
                {0.01, 80e9 * 0.75 / (1.25 * 0.5), 0, 1, true}},
               5e-6);
}

// Two ceramic layers and a steel one between them, which touches left and right.
const std::string with_steel = R"(
mesh.box = { min = [0, 0], max = [0.02, 0.03], cells = [4, 6] }
time = { end = 2, steps = 2 }
boundary = [ { on = "bottom", displacement = [0, 0], potential = 0, temperature = 0 } ]
output = { fields = false, report = false }
[[region]]
where = "y < 0.01 || y > 0.02"
material.library = "BaTiO3-Liu2014"
[[region]]
where = "y >= 0.01 && y <= 0.02"
material.library = "steel"
)";

// What is said of the case with further boundaries and electrodes.
std::string refusal(const std::vector<std::string> &overrides) {
  try {
    RunCase run(casefile::read_text(with_steel, "case.toml", overrides));
  } catch (const CaseError &error) {
    return error.what();
  }
  return "";
}

TEST(Conductor, MayNotHaveTwoPotentials) {
  const std::string bottom = "{on='bottom',displacement=[0,0],temperature=0,potential=0},";
  const auto with = [&](const std::string &more) {
    return std::vector<std::string>{"boundary=[" + bottom + more + "]"};
  };
  // The same value twice, or one that both formulas have at all steps, is one potential.
  EXPECT_EQ(refusal(with("{on='left',potential=0},{on='right',potential=0}")), "");
  EXPECT_EQ(refusal(with("{on='left',potential='0*t'},{on='right',potential='t*(t-1)*(t-2)'}")),
            "");
  const std::string two = refusal(with("{on='left',potential=0},{on='right',potential='t-1'}"));
  EXPECT_THAT(two, AllOf(HasSubstr("one conductor"), HasSubstr("with 1 V and 0 V at t = 2 s"),
                         HasSubstr("boundary")));
  EXPECT_THAT(refusal(with("{on='left',potential='y'}")), HasSubstr("one conductor"));
}

TEST(Conductor, MayNotHaveTwoElectrodesNorOneOfUnknownVoltageBesideAPotential) {
  const auto on = [](const std::string &name, const std::string &side, const std::string &more) {
    return "{name='" + name + "',on='" + side + "'" + more + "}";
  };
  const std::string left = on("a", "left", ",voltage=1"), right = on("b", "right", ",voltage=1");
  EXPECT_EQ(refusal({"electrode=[" + left + "]"}), "");
  EXPECT_THAT(refusal({"electrode=[" + left + "," + right + "]"}),
              HasSubstr("which of these electrodes has its charge"));
  const std::string potential =
      "boundary=[{on='bottom',displacement=[0,0],temperature=0,potential=0},"
      "{on='right',potential=1}]";
  EXPECT_EQ(refusal({potential, "electrode=[" + left + "]"}), "");
  EXPECT_THAT(refusal({potential, "electrode=[" + on("a", "left", ",voltage=2") + "]"}),
              HasSubstr("with "));
  EXPECT_THAT(refusal({potential, "electrode=[" + on("a", "left", "") + "]"}),
              HasSubstr("cannot be found from its circuit"));
}

// The largest entry of a tensor depends on its axes, the largest permittivity does not.
TEST(Conductor, ItsPermittivityDependsNeitherOnTheAxesNorOnTheUnitsInWhichTheOthersAreGiven) {
  const auto of = [](const std::string &permittivity) {
    const casefile::Case asked = casefile::read_text(
        with_steel, "case.toml",
        {"region[0].material={permittivity=" + permittivity +
         ",stiffness=[[2e11,8e10,8e10,0,0,0],[8e10,2e11,8e10,0,0,0],[8e10,8e10,2e11,0,0,0],"
         "[0,0,0,6e10,0,0],[0,0,0,0,6e10,0],[0,0,0,0,0,6e10]],conductivity=[[1,0,0],[0,1,0],[0,0,1]"
         "],"
         "thermal_stress=[0,0,0,0,0,0],density=7000,specific_heat=500,reference_temperature=293}"});
    return material::Composition<2>(asked).at(1, {}).permittivity(0, 0);
  };
  // 1 and 3 nF/m along the axes, or along the diagonals.
  const double along = of("[[1e-9,0,0],[0,1e-9,0],[0,0,3e-9]]");
  EXPECT_NEAR(along, 1e6 * 3e-9, 1e-12);
  EXPECT_NEAR(of("[[2e-9,0,1e-9],[0,1e-9,0],[1e-9,0,2e-9]]"), along, 1e-14);
  // With voltages in mV all of them are below the vacuum's in SI units.
  EXPECT_NEAR(of("[[1e-15,0,0],[0,1e-15,0],[0,0,3e-15]]"), 1e-6 * along, 1e-18);
}

// A ring of cells that a turn maps onto one another: poled along the radius, it must answer alike
// in every direction.
TEST(RadialPoling, ARingUnderVoltageGrowsAlikeInEveryDirection) {
  const RunCase run(read(R"(
mesh.annulus = { inner = 0.01, outer = 0.02, cells = [4, 12], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", poling = ["x", "y"] }
time = { end = 1, steps = 1 }
boundary = [
  { on = "inner", displacement = [0, 0], potential = 0, temperature = 0 },
  { on = "outer", potential = 100, temperature = 0 },
]
)"));
  const Table nodes = run.nodes();
  const auto x = nodes.numbers("x"), y = nodes.numbers("y"), u = nodes.numbers("u_x"),
             v = nodes.numbers("u_y");
  double radial = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (const double r = std::hypot(x[i], y[i]); r > 0.0199) {
      const double here = (u[i] * x[i] + v[i] * y[i]) / r;
      if (radial == 0)
        radial = here;
      EXPECT_NEAR(here, radial, 1e-10 * std::abs(radial));
      EXPECT_NEAR(u[i] * y[i] - v[i] * x[i], 0, 1e-10 * r * std::abs(radial));
    }
  EXPECT_NE(radial, 0);
}

}  // namespace
}  // namespace tourmaline::verified
