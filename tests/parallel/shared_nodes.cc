// Iterative solutions on ranks that have a part of the nodes each: whatever the program knows, with
// the numbers of one rank.

#include <nlohmann/json.hpp>

#include "../cases/leaning_body.h"
#include "../cases/slipping_block.h"
#include "ranks.h"

namespace tourmaline::verified {
namespace {

const std::string iteratively =
    " --set solver.body=iterative --set solver.linear_tolerance=1e-13 --set output.report=false";

// Two layers, of which a foundation rubs one, loaded by place and time; what is said of its sides,
// of places inside and of its layers.
const char *const layers = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [14, 7], cell = "quadrilateral" }
time = { end = 1, steps = 3 }
load = { force = ["1e4*y*t", 0], heat = "1e4*x*t", charge = "1e-4*x" }
initial = { temperature = "3 - 100*x" }
probe = [ { name = "middle", at = [0.0123, 0.0057] }, { name = "line", from = [0, 0], to = [0.02, 0.01], points = 5 },
          { name = "side", on = "right" }, { name = "layer", region = "soft" } ]
[[boundary]]
on = "top"
displacement = [0, "-2e-7*t"]
potential = 0
temperature = "2*t"
[[boundary]]
on = "right"
traction = ["1e4*t*y", "2e3*t"]
heat_flux = "10*t"
surface_charge = "1e-7*t"
[[region]]
name = "hard"
where = "y < 0.005"
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
[[region]]
name = "soft"
where = "y >= 0.005"
material = { library = "BaTiO3-Liu2014", poling = [0, -1] }
[contact]
on = "bottom"
foundation_displacement = ["2e-7*t", 0]
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = "2e3*(1 + x)", foundation_temperature = "20*t" }
)toml";

class SharedNodes : public Ranks {
 protected:
  void expect_same_solution(const std::string &arguments) {
    ASSERT_NO_FATAL_FAILURE(run_twice(arguments + iteratively));
    const auto expect = [](const Table &several, const Table &one,
                           std::vector<Quantity> quantities) {
      for (Quantity &quantity : quantities)
        std::erase_if(quantity, [&](const auto &column) { return !one.columns.contains(column); });
      std::erase_if(quantities, [&](const Quantity &quantity) {
        return std::all_of(quantity.begin(), quantity.end(),
                           [&](const auto &column) { return largest(one, column) == 0; });
      });
      expect_equal_quantities(several, one, quantities);
    };
    const Quantity u{"u_x", "u_y", "u_z"};
    expect(several_.nodes, one_.nodes, {u, {"potential"}, {"temperature"}});
    expect(several_.contact, one_.contact,
           {{"normal_traction", "tangential_traction_x", "tangential_traction_y"},
            {"slip_x", "slip_y", "normal_displacement"},
            {"heat_flux"},
            {"charge_flux"}});
    EXPECT_EQ(several_.contact.columns.at("status"), one_.contact.columns.at("status"));
    expect(several_.history, one_.history,
           {{"load_x", "load_y", "load_z", "reaction_x", "reaction_y", "contact_force_x",
             "contact_force_y", "damping_force_x", "damping_force_y"},
            {"elastic_energy", "electric_energy", "thermal_energy", "coupling_energy"},
            {"stored_energy_rate", "load_power", "electric_power", "thermal_power",
             "conduction_loss", "friction_dissipation", "time_step_loss"},
            {"kinetic_energy"},
            {"inertia_x", "inertia_y"},
            {"viscous_dissipation"},
            {"heat_top", "heat_bottom", "heat_right", "stored_heat_rate", "heat_source"},
            {"charge_top", "electrode_sensor_charge"},
            {"electrode_sensor_voltage"},
            {"min_displacement", "max_displacement"},
            {"min_potential", "max_potential"},
            {"min_temperature", "max_temperature"}});
  }

  void expect_same_probe(const std::string &name) const {
    const Table one = read_table(folder_ / "one" / ("probe-" + name + ".csv")),
                several = read_table(folder_ / "several" / ("probe-" + name + ".csv"));
    for (const auto &[column, values] : one.columns) {
      SCOPED_TRACE(name + " " + column);
      // Components may be round-off of others.
      EXPECT_LE(difference(several, one, column), column.starts_with("min_") ? 1e-6 : 1e-7);
    }
  }
};

TEST_P(SharedNodes, LayersAndWhatProbesTellOfThem) {
  expect_same_solution(file_of(layers));
  for (const char *probe : {"middle", "line", "side", "layer"})
    expect_same_probe(probe);
}

TEST_P(SharedNodes, WithQuadraticShapeFunctionsAndIncompatibleModes) {
  for (const char *mesh : {"mesh.degree=2", "mesh.modes=incompatible"}) {
    SCOPED_TRACE(mesh);
    expect_same_solution(file_of(layers) + " --set " + mesh);
  }
}

TEST_P(SharedNodes, WithAFieldLess) {
  std::string text = layers;
  for (const char *thermal : {"temperature = \"2*t\"\n", "heat_flux = \"10*t\"\n",
                              ", heat = \"1e4*x*t\"", "initial = { temperature = \"3 - 100*x\" }\n",
                              "heat = { law = \"exchange\", coefficient = \"2e3*(1 + x)\", "
                              "foundation_temperature = \"20*t\" }\n"}) {
    ASSERT_NE(text.find(thermal), std::string::npos) << thermal;
    text.erase(text.find(thermal), std::string(thermal).size());
  }
  expect_same_solution(file_of(text) + " --set model.thermal=false");
}

TEST_P(SharedNodes, WithDampingAndAnElectrodeInACircuit) {
  expect_same_solution(file_of(layers) +
                       " --set 'region[0].material.stiffness_damping=0.2'"
                       " --set 'region[0].material.mass_damping=10'"
                       " --set 'electrode=[{name=\"sensor\",on=\"left\",resistor=1e7}]'");
}

// The loads carry it off Newton's method, and the contact's matrix is made on all ranks.
TEST_P(SharedNodes, OfABodyThatOnlyItsContactHolds) {
  expect_same_solution(
      file_of(leaning_body(R"(time = { regime = "static", end = 2, steps = 4 })")) +
      " --set mesh.box.cells=[6,6] --set contact.heat.coefficient=10");
  for (const char *run : {"one", "several"})
    EXPECT_EQ(nlohmann::json::parse(output::content_of(
                  folder_ / run / "summary.json"))["iterations"]["contact_columns"],
              14);  // 7 nodes in the plane
}

// Nodes without mass have come off their foundation, and potentials go to their equilibrium.
TEST_P(SharedNodes, InMotion) {
  for (const char *damping : {"0", "1e-8"}) {
    SCOPED_TRACE(damping);
    expect_same_solution(
        file_of(layers) +
        " --set time.regime=dynamic --set time.end=4e-6 --set time.steps=8"
        " --set initial.velocity='[0.3, -0.2]' --set initial.potential='1e5*x*y'"
        " --set initial.displacement='[0, \"1e-4*(x - 0.005)\"]'"
        " --set 'boundary[0]={on=\"top\",potential=0,temperature=\"2*t\"}'"
        " --set boundary[1].traction='[1e5, -1e5]'"
        " --set 'contact.electric={law=\"exchange\",coefficient=1e-5,foundation_potential=3}'"
        " --set 'electrode=[{name=\"sensor\",on=\"left\",resistor=1e7}]'"
        " --set region[0].material.stiffness_damping=" +
        damping);
  }
}

TEST_P(SharedNodes, AStateThatIsNotThereIsToldOnce) {
  expect_told_once(file_of(layers) + iteratively + " --set 'initial={from=\"nowhere\"}'", 2,
                   "there is no such folder");
  expect_told_once(file_of(layers) + " --set 'initial={from=\"several\"}'", 2, "several");
}

TEST_P(SharedNodes, FromTheStateOfAnotherRunOnTheSameMeshAndOnAnother) {
  const Outcome first = run_on(1, file_of(layers) + iteratively, folder_ / "first");
  ASSERT_EQ(first.status, 0) << first.said;
  for (const char *cells : {"14, 7", "11, 8"}) {
    SCOPED_TRACE(cells);
    expect_same_solution(file_of(layers) + " --set 'initial={from=\"" +
                         (folder_ / "first").string() + "\"}' --set mesh.box.cells='[" + cells +
                         "]'");
  }
}

TEST_P(SharedNodes, OfAStaticBodyWhoseTemperaturesAreSteady) {
  expect_same_solution(file_of(layers) + " --set time.regime=static --set initial.temperature=0");
}

TEST_P(SharedNodes, OfABodyOfRevolution) {
  expect_same_solution(file_of(layers) +
                       " --set model.plane=axisymmetric --set load.force=[0,0]"
                       " --set contact.foundation_displacement='[\"1e-5*x*t\",0]'"
                       " --set 'probe=[]'");
}

TEST_P(SharedNodes, OfASolidOfQuadraticHexahedra) {
  expect_same_solution(file_of(slipping_block) +
                       " --set mesh.box.cells=[3,3,3] --set mesh.box.cell=hexahedron"
                       " --set mesh.degree=2 --set 'load.force=[\"1e3*x*t\",\"1e3*y*t*t\",0]'");
}

// Some rank alone has the places where it happens.
TEST_P(SharedNodes, WhatOnlyOneRankSeesIsToldOnce) {
  expect_told_once(
      file_of(layers) + iteratively + " --set 'initial.temperature=\"sqrt(x - 0.0099)\"'", 2,
      "initial");
  expect_told_once(file_of(layers) + iteratively +
                       " --set 'load.force=[\"x > 0.012 && x < 0.014 ? 1e300*1e300*t : 0\",0]'",
                   2, "load.force");
}

INSTANTIATE_TEST_SUITE_P(Two, SharedNodes, ::testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Four, SharedNodes, ::testing::Values(4));

}  // namespace
}  // namespace tourmaline::verified
