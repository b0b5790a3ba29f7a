#pragma once

#include <petscksp.h>

#include <memory>
#include <vector>

#include "krylov/block_product.h"

namespace tourmaline::krylov {

/// A multigrid of PETSc's whose finest matrix A changes by D, in few rows and columns: its coarse
/// matrices are P^T A P + P^T D P of one product P^T A P and as many P^T D P as there are changes.
/// It smooths and takes residuals with copies of its matrices by blocks: an application is mostly
/// the time of these products. On all levels the matrices depend on A and the last D alone.
class FollowingMultigrid {
 public:
  /// `solver` has a multigrid preconditioner (PCMG, or what is built on it) and is set up with A.
  /// `change` has the pattern of every D, and its rows are shared out as those of A.
  FollowingMultigrid(KSP solver, Mat change);
  ~FollowingMultigrid();
  FollowingMultigrid(const FollowingMultigrid &) = delete;
  FollowingMultigrid &operator=(const FollowingMultigrid &) = delete;

  /// Of the finest level, for the caller to set.
  Mat change() const { return levels_.front().change; }
  /// Takes A + D, with D as it is now, to all levels, and sets up their solvers.
  void follow();

 private:
  struct Level {
    KSP solver = nullptr;         // smoother, or the coarsest level's solver
    Mat matrix = nullptr;         // these two are the multigrid's
    Mat interpolation = nullptr;  // from the next coarser level; none on the coarsest
    Mat change = nullptr;
    std::vector<PetscInt> rows;             // of this rank that changes reach
    std::vector<PetscScalar> without;       // entries there of A, by row as `change` has them
    std::unique_ptr<BlockProduct> product;  // none on the coarsest
  };

  void note(Level &level);
  static void put_change(Level &level);
  static void smooth(Level &level);

  std::vector<Level> levels_;  // from the finest on
};

}  // namespace tourmaline::krylov
