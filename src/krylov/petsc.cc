#include "krylov/petsc.h"

#include <fmt/format.h>

#include "tourmaline/error.h"

namespace tourmaline::krylov {

namespace {

// Chosen by measurement: docs/measurements.md.
constexpr const char *options[][2] = {
    {"-ksp_type", "fgmres"},
    {"-ksp_gmres_restart", "100"},
    {"-ksp_max_it", "500"},
    // PETSc 3.20 and later would sum by dgemv over vectors that happen to lie next to each other:
    // the last bits would be those of the addresses.
    {"-vec_mdot_use_gemv", "0"},
    {"-u_ksp_type", "preonly"},
    {"-u_pc_type", "gamg"},
    {"-u_pc_gamg_threshold", "-1"},
    {"-u_pc_gamg_aggressive_coarsening", "10"},
    {"-u_pc_gamg_agg_nsmooths", "0"},
    // The coarsest matrix is factorised: it may have so many rows. Levels below are many and slow.
    {"-u_pc_gamg_coarse_eq_limit", "1000"},
    {"-u_pc_mg_cycle_type", "w"},
    {"-u_mg_levels_ksp_type", "chebyshev"},
    {"-u_mg_levels_ksp_max_it", "4"},
    // Found anew for each matrix, with its copy by blocks.
    {"-u_mg_levels_ksp_chebyshev_eigenvalues", "0.1,1"},
    {"-u_mg_levels_pc_type", "jacobi"},
    {"-phi_ksp_type", "preonly"},
    {"-phi_pc_type", "hypre"},
    {"-phi_pc_hypre_type", "boomeramg"},
    {"-phi_pc_hypre_boomeramg_strong_threshold", "0.5"},
    {"-phi_pc_hypre_boomeramg_coarsen_type", "HMIS"},
    {"-phi_pc_hypre_boomeramg_interp_type", "ext+i"},
    {"-phi_pc_hypre_boomeramg_P_max", "4"},
    {"-theta_ksp_type", "preonly"},
    {"-theta_pc_type", "hypre"},
    {"-theta_pc_hypre_type", "boomeramg"},
    {"-theta_pc_hypre_boomeramg_strong_threshold", "0.5"},
    {"-theta_pc_hypre_boomeramg_coarsen_type", "HMIS"},
    {"-theta_pc_hypre_boomeramg_interp_type", "ext+i"},
    {"-theta_pc_hypre_boomeramg_P_max", "4"},
};

}  // namespace

void check(PetscErrorCode code) {
  if (code == PETSC_ERR_MEM)
    throw MachineError("not enough memory for the iterative solver; use a coarser mesh");
  if (code != 0)
    throw SolveError(fmt::format("PETSc failed with error {}", static_cast<int>(code)));
}

void start_petsc() {
  PetscBool running = PETSC_FALSE;
  PetscInitialized(&running);
  if (running)
    return;
  PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr);
  check(PetscInitializeNoArguments());
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  for (const auto &[name, value] : options) {
    PetscBool given = PETSC_FALSE;  // by PETSC_OPTIONS, to try others
    check(PetscOptionsHasName(nullptr, nullptr, name, &given));
    if (!given)
      check(PetscOptionsSetValue(nullptr, name, value));
  }
}

}  // namespace tourmaline::krylov
