#pragma once

#include <string>

namespace tourmaline::verified {

/// A body that only Coulomb's friction holds. Bowed by heat it leaves its foundation, but for a few
/// nodes. `time`: lines of a case.
inline std::string leaning_body(const std::string &time) {
  return time + R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [4, 4], cell = "triangle" }
material.library = "BaTiO3-Liu2014"
boundary = [
  { on = "right", traction = ["-2e3*(1 + t)", 0], potential = 0, temperature = 0 },
  { on = "top", traction = ["-500*t", "-700*sin(4*t)"] } ]
[contact]
on = "left"
foundation_displacement = ["2e-10*min(4*t, 1)*(1 - 1.2*max(t - 1.5, 0))", "6e-10*sin(2*t)"]
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.8 }
heat = { law = "exchange", coefficient = 100, foundation_temperature = -27 }
)toml";
}

}  // namespace tourmaline::verified
