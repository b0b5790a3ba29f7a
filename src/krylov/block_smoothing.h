#pragma once

#include <petscpc.h>

namespace tourmaline::krylov {

/// Lets a multigrid preconditioner (PCMG, or what is built on it), which has just been set up,
/// smooth and take residuals with copies of its matrices by blocks: an application is mostly the
/// time of these products. The bounds of the spectrum that Chebyshev's smoothers need are found
/// with them.
void smooth_by_blocks(PC multigrid);

}  // namespace tourmaline::krylov
