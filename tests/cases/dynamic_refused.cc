// Dynamic cases that are refused.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "elastic_body.h"
#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

// Four cells in contact on all sides leave one node to take their mass, about which the body turns.
TEST(DynamicCases, MassThatDoesNotHoldTheBodyIsRefused) {
  std::string all = "contact = [ ";
  for (const char *side : {"bottom", "top", "left", "right"})
    all += fmt::format("{{ on = '{}', gap = 10, normal = 'unilateral' }}, ", side);
  const auto flying = [&](const std::string &override) {
    return run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 0.1], cells = [2, 2], cell = "quadrilateral" }}
material = {{ {}, young = 1e6, density = 1000 }}
time = {{ end = 0.1, steps = 2, regime = "dynamic" }}
boundary = [ {{ on = "left", potential = 0 }} ]
initial = {{ velocity = [1, 0] }}
{}
)toml",
                                elastic, all + "]"),
                    {override});
  };
  try {
    flying("title=flying");
    ADD_FAILURE();
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("[time] contact_mass: "));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("a rotation in the plane"));
  }
  EXPECT_NO_THROW(flying("time.contact_mass=consistent"));
  EXPECT_NO_THROW(flying("mesh.box.cells=[3,2]"));
}

TEST(DynamicCases, WhatHasNoMeaningIsToldInOneSentence) {
  const std::string plain = fmt::format(
      "mesh.box = {{ min = [0,0], max = [1,1], cells = [2,2] }}\n"
      "material = {{ {}, young = 1, density = 1 }}\ntime = {{ end = 1, steps = 1 }}\n"
      "boundary = [ {{ on = 'top', potential = 0, displacement = [0, 0] }} ]\n",
      elastic);
  const auto error = [&](const std::string &override) {
    try {
      run_text(plain, {override});
    } catch (const CaseError &e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(error("time.regime=hypersonic"), ::testing::HasSubstr("\"dynamic\""));
  EXPECT_THAT(error("time.contact_mass=consistent"), ::testing::HasSubstr("regime = \"dynamic\""));
  EXPECT_THAT(error("initial.velocity=[1,0]"), ::testing::HasSubstr("regime = \"dynamic\""));
  EXPECT_THAT(error("load.base_acceleration=['x',0]"), ::testing::HasSubstr("depends on place"));
  EXPECT_THAT(error("material.stiffness_damping=-1"), ::testing::HasSubstr("stiffness_damping"));
}

}  // namespace
}  // namespace tourmaline::verified
