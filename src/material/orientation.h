#pragma once

#include "material/constants.h"

namespace tourmaline::material {

/// Rotation whose columns are the crystal's axes 1, 2, 3 in the axes of the body: v_body = R
/// v_crystal. In 2D the body's x, y are the crystal's 1, 3 unless `poling` says otherwise. Throws
/// CaseError for directions of wrong length or zero. `place` [m] is where formulas are looked at.
Tensor crystal_axes(const casefile::MaterialCase &asked, int dimension,
                    const std::array<double, 3> &place = {});

/// The constants in the axes of the body (Bond's matrices for the Voigt forms; B. A. Auld, Acoustic
/// Fields and Waves in Solids I, section 3.D).
Constants rotated(const Constants &crystal, const Tensor &rotation);

}  // namespace tourmaline::material
