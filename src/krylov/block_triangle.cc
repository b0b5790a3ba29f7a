#include "krylov/block_triangle.h"

#include <string>

#include "krylov/petsc.h"

namespace tourmaline::krylov {

namespace {

Mat part_of(Mat matrix, IS rows, IS columns) {
  Mat part = nullptr;
  check(MatCreateSubMatrix(matrix, rows, columns, MAT_INITIAL_MATRIX, &part));
  return part;
}

KSP solver_of(Mat matrix, const std::string &prefix) {
  KSP solver = nullptr;
  check(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), &solver));
  check(KSPSetOptionsPrefix(solver, prefix.c_str()));
  check(KSPSetFromOptions(solver));
  check(KSPSetOperators(solver, matrix, matrix));
  return solver;
}

}  // namespace

BlockTriangle::BlockTriangle(Mat matrix, const std::array<Block, n_blocks> &blocks)
    : blocks_(blocks) {
  for (int i = 0; i < n_blocks; ++i) {
    diagonal_[i] = part_of(matrix, blocks[i].own, blocks[i].own);
    for (int j = 0; j < i; ++j)
      below_[i][j] = part_of(matrix, blocks[i].own, blocks[j].own);
    solvers_[i] = solver_of(diagonal_[i], std::string(blocks[i].name) + "_");
    check(MatCreateVecs(diagonal_[i], &found_[i], &right_sides_[i]));
    check(VecDuplicate(right_sides_[i], &products_[i]));
  }
}

BlockTriangle::~BlockTriangle() {
  for (int i = 0; i < n_blocks; ++i) {
    for (Vec *vector : {&right_sides_[i], &products_[i], &found_[i]})
      VecDestroy(vector);
    KSPDestroy(&solvers_[i]);
    for (Mat &coupling : below_[i])
      MatDestroy(&coupling);
    MatDestroy(&diagonal_[i]);
    ISDestroy(&blocks_[i].own);
  }
}

void BlockTriangle::attach_to(KSP solver) {
  PC preconditioner = nullptr;
  check(KSPGetPC(solver, &preconditioner));
  check(PCSetType(preconditioner, PCSHELL));
  check(PCShellSetContext(preconditioner, this));
  check(PCShellSetApply(preconditioner, apply));
}

PetscErrorCode BlockTriangle::apply(PC preconditioner, Vec right_side, Vec found) {
  PetscFunctionBeginUser;
  BlockTriangle *in = nullptr;
  PetscCall(PCShellGetContext(preconditioner, &in));
  in->apply(right_side, found);
  PetscFunctionReturn(0);
}

void BlockTriangle::apply(Vec right_side, Vec found) {
  for (int i = 0; i < n_blocks; ++i) {
    check(VecISCopy(right_side, blocks_[i].own, SCATTER_REVERSE, right_sides_[i]));
    for (int j = 0; j < i; ++j) {
      check(MatMult(below_[i][j], found_[j], products_[i]));
      check(VecAXPY(right_sides_[i], -1, products_[i]));
    }
    check(KSPSolve(solvers_[i], right_sides_[i], found_[i]));
    check(VecISCopy(found, blocks_[i].own, SCATTER_FORWARD, found_[i]));
  }
}

}  // namespace tourmaline::krylov
