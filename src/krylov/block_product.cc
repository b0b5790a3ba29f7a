#include "krylov/block_product.h"

#include "krylov/petsc.h"

namespace tourmaline::krylov {

namespace {

// Of a rank's rows. `others` stays empty on one rank.
struct Parts {
  Mat own = nullptr, others = nullptr;
  const PetscInt *column = nullptr;  // of others, in the whole matrix
};

Parts parts_of(Mat matrix) {
  PetscBool is_shared = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATMPIAIJ, &is_shared));
  Parts parts{matrix};
  if (is_shared)
    check(MatMPIAIJGetSeqAIJ(matrix, &parts.own, &parts.others, &parts.column));
  return parts;
}

void add_product(const BlockRows &rows, Vec x, PetscScalar *y) {
  const PetscScalar *values = nullptr;
  check(VecGetArrayRead(x, &values));
  rows.add_product(values, y);
  check(VecRestoreArrayRead(x, &values));
}

}  // namespace

BlockProduct::BlockProduct(Mat matrix) : matrix_(matrix) {
  check(MatGetBlockSize(matrix, &block_size_));
  const Parts parts = parts_of(matrix);
  own_ = std::make_unique<BlockRows>(parts.own, block_size_);
  if (parts.others != nullptr)
    split();
  make_shell();
}

void BlockProduct::split() {
  const Parts parts = parts_of(matrix_);
  PetscInt n_columns = 0;
  check(MatGetLocalSize(parts.others, nullptr, &n_columns));
  others_ = std::make_unique<BlockRows>(parts.others, 1);
  Vec whole = nullptr;
  IS places = nullptr;
  check(MatCreateVecs(matrix_, &whole, nullptr));
  check(VecCreateSeq(PETSC_COMM_SELF, n_columns, &ghosts_));
  check(ISCreateGeneral(PETSC_COMM_SELF, n_columns, parts.column, PETSC_USE_POINTER, &places));
  check(VecScatterCreate(whole, places, ghosts_, nullptr, &fetch_));
  check(ISDestroy(&places));
  check(VecDestroy(&whole));
}

void BlockProduct::make_shell() {
  PetscInt rows = 0, columns = 0;
  check(MatGetLocalSize(matrix_, &rows, &columns));
  check(MatCreateShell(PetscObjectComm(reinterpret_cast<PetscObject>(matrix_)), rows, columns,
                       PETSC_DETERMINE, PETSC_DETERMINE, this, &shell_));
  check(MatShellSetOperation(
      shell_, MATOP_MULT,
      reinterpret_cast<void (*)()>(static_cast<PetscErrorCode (*)(Mat, Vec, Vec)>(multiply))));
}

BlockProduct::~BlockProduct() {
  MatDestroy(&shell_);
  VecScatterDestroy(&fetch_);
  VecDestroy(&ghosts_);
}

void BlockProduct::read_again(const std::vector<PetscInt> &rows) {
  const Parts parts = parts_of(matrix_);
  for (const PetscInt row : rows) {
    own_->read_again(parts.own, row);
    for (PetscInt r = row; others_ && r < row + block_size_; ++r)
      others_->read_again(parts.others, r);
  }
}

PetscErrorCode BlockProduct::multiply(Mat shell, Vec x, Vec y) {
  PetscFunctionBeginUser;
  BlockProduct *in = nullptr;
  PetscCall(MatShellGetContext(shell, &in));
  in->multiply(x, y);
  PetscFunctionReturn(0);
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

}  // namespace tourmaline::krylov
