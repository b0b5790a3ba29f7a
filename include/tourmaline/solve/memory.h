#pragma once

#include "tourmaline/case/case.h"

namespace tourmaline::solve {

/// Bytes that a run will need at its peak, from the number of nodes alone: in 2D about 2 kB an
/// unknown, in 3D growing with the power 4/3 (the factor of nested dissection), fitted to measured
/// runs (docs/architecture.md).
double estimated_memory(const casefile::Case &asked);

/// Bytes that this process may still take: what the system has available, or its own limit if that
/// is less.
double available_memory();

/// Throws CaseError when the estimate exceeds what is available, before anything is allocated.
void require_memory(const casefile::Case &asked);

}  // namespace tourmaline::solve
