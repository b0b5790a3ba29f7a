// Label: unit. Products of the matrices that multigrid smooths with.

#include "krylov/block_rows.h"

#include <gtest/gtest.h>

#include <random>

#include "krylov/petsc.h"

namespace tourmaline::krylov {
namespace {

// Of blocks. Some rows begin with the column that the one before has ended with.
bool is_filled(int row, int column) {
  return row % 3 == 0 ? (7 * row + 3 * column) % 4 == 0 : column == row || column == row + 1;
}

// Of so many blocks of 12 x 12, entries missing here and there; one row of blocks has none.
Mat sparse(int size) {
  constexpr int blocks = 12;
  const PetscInt n = blocks * size;
  std::mt19937 random(static_cast<unsigned>(size));
  std::uniform_real_distribution<double> number(-1, 1);
  Mat matrix = nullptr;
  check(MatCreateSeqAIJ(PETSC_COMM_SELF, n, n, n, nullptr, &matrix));
  for (PetscInt i = 0; i < n; ++i)
    for (PetscInt j = 0; j < n; ++j)
      if (const double value = number(random);
          i / size != 5 && is_filled(i / size, j / size) && value > -0.8)
        check(MatSetValue(matrix, i, j, value, INSERT_VALUES));
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

class BlockRowsOf : public ::testing::TestWithParam<int> {};

TEST_P(BlockRowsOf, GiveTheProductOfTheMatrix) {
  start_petsc();
  Mat matrix = sparse(GetParam());
  Vec x = nullptr, y = nullptr;
  check(MatCreateVecs(matrix, &x, &y));
  check(VecSetRandom(x, nullptr));
  check(MatMult(matrix, x, y));
  const PetscScalar *of_x = nullptr, *expected = nullptr;
  check(VecGetArrayRead(x, &of_x));
  check(VecGetArrayRead(y, &expected));
  PetscInt n = 0;
  check(VecGetSize(y, &n));
  std::vector<double> found(static_cast<std::size_t>(n), 3.);
  BlockRows(matrix, GetParam()).add_product(of_x, found.data());
  for (PetscInt i = 0; i < n; ++i)
    EXPECT_NEAR(found[static_cast<std::size_t>(i)] - 3, expected[i], 1e-14 * n) << i;
  check(VecRestoreArrayRead(y, &expected));
  check(VecRestoreArrayRead(x, &of_x));
  check(VecDestroy(&y));
  check(VecDestroy(&x));
  check(MatDestroy(&matrix));
}

INSTANTIATE_TEST_SUITE_P(Blocks, BlockRowsOf, ::testing::Values(1, 2, 3, 4, 6));

}  // namespace
}  // namespace tourmaline::krylov
