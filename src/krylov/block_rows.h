#pragma once

#include <petscmat.h>

#include <vector>

namespace tourmaline::krylov {

/// A sparse matrix by rows of square blocks, of which a product reads nothing but the entries and
/// one number for each block.
class BlockRows {
 public:
  /// Of a matrix on one rank (SeqAIJ); blocks of 2, 3 and 6 are kept as such, else single entries.
  explicit BlockRows(Mat matrix, PetscInt block_size);

  /// y += A x. `x` and `y` have as many numbers as the matrix has columns and rows.
  void add_product(const double *x, double *y) const;

 private:
  void put_columns(Mat matrix, PetscInt row);
  void put_entries(Mat matrix, PetscInt row);

  int size_;                              // of a block
  std::vector<PetscInt> first_, column_;  // in blocks
  // Block by block, each by its columns. Behind the last are some that are read along with it.
  std::vector<double> entries_;
};

}  // namespace tourmaline::krylov
