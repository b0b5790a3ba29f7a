#pragma once

namespace tourmaline::verified {

/// A warmed block of BaTiO3 that a foundation rubs, as it moves along, and leaves.
constexpr const char *rubbed_block = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.02, 0.01], cells = [6, 5, 3], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = ["2e-7*t", "3e-7*t^2", "-5e-7*t"], potential = 0, temperature = "20*t" } ]
[contact]
on = "bottom"
gap = "3e-3*((x - 0.008)^2 + (y - 0.011)^2)"
foundation_displacement = ["5e-7*sin(4*t)", "1e-5*x*t", 0]
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml";

}  // namespace tourmaline::verified
