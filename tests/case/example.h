#pragma once

#include <string>

namespace tourmaline::casefile {

/// A square in contact on its left side, held on its right side, pressed on its top.
inline const std::string example = R"(title = "Thermally conductive foundation"

[mesh]
box = { min = [0, 0], max = [0.1, 0.1], cells = [64, 64], cell = "triangle" }

[material]
library = "BaTiO3-Liu2014"
pyroelectric = [0, 1e-4]

[time]
end = 0.2
steps = 20

[[boundary]]
on = "right"
displacement = [0, 0]
potential = 0
temperature = 0

[[boundary]]
on = ["bottom", "top"]
temperature = 0

[[boundary]]
on = "top"
traction = [0, "-0.5*t"]

[contact]
on = "left"
normal = "bilateral"
friction = { law = "tresca", bound = 15 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }

[solver]
method = "condensed"

[output]
fields = true
every = 1
report = true
)";

/// A cube, held and grounded on its bottom.
inline const std::string cube = R"([mesh]
box = { min = [0, 0, 0], max = [1, 1, 1], cells = [2, 2, 2], cell = "hexahedron" }

[material]
library = "BaTiO3-Liu2014"

[time]
end = 1
steps = 100

[[boundary]]
on = "bottom"
displacement = [0, 0, 0]
potential = 0
)";

/// A ring on a shaft, held and grounded at its outside.
inline const std::string ring = R"([mesh]
annulus = { inner = 0.1, outer = 0.2, cells = [2, 16], cell = "triangle" }

[material]
library = "BaTiO3-Liu2014"

[time]
end = 1
steps = 1

[[boundary]]
on = "outer"
displacement = [0, 0]
potential = 0

[contact]
on = "inner"
)";

}  // namespace tourmaline::casefile
