#include "krylov/block_smoothing.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "krylov/block_rows.h"
#include "krylov/petsc.h"

namespace tourmaline::krylov {

namespace {

// What MatMult of the shell knows. Each rank has its rows: a part with its own columns and one with
// those of others, numbered as `ghosts_` has them.
class BlockProduct {
 public:
  explicit BlockProduct(Mat matrix);
  ~BlockProduct();
  BlockProduct(const BlockProduct &) = delete;
  BlockProduct &operator=(const BlockProduct &) = delete;

  void multiply(Vec x, Vec y);

 private:
  void split(Mat matrix, PetscInt block_size);

  std::unique_ptr<BlockRows> own_, others_;  // the second on several ranks
  Vec ghosts_ = nullptr;
  VecScatter fetch_ = nullptr;
};

BlockProduct::BlockProduct(Mat matrix) {
  PetscBool is_shared = PETSC_FALSE;
  PetscInt block_size = 1;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATMPIAIJ, &is_shared));
  check(MatGetBlockSize(matrix, &block_size));
  if (is_shared)
    split(matrix, block_size);
  else
    own_ = std::make_unique<BlockRows>(matrix, block_size);
}

void BlockProduct::split(Mat matrix, PetscInt block_size) {
  Mat own = nullptr, others = nullptr;
  const PetscInt *column = nullptr;
  PetscInt n_columns = 0;
  check(MatMPIAIJGetSeqAIJ(matrix, &own, &others, &column));
  check(MatGetLocalSize(others, nullptr, &n_columns));
  own_ = std::make_unique<BlockRows>(own, block_size);
  others_ = std::make_unique<BlockRows>(others, 1);
  Vec whole = nullptr;
  IS places = nullptr;
  check(MatCreateVecs(matrix, &whole, nullptr));
  check(VecCreateSeq(PETSC_COMM_SELF, n_columns, &ghosts_));
  check(ISCreateGeneral(PETSC_COMM_SELF, n_columns, column, PETSC_USE_POINTER, &places));
  check(VecScatterCreate(whole, places, ghosts_, nullptr, &fetch_));
  check(ISDestroy(&places));
  check(VecDestroy(&whole));
}

BlockProduct::~BlockProduct() {
  VecScatterDestroy(&fetch_);
  VecDestroy(&ghosts_);
}

void add_product(const BlockRows &rows, Vec x, PetscScalar *y) {
  const PetscScalar *values = nullptr;
  check(VecGetArrayRead(x, &values));
  rows.add_product(values, y);
  check(VecRestoreArrayRead(x, &values));
}

void BlockProduct::multiply(Vec x, Vec y) {
  if (others_)
    check(VecScatterBegin(fetch_, x, ghosts_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecZeroEntries(y));
  PetscScalar *sums = nullptr;
  check(VecGetArray(y, &sums));
  add_product(*own_, x, sums);
  if (others_) {
    check(VecScatterEnd(fetch_, x, ghosts_, INSERT_VALUES, SCATTER_FORWARD));
    add_product(*others_, ghosts_, sums);
  }
  check(VecRestoreArray(y, &sums));
}

PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
  PetscFunctionBeginUser;
  BlockProduct *in = nullptr;
  PetscCall(MatShellGetContext(shell, &in));
  in->multiply(x, y);
  PetscFunctionReturn(0);
}

PetscErrorCode destroy(Mat shell) {
  PetscFunctionBeginUser;
  BlockProduct *in = nullptr;
  PetscCall(MatShellGetContext(shell, &in));
  delete in;
  PetscFunctionReturn(0);
}

Mat by_blocks(Mat matrix) {
  PetscInt rows = 0, columns = 0;
  check(MatGetLocalSize(matrix, &rows, &columns));
  auto context = std::make_unique<BlockProduct>(matrix);
  MPI_Comm all = MPI_COMM_NULL;
  Mat shell = nullptr;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(matrix), &all));
  check(MatCreateShell(all, rows, columns, PETSC_DETERMINE, PETSC_DETERMINE, nullptr, &shell));
  check(MatShellSetOperation(shell, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  check(MatShellSetOperation(shell, MATOP_DESTROY, reinterpret_cast<void (*)()>(destroy)));
  check(MatShellSetContext(shell, context.release()));
  return shell;
}

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

}  // namespace

void smooth_by_blocks(PC multigrid) {
  constexpr PetscReal safe = 1.1, smoothed = 0.1;
  PetscInt n_levels = 0;
  check(PCMGGetLevels(multigrid, &n_levels));
  for (PetscInt level = 1; level < n_levels; ++level) {
    KSP smoother = nullptr;
    Mat matrix = nullptr;
    check(PCMGGetSmoother(multigrid, level, &smoother));
    check(KSPGetOperators(smoother, nullptr, &matrix));
    Mat blocks = by_blocks(matrix);
    const PetscReal largest = largest_eigenvalue(blocks, matrix);
    check(KSPChebyshevSetEigenvalues(smoother, safe * largest, smoothed * largest));
    check(KSPSetOperators(smoother, blocks, matrix));
    check(PCMGSetResidual(multigrid, level, PCMGResidualDefault, blocks));
    check(MatDestroy(&blocks));
  }
}

}  // namespace tourmaline::krylov
