#pragma once

#include <vector>

#include "body/discretisation.h"
#include "krylov/petsc.h"

namespace tourmaline::krylov {

/// The rows of a matrix that PETSc shares out to the ranks, in blocks of a node's unknowns. The
/// blocks of the nodes that belong to a rank stand together.
class NodeRows {
 public:
  /// All ranks together. `sharing` outlives this.
  explicit NodeRows(const body::NodeSharing &sharing);

  const body::NodeSharing &sharing() const { return sharing_; }
  PetscInt n_all() const { return static_cast<PetscInt>(sharing_.n_all()); }
  PetscInt of(body::Node node) const { return row_of_[node]; }  ///< number of the node's block

  PetscInt n_own() const { return static_cast<PetscInt>(own_.size()); }  ///< nodes of this rank
  /// `row`: of this rank's blocks, from 0.
  body::Node own_node(PetscInt row) const { return own_[row]; }

  /// Rows of `count` unknowns from `first` on, of this rank's nodes, `n_unknowns` each. To be
  /// destroyed by the caller.
  IS own(int n_unknowns, int first, int count) const;

 private:
  const body::NodeSharing &sharing_;
  std::vector<PetscInt> row_of_;  // by node
  std::vector<body::Node> own_;   // by row of this rank
  PetscInt begin_ = 0;            // of these rows
};

}  // namespace tourmaline::krylov
