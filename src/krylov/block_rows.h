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

  /// Takes the entries of the row of blocks that begins with this row of the matrix, whose pattern
  /// is what it was. With single entries every row is such.
  void read_again(Mat matrix, PetscInt row);

  /// y += A x. `x` and `y` have as many numbers as the matrix has columns and rows.
  void add_product(const double *x, double *y) const;

 private:
  void put_columns(Mat matrix, PetscInt row);

  int size_;                              // of a block
  std::vector<PetscInt> first_, column_;  // in blocks
  // Block by block, each by its columns. Behind the last are some that are read along with it.
  std::vector<double> entries_;
};

}  // namespace tourmaline::krylov
