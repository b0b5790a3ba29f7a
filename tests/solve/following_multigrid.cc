// Label: unit. A multigrid whose matrix changes in few rows: on all levels it is that of the
// changed matrix. The same tests run on one rank, two and four (CMakeLists.txt).
#include "krylov/following_multigrid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <memory>
#include <vector>

#include "krylov/petsc.h"

namespace tourmaline::krylov {
namespace {

constexpr int n_nodes = 20 * 10 * 10;

using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Vector3i place_of(int node) {
  return {node / 100, node / 10 % 10, node % 10};
}
bool is_at_contact(int node) {
  return place_of(node)[2] == 0;
}

// Springs between neighbours of a grid, along its axes and diagonals, and weak ones to the ground.
Block spring(int i, int j) {
  if (i == j) {
    Block sum = 0.01 * Block::Identity();
    for (int k = std::max(0, i - 111); k < std::min(n_nodes, i + 112); ++k)
      if (k != i)
        sum -= spring(i, k);
    return sum;
  }
  const Eigen::Vector3d between = (place_of(i) - place_of(j)).cast<double>();
  return between.cwiseAbs().maxCoeff() > 1
             ? Block::Zero()
             : Block(-between * between.transpose() / between.squaredNorm());
}

// What a contact that holds its nodes in part changes there.
Block change(int i, int j, double held) {
  const auto left = [&](int node) { return is_at_contact(node) ? 1 - held * (node % 3) / 2 : 1.; };
  Block block = (left(i) * left(j) - 1) * spring(i, j);
  if (i == j && is_at_contact(i))
    block += 5 * held * Block::Identity();
  return block;
}

// Of this rank's rows, `block(i, j)` of all nodes side by side of which `is_filled(i, j)`.
Mat matrix_of(const auto &is_filled, const auto &block) {
  Mat matrix = nullptr;
  check(MatCreate(PETSC_COMM_WORLD, &matrix));
  check(MatSetSizes(matrix, PETSC_DECIDE, PETSC_DECIDE, 3 * n_nodes, 3 * n_nodes));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetBlockSize(matrix, 3));
  check(MatSeqAIJSetPreallocation(matrix, 81, nullptr));
  check(MatMPIAIJSetPreallocation(matrix, 81, nullptr, 81, nullptr));
  PetscInt begin = 0, end = 0;
  check(MatGetOwnershipRange(matrix, &begin, &end));
  for (PetscInt i = begin / 3; i < end / 3; ++i)
    for (PetscInt j = 0; j < n_nodes; ++j)
      if ((place_of(i) - place_of(j)).cwiseAbs().maxCoeff() <= 1 && is_filled(i, j))
        check(MatSetValuesBlocked(matrix, 1, &i, 1, &j, Block(block(i, j)).data(), INSERT_VALUES));
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

Mat of_change(double held) {
  return matrix_of([](int i, int j) { return is_at_contact(i) || is_at_contact(j); },
                   [held](int i, int j) { return change(i, j, held); });
}

double difference(Mat a, Mat b) {
  Mat less = nullptr;
  PetscReal norm = 0, size = 0;
  check(MatDuplicate(a, MAT_COPY_VALUES, &less));
  check(MatAXPY(less, -1, b, DIFFERENT_NONZERO_PATTERN));
  check(MatNorm(less, NORM_FROBENIUS, &norm));
  check(MatNorm(a, NORM_FROBENIUS, &size));
  check(MatDestroy(&less));
  return norm / size;
}

double difference_of_products(Mat a, Mat b) {
  Vec x = nullptr, y = nullptr, z = nullptr;
  PetscReal norm = 0, size = 0;
  check(MatCreateVecs(b, &x, &y));
  check(VecDuplicate(y, &z));
  check(VecSetRandom(x, nullptr));
  check(MatMult(a, x, y));
  check(MatMult(b, x, z));
  check(VecNorm(z, NORM_2, &size));
  check(VecAXPY(y, -1, z));
  check(VecNorm(y, NORM_2, &norm));
  for (Vec *vector : {&x, &y, &z})
    check(VecDestroy(vector));
  return norm / size;
}

// The springs, their multigrid with the program's options, and the change that it is to follow.
class OnRanks : public ::testing::Test {
 protected:
  void SetUp() override {
    start_petsc();
    springs_ = matrix_of([](int, int) { return true; }, spring);
    check(KSPCreate(PETSC_COMM_WORLD, &solver_));
    check(KSPSetOptionsPrefix(solver_, "u_"));
    check(KSPSetFromOptions(solver_));
    Mat changed = nullptr;
    check(MatDuplicate(springs_, MAT_COPY_VALUES, &changed));
    check(KSPSetOperators(solver_, changed, changed));
    check(MatDestroy(&changed));
    check(KSPGetPC(solver_, &multigrid_));
    check(PCGAMGSetCoarseEqLim(multigrid_, 50));  // the springs are few
    check(KSPSetUp(solver_));
    check(KSPSetReusePreconditioner(solver_, PETSC_TRUE));
    check(PCMGGetLevels(multigrid_, &n_levels_));
    Mat nothing = of_change(0);
    following_ = std::make_unique<FollowingMultigrid>(solver_, nothing);
    check(MatDestroy(&nothing));
  }

  void TearDown() override {
    following_.reset();
    check(KSPDestroy(&solver_));
    check(MatDestroy(&springs_));
  }

  void follow(double held) {
    Mat asked = of_change(held);
    check(MatCopy(asked, following_->change(), SAME_NONZERO_PATTERN));
    check(MatDestroy(&asked));
    following_->follow();
  }

  Mat matrix(PetscInt level, bool by_blocks = false) {
    KSP smoother = nullptr;
    Mat product = nullptr, matrix = nullptr;
    check(PCMGGetSmoother(multigrid_, level, &smoother));
    check(KSPGetOperators(smoother, &product, &matrix));
    return by_blocks ? product : matrix;
  }

  std::vector<double> applied() {
    Vec x = nullptr, y = nullptr;
    check(MatCreateVecs(springs_, &x, &y));
    check(VecSet(x, 1));
    check(PCApply(multigrid_, x, y));
    const PetscScalar *values = nullptr;
    PetscInt n = 0;
    check(VecGetLocalSize(y, &n));
    check(VecGetArrayRead(y, &values));
    std::vector<double> found(values, values + n);
    check(VecRestoreArrayRead(y, &values));
    check(VecDestroy(&y));
    check(VecDestroy(&x));
    return found;
  }

  Mat springs_ = nullptr;
  KSP solver_ = nullptr;
  PC multigrid_ = nullptr;
  PetscInt n_levels_ = 0;
  std::unique_ptr<FollowingMultigrid> following_;
};

TEST_F(OnRanks, AllLevelsHaveTheChangedMatrix) {
  ASSERT_GE(n_levels_, 3);
  for (const double held : {0.3, 1.}) {
    follow(held);
    Mat expected = of_change(held);
    check(MatAYPX(expected, 1, springs_, DIFFERENT_NONZERO_PATTERN));
    EXPECT_GT(difference(matrix(n_levels_ - 1), springs_), 0.01);
    EXPECT_LT(difference(matrix(n_levels_ - 1), expected), 1e-14);
    check(MatDestroy(&expected));
    for (PetscInt level = n_levels_ - 1; level > 0; --level) {
      Mat interpolation = nullptr, coarse = nullptr;
      check(PCMGGetInterpolation(multigrid_, level, &interpolation));
      check(MatPtAP(matrix(level), interpolation, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &coarse));
      EXPECT_LT(difference(matrix(level - 1), coarse), 1e-13) << level;
      EXPECT_LT(difference_of_products(matrix(level, true), matrix(level)), 1e-14) << level;
      check(MatDestroy(&coarse));
    }
  }
}

TEST_F(OnRanks, NothingIsLeftOfChangesBefore) {
  follow(1);
  const std::vector<double> expected = applied();
  follow(0.3);
  EXPECT_NE(applied(), expected);
  follow(1);
  EXPECT_EQ(applied(), expected);
}

}  // namespace
}  // namespace tourmaline::krylov
