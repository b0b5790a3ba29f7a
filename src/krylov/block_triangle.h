#pragma once

#include <petscksp.h>

#include <array>

namespace tourmaline::krylov {

/// A preconditioner that solves by the diagonal blocks of a matrix in turn, each with what those
/// before it have found: by its lower block triangle. Of the matrix itself it keeps nothing but
/// the blocks of that triangle.
class BlockTriangle {
 public:
  static constexpr int n_blocks = 3;
  struct Block {
    const char *name = nullptr;  ///< options of its solver begin with this and "_"
    IS own = nullptr;            ///< this rank's rows, destroyed with the object
  };

  BlockTriangle(Mat matrix, const std::array<Block, n_blocks> &blocks);
  ~BlockTriangle();
  BlockTriangle(const BlockTriangle &) = delete;
  BlockTriangle &operator=(const BlockTriangle &) = delete;

  /// Makes it what `solver` preconditions with; it outlives the solver.
  void attach_to(KSP solver);

  Mat diagonal(int block) const { return diagonal_[block]; }
  /// Solves with the diagonal block; to be set up by the caller.
  KSP solver(int block) const { return solvers_[block]; }

 private:
  static PetscErrorCode apply(PC preconditioner, Vec right_side, Vec found);
  void apply(Vec right_side, Vec found);

  std::array<Block, n_blocks> blocks_;
  std::array<Mat, n_blocks> diagonal_{};
  std::array<std::array<Mat, n_blocks>, n_blocks> below_{};  // by row and column
  std::array<KSP, n_blocks> solvers_{};
  std::array<Vec, n_blocks> right_sides_{}, products_{}, found_{};
};

}  // namespace tourmaline::krylov
