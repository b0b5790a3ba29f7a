#include "dense/decompositions.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <random>
#include <vector>

namespace tourmaline::dense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Decompositions : public testing::Test {
 protected:
  MatrixXd random(Eigen::Index rows, Eigen::Index columns) {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform_(numbers_); });
  }
  MatrixXd symmetric(Eigen::Index n) {
    const MatrixXd half = random(n, n);
    return half + half.transpose();
  }
  MatrixXd definite(Eigen::Index n) {
    const MatrixXd half = random(n, n);
    return half * half.transpose() + MatrixXd::Identity(n, n);
  }

 private:
  std::mt19937 numbers_{1};
  std::uniform_real_distribution<> uniform_{-1, 1};
};

template <class Matrix>
void expect_spectrum(const Matrix &matrix) {
  const auto [values, vectors] = spectrum(matrix);
  const Eigen::Index n = matrix.rows();
  const double size = n > 0 ? matrix.cwiseAbs().maxCoeff() : 0;
  EXPECT_LE((matrix * vectors - vectors * values.asDiagonal()).norm(),
            1e-14 * static_cast<double>(n) * size);
  EXPECT_LE((vectors.transpose() * vectors - Matrix::Identity(n, n)).norm(),
            1e-14 * static_cast<double>(n));
  for (Eigen::Index i = 1; i < n; ++i)
    EXPECT_LE(values[i - 1], values[i]);
}

TEST_F(Decompositions, OfAContactPointsMatrixTheSpectrumIsThatOfEigensSolver) {
  for (const Eigen::Index n : {0, 1, 2})
    for (int i = 0; i < 200; ++i) {
      const SmallMatrix matrix = symmetric(n);
      expect_spectrum(matrix);
      if (n == 0)
        continue;
      const VectorXd values = spectrum(MatrixXd(matrix)).values;
      EXPECT_LE((VectorXd(spectrum(matrix).values) - values).norm(), 1e-14 * values.norm());
    }
}

TEST_F(Decompositions, OfDiagonalEqualAndTinyEntriesThereIsASpectrumToo) {
  for (const auto &entries : std::vector<std::array<double, 3>>{{0, 0, 0},
                                                                {1, 0, 1},
                                                                {3, 0, -2},
                                                                {-2, 0, 3},
                                                                {1, 1, 1},
                                                                {1, 1e-200, 1},
                                                                {1e300, 1e-300, -1e300}}) {
    const SmallMatrix matrix =
        (SmallMatrix(2, 2) << entries[0], entries[1], entries[1], entries[2]).finished();
    expect_spectrum(matrix);
  }
}

TEST_F(Decompositions, TheLowerTriangleCounts) {
  SmallMatrix matrix = (SmallMatrix(2, 2) << 2, 7, 1, 3).finished(), other = matrix;
  other(0, 1) = 1;
  EXPECT_EQ(spectrum(matrix).values, spectrum(other).values);
  EXPECT_EQ(spectrum(MatrixXd(matrix)).values, spectrum(MatrixXd(other)).values);
}

TEST_F(Decompositions, OfLargerMatricesToo) {
  for (const Eigen::Index n : {1, 3, 10, 40}) {
    expect_spectrum(symmetric(n));
    const MatrixXd a = symmetric(n), b = definite(n), root = b.llt().matrixL();
    const MatrixXd same = root.inverse() * a * root.transpose().inverse();
    EXPECT_LE((eigenvalues(a, b) - spectrum(MatrixXd((same + same.transpose()) / 2)).values).norm(),
              1e-12 * static_cast<double>(n));
  }
}

TEST_F(Decompositions, SystemsAreSolved) {
  for (const Eigen::Index n : {1, 6, 50}) {
    const MatrixXd a = random(n, n), spd = definite(n);
    const VectorXd x = random(n, 1);
    EXPECT_LE((solve(a, a * x) - x).norm(), 1e-10 * x.norm());
    EXPECT_LE((inverse(a) * a - MatrixXd::Identity(n, n)).norm(), 1e-10 * static_cast<double>(n));
    const Cholesky factor(spd);
    ASSERT_TRUE(factor.is_definite());
    EXPECT_LE((factor.solve(VectorXd(spd * x)) - x).norm(), 1e-11 * x.norm());
    EXPECT_LE((factor.solve(spd) - MatrixXd::Identity(n, n)).norm(),
              1e-11 * static_cast<double>(n));
    EXPECT_GT(inverse_condition(spd), 0);
    EXPECT_LE(inverse_condition(spd), 1);
  }
}

TEST_F(Decompositions, AMatrixThatIsNotDefiniteIsToldAndASingularOneIsNotSolved) {
  EXPECT_FALSE(Cholesky(-definite(5)).is_definite());
  MatrixXd lower = definite(40).triangularView<Eigen::Lower>();  // all that counts
  EXPECT_LE((Cholesky(lower).solve(
                 VectorXd(MatrixXd(lower.selfadjointView<Eigen::Lower>()) * VectorXd::Ones(40))) -
             VectorXd::Ones(40))
                .norm(),
            1e-10);
  EXPECT_FALSE(Cholesky(MatrixXd::Zero(2, 2)).is_definite());
  EXPECT_TRUE(Cholesky().is_definite());
  EXPECT_EQ(inverse_condition(-definite(5)), 0);
  EXPECT_FALSE(solve(MatrixXd::Zero(3, 3), VectorXd::Ones(3)).allFinite());
}

TEST_F(Decompositions, OfAllLeastSquaresTheShortestIsFound) {
  const MatrixXd a = random(7, 3) * random(3, 5);
  const VectorXd b = random(7, 1), x = least_squares(a, b);
  EXPECT_LE((a.transpose() * (a * x - b)).norm(), 1e-12);
  // Nothing along what `a` annihilates.
  const MatrixXd rows = a.transpose();
  EXPECT_LE((rows * least_squares(rows, x) - x).norm(), 1e-12 * x.norm());
}

TEST_F(Decompositions, RowsThatDependOnOthersDoNotCount) {
  EXPECT_EQ(rank(random(7, 3) * random(3, 5), 1e-9), 3);
  EXPECT_EQ(rank(MatrixXd::Zero(4, 2), 1e-9), 0);
  EXPECT_EQ(rank(MatrixXd(0, 2), 1e-9), 0);
  EXPECT_EQ(rank((MatrixXd(2, 2) << 1, 0, 0, 1e-12).finished(), 1e-9), 1);
}

}  // namespace
}  // namespace tourmaline::dense
