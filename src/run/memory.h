#pragma once

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::run {

/// Bytes that a run with a factorisation will need at its peak, from the number of nodes alone:
/// growing as N log N in 2D and as N^(4/3) in 3D (the factor of nested dissection), fitted to
/// measured runs (docs/measurements.md).
double factorised_memory(const casefile::Case &asked);
/// Of them what a further factorisation takes, for steps of another size.
double another_factorisation(const casefile::Case &asked);
/// The same of a run that solves the body's equations iteratively: growing as N, by the number of
/// nodes that a node shares cells with.
double iterative_memory(const casefile::Case &asked);

/// Whether the body's equations are solved iteratively: because the case says so, or, where it says
/// automatic, because in three dimensions a factorisation needs more than half of what is
/// available (and the voltages of all electrodes are given). The same on all ranks, which ask
/// together.
bool solves_iteratively(const casefile::Case &asked);
/// Whether what is solved iteratively is factorised where that fails: with "automatic" and memory
/// for it. All ranks together.
bool may_be_factorised(const casefile::Case &asked);

/// Throws CaseError when the estimate exceeds what the machine has, MachineError when it exceeds
/// what this process may take of that; before anything is allocated.
void require_memory(const casefile::Case &asked);

}  // namespace tourmaline::run
