#pragma once

#include <string>

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::run {

/// What a run of the case will take on this machine, as comments of a case file: memory, seconds of
/// set-up and of a step, on 1, 2 and 4 MPI ranks. Builds mesh and operator, evaluates all formulas
/// (`rehearse`), plans the factorisation and measures the machine's speed; what is left is a model
/// fitted to measured runs (docs/measurements.md). On several ranks only the formulas are
/// evaluated, and nothing is told. Throws CaseError, MachineError.
std::string expected_cost(const casefile::Case &asked);

}  // namespace tourmaline::run
