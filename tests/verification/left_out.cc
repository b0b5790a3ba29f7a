// Label: analytic. Fields that a model does without: the rest is what it is where they do not
// couple.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "../cases/closed_balances.h"
#include "../cases/run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

struct Variant {
  const char *model, *uncoupled;
  bool is_electric;
};

const Variant isothermal{"thermal = false", "m11 = 0, m33 = 0, p3 = 0", true},
    unelectric{"electric = false", "p3 = 0, e31 = 0, e33 = 0, e15 = 0", false},
    mechanical{"thermal = false, electric = false",
               "m11 = 0, m33 = 0, p3 = 0, e31 = 0, e33 = 0, e15 = 0", false};

std::string rubbed(int dimension, const std::string &model, const char *material,
                   bool is_electric) {
  return fmt::format(
      R"toml(
mesh.box = {}
model = {{ {} }}
material = {{ library = "BaTiO3-Liu2014", stiffness_damping = 1e-3{} }}
time = {{ end = 1, steps = 4 }}
boundary = [ {{ on = "top", displacement = {}{} }} ]
[contact]
on = "bottom"
normal = "unilateral"
friction = {{ law = "coulomb", coefficient = 0.3 }}
)toml",
      dimension == 2
          ? R"({ min = [0, 0], max = [0.02, 0.01], cells = [8, 4], cell = "quadrilateral" })"
          : R"({ min = [0, 0, 0], max = [0.02, 0.02, 0.01], cells = [3, 3, 2], cell = "hexahedron" })",
      model, *material == 0 ? "" : std::string(", ") + material,
      dimension == 2 ? "['2e-8*t', '-1e-8*sin(4*t)']" : "['2e-8*t', '1e-8*t', '-1e-8*sin(4*t)']",
      is_electric ? ", potential = '20*t'" : "");
}

TEST(LeftOut, WhatIsLeftIsWhatItIsBesideFieldsThatDoNotCouple) {
  for (const int dimension : {2, 3})
    for (const Variant &variant : {isothermal, unelectric, mechanical}) {
      SCOPED_TRACE(fmt::format("{} in {}D", variant.model, dimension));
      const RunCase all = run_text(rubbed(dimension, "", variant.uncoupled, true));
      const std::string text = rubbed(dimension, variant.model, "", variant.is_electric);
      for (const char *route :
           {"solver.method=condensed", "solver.method=monolithic", "solver.body=iterative"}) {
        const RunCase some = run_text(text, {route, "solver.linear_tolerance=1e-13"});
        expect_closed_balances(some.history());
        for (const char *column : {"u_x", "u_y", variant.is_electric ? "potential" : "u_x"})
          EXPECT_LT(difference(some.nodes(), all.nodes(), column), 1e-10) << route;
        EXPECT_EQ(some.contact().columns.at("status"), all.contact().columns.at("status"));
      }
    }
}

TEST(LeftOut, TheFactorHasOnlyTheUnknownsThatAreWanted) {
  const auto factor = [](const std::string &model, bool is_electric) {
    return run_text(rubbed(2, model, "", is_electric), {"mesh.box.cells=[32, 16]"})
        .summary()
        .at("sizes")
        .at("factor_entries")
        .get<double>();
  };
  const double whole = factor("", true);
  EXPECT_LT(factor(isothermal.model, true), 0.65 * whole);
  EXPECT_LT(factor(mechanical.model, false), 0.4 * whole);
}

TEST(LeftOut, AFieldThatIsNotWantedNeedsNoConstants) {
  const std::string plate = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [4, 2] }
time = { end = 1, steps = 1 }
boundary = [ { on = "left", displacement = [0, 0] }, { on = "right", traction = [1e5, 0] } ]
)toml";
  const RunCase run = run_text(plate + R"(
model = { thermal = false, electric = false }
material = { symmetry = "isotropic", young = 2e11, poisson = 0.3 }
)");
  EXPECT_THAT(run.summary().at("warnings"), ::testing::IsEmpty());
  EXPECT_FALSE(run.history().columns.contains("max_temperature"));
  EXPECT_FALSE(run.history().columns.contains("max_potential"));
  for (const char *library : {"PZT-4", "PZT-5A", "PZT-5H", "PVDF", "AlN"})
    run_text(plate + fmt::format(R"(
model.thermal = false
material.library = "{}"
)",
                                 library),
             {"boundary[0].potential=0"});
}

TEST(LeftOut, WhatIsSaidOfAFieldThatIsNotThereIsRefused) {
  const auto complaint = [](const std::vector<std::string> &overrides) {
    try {
      run_text(rubbed(2, "", "", true), overrides);
    } catch (const CaseError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string cold = "model.thermal=false", dead = "model.electric=false";
  EXPECT_THAT(complaint({dead}), HasSubstr("has no electric potential, as [model] electric"));
  for (const char *said :
       {"boundary[0].temperature=300", "load.heat=1", "initial.temperature='x'",
        "contact.heat={law='exchange', coefficient=1, foundation_temperature=0}"})
    EXPECT_THAT(complaint({cold, said}), HasSubstr("has no temperature, as [model] thermal"))
        << said;
  EXPECT_EQ(complaint({cold, "boundary[0].temperature=0"}), "");
}

}  // namespace
}  // namespace tourmaline::verified
