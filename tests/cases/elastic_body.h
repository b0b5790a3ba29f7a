#pragma once

namespace tourmaline::verified {

/// A material's constants but for its stiffness and density: nothing but elastic, in rods.
constexpr const char *elastic =
    "symmetry = 'isotropic', poisson = 0, eps11 = 1, k11 = 1, specific_heat = 1, "
    "reference_temperature = 293";

}  // namespace tourmaline::verified
