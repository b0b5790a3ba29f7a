#pragma once

#include "material/constants.h"

namespace tourmaline::material {

/// eps^T - eps^S = e c^-1 e^T, the permittivity that deformation adds [C/(V m)]
Tensor clamped_part(const Constants &constants);

/// The largest electromechanical coupling factor of all fields and ways of holding the material:
/// its square is the largest share of the electric energy of a free body that becomes elastic,
/// max (E (eps^T - eps^S) E) / (E eps^T E). At least k33, k31, k15, kt and kp (IEEE Std 176-1987);
/// below 1 where eps^S is positive definite. eps^T has to be.
double coupling_factor(const Constants &constants);
/// The same by eps^T - eps^S and eps^T.
double coupling_factor(const Tensor &clamped, const Tensor &free);

}  // namespace tourmaline::material
