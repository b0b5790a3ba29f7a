#include "krylov/following_multigrid.h"

#include <algorithm>
#include <array>
#include <functional>

#include "krylov/petsc.h"
#include "tourmaline/error.h"

namespace tourmaline::krylov {

namespace {

// Of D^-1 A the largest eigenvalue, from the Krylov space of a noise.
PetscReal largest_eigenvalue(Mat blocks, Mat matrix) {
  constexpr PetscInt iterations = 10;
  constexpr PetscReal never = 1e-30;
  KSP estimate = nullptr;
  PC diagonal = nullptr;
  Vec noise = nullptr, answer = nullptr;
  check(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), &estimate));
  check(KSPSetType(estimate, KSPGMRES));
  check(KSPSetOperators(estimate, blocks, matrix));
  check(KSPGetPC(estimate, &diagonal));
  check(PCSetType(diagonal, PCJACOBI));
  check(KSPSetTolerances(estimate, never, never, PETSC_DEFAULT, iterations));
  check(KSPSetComputeEigenvalues(estimate, PETSC_TRUE));
  check(MatCreateVecs(matrix, &answer, &noise));
  check(VecSetRandom(noise, nullptr));
  check(KSPSolve(estimate, noise, answer));
  std::array<PetscReal, iterations> real{}, imaginary{};
  PetscInt n = 0;
  check(KSPComputeEigenvalues(estimate, iterations, real.data(), imaginary.data(), &n));
  check(VecDestroy(&answer));
  check(VecDestroy(&noise));
  check(KSPDestroy(&estimate));
  return *std::max_element(real.begin(), real.begin() + n);
}

// The user may have asked for another one.
void require_multigrid(PC preconditioner) {
  PetscBool is_multigrid = PETSC_FALSE;
  check(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(preconditioner), &is_multigrid,
                                  PCMG, PCGAMG, PCML, ""));
  if (is_multigrid == PETSC_FALSE)
    throw MachineError(
        "PETSC_OPTIONS give the displacements a preconditioner that is no multigrid (-u_pc_type); "
        "gamg, ml and mg are, and take solver.body = \"direct\" where these do not serve");
}

// Calls `of_row` with each of this rank's rows that has entries, their number, columns and values.
void for_each_row(Mat matrix, const auto &of_row) {
  PetscInt begin = 0, end = 0, n = 0;
  const PetscInt *columns = nullptr;
  const PetscScalar *values = nullptr;
  check(MatGetOwnershipRange(matrix, &begin, &end));
  for (PetscInt row = begin; row < end; ++row) {
    check(MatGetRow(matrix, row, &n, &columns, &values));
    if (n > 0)
      of_row(row, n, columns, values);
    check(MatRestoreRow(matrix, row, &n, &columns, &values));
  }
}

}  // namespace

FollowingMultigrid::FollowingMultigrid(KSP solver, Mat change) {
  PC multigrid = nullptr;
  PetscInt n_levels = 0;
  check(KSPGetPC(solver, &multigrid));
  require_multigrid(multigrid);
  check(PCMGGetLevels(multigrid, &n_levels));
  check(PetscObjectReference(reinterpret_cast<PetscObject>(change)));
  for (PetscInt i = n_levels - 1; i >= 0; --i) {
    Level &level = levels_.emplace_back();
    level.change = change;
    check(PCMGGetSmoother(multigrid, i, &level.solver));
    check(KSPGetOperators(level.solver, nullptr, &level.matrix));
    note(level);
    if (i == 0)
      break;
    level.product = std::make_unique<BlockProduct>(level.matrix);
    check(PCMGSetResidual(multigrid, i, PCMGResidualDefault, level.product->shell()));
    check(PCMGGetInterpolation(multigrid, i, &level.interpolation));
    check(MatPtAP(level.change, level.interpolation, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &change));
  }
}

FollowingMultigrid::~FollowingMultigrid() {
  for (Level &level : levels_)
    MatDestroy(&level.change);
}

// What PETSc keeps to make the matrix of the level once more is not needed.
void FollowingMultigrid::note(Level &level) {
  check(MatProductClear(level.matrix));
  PetscInt begin = 0, block_size = 1;
  check(MatGetOwnershipRange(level.matrix, &begin, nullptr));
  check(MatGetBlockSize(level.matrix, &block_size));
  for_each_row(level.change, [&](PetscInt row, PetscInt n, const PetscInt *columns, auto) {
    const PetscInt first_of_block = (row - begin) / block_size * block_size;
    if (level.rows.empty() || level.rows.back() != first_of_block)
      level.rows.push_back(first_of_block);
    const std::size_t before = level.without.size();
    level.without.resize(before + n);
    check(MatGetValues(level.matrix, 1, &row, n, columns, &level.without[before]));
  });
}

void FollowingMultigrid::put_change(Level &level) {
  std::vector<PetscScalar> sums = level.without;
  auto *next = sums.data();
  for_each_row(level.change,
               [&](PetscInt row, PetscInt n, const PetscInt *columns, const PetscScalar *values) {
                 std::transform(values, values + n, next, next, std::plus<>());
                 check(MatSetValues(level.matrix, 1, &row, n, columns, next, INSERT_VALUES));
                 next += n;
               });
  check(MatAssemblyBegin(level.matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(level.matrix, MAT_FINAL_ASSEMBLY));
}

// Chebyshev's smoothers need bounds of the spectrum.
void FollowingMultigrid::smooth(Level &level) {
  constexpr PetscReal safe = 1.1, smoothed = 0.1;
  Mat blocks = level.product->shell();
  level.product->read_again(level.rows);
  const PetscReal largest = largest_eigenvalue(blocks, level.matrix);
  check(KSPChebyshevSetEigenvalues(level.solver, safe * largest, smoothed * largest));
  check(KSPSetOperators(level.solver, blocks, level.matrix));
}

void FollowingMultigrid::follow() {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level &level = levels_[i];
    put_change(level);
    if (level.product)
      smooth(level);
    else
      check(KSPSetOperators(level.solver, level.matrix, level.matrix));
    check(KSPSetUp(level.solver));
    check(KSPSetUpOnBlocks(level.solver));
    if (level.interpolation != nullptr)
      check(MatPtAP(level.change, level.interpolation, MAT_REUSE_MATRIX, PETSC_DEFAULT,
                    &levels_[i + 1].change));
  }
}

}  // namespace tourmaline::krylov
