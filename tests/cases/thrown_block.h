#pragma once

#include <fmt/format.h>

#include <string>

namespace tourmaline::verified {

/// A damped block of BaTiO3 that is thrown obliquely on its foundation, and rubs, in two or three
/// dimensions.
inline std::string thrown_block(int dim) {
  const std::string box =
      dim == 2 ? "min = [0,0], max = [0.02,0.01], cells = [6,4], cell = 'quadrilateral'"
               : "min = [0,0,0], max = [0.02,0.01,0.01], cells = [4,2,2], cell = 'hexahedron'";
  return fmt::format(R"toml(
mesh.box = {{ {} }}
material = {{ library = "BaTiO3-Liu2014", stiffness_damping = 2e-8, mass_damping = 100 }}
time = {{ end = 6e-6, steps = 30, regime = "dynamic" }}
boundary = [ {{ on = "top", potential = 0, temperature = 0 }} ]
initial = {{ velocity = {} }}
[contact]
on = "bottom"
gap = 1e-6
normal = "unilateral"
friction = {{ law = "coulomb", coefficient = 0.3 }}
heat = {{ law = "exchange", coefficient = 2e4, foundation_temperature = 0, friction_share = 0.5 }}
)toml",
                     box, dim == 2 ? "[0.5, -1]" : "[0.5, 0.2, -1]");
}

}  // namespace tourmaline::verified
