#pragma once

#include <petscksp.h>

namespace tourmaline::krylov {

/// Throws MachineError where PETSc lacked memory, SolveError with the number of any other error.
void check(PetscErrorCode code);

/// Starts PETSc with the options of this program's solver, unless it runs. Errors come back as
/// codes, and signals stay with the program. Options in PETSC_OPTIONS come first.
void start_petsc();

}  // namespace tourmaline::krylov
