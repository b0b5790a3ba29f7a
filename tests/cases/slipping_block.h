#pragma once

namespace tourmaline::verified {

/// A block of tetrahedra whose contact slips in different directions.
constexpr const char *slipping_block = R"toml(
[mesh]
box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [5, 5, 5], cell = "tetrahedron" }
[material]
library = "BaTiO3-Liu2014"
pyroelectric = [0, 0, 1e-4]
[time]
end = 0.2
steps = 4
[[boundary]]
on = "right"
displacement = [0, 0, 0]
potential = "1e-3*t"
temperature = 0
[[boundary]]
on = "top"
traction = [0, "-3*t*(1+x*10)", "-50*t*y"]
[contact]
on = "left"
friction = { law = "tresca", bound = 0.05 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
)toml";

}  // namespace tourmaline::verified
