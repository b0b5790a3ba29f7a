#pragma once

#include <petscmat.h>

#include <memory>
#include <vector>

#include "krylov/block_rows.h"

namespace tourmaline::krylov {

/// Products with a copy by blocks of a matrix (SeqAIJ or MPIAIJ). Each rank has its rows: a part
/// with its own columns and one with those of others.
class BlockProduct {
 public:
  explicit BlockProduct(Mat matrix);
  ~BlockProduct();
  BlockProduct(const BlockProduct &) = delete;
  BlockProduct &operator=(const BlockProduct &) = delete;

  /// Reads some of this rank's rows of blocks anew; `row`, from 0, is the first one of a block. Of
  /// the same matrix, whose pattern is what it was.
  void read_again(const std::vector<PetscInt> &rows);

  /// A matrix of PETSc whose product this is; not to be used when this is gone.
  Mat shell() const { return shell_; }

 private:
  static PetscErrorCode multiply(Mat shell, Vec x, Vec y);
  void multiply(Vec x, Vec y);
  void split();
  void make_shell();

  Mat matrix_, shell_ = nullptr;
  PetscInt block_size_ = 1;
  std::unique_ptr<BlockRows> own_, others_;  // the second on several ranks
  Vec ghosts_ = nullptr;                     // what the others' columns are multiplied by
  VecScatter fetch_ = nullptr;
};

}  // namespace tourmaline::krylov
