#pragma once

#include <vector>

#include "body/discretisation.h"
#include "krylov/petsc.h"

namespace tourmaline::krylov {

/// The rows of a matrix that PETSc shares out to the ranks, in blocks of a node's unknowns. A node
/// belongs to the first rank whose cells touch it; the blocks of a rank's nodes stand together.
class NodeRows {
 public:
  /// `graph`: of this rank's cells. All ranks together.
  explicit NodeRows(const body::NodeGraph &graph);

  std::size_t n_all() const { return node_of_.size(); }
  PetscInt of(body::Node node) const { return row_of_[node]; }  ///< number of the node's block
  body::Node node(std::size_t row) const { return node_of_[row]; }

  PetscInt n_own() const { return end_ - begin_; }  ///< nodes of this rank
  /// `row`: of this rank's blocks, from 0.
  body::Node own_node(PetscInt row) const { return node_of_[begin_ + row]; }
  int rank_of(body::Node node) const { return rank_of_[node]; }
  bool owns(body::Node node) const { return begin_ <= row_of_[node] && row_of_[node] < end_; }

  /// Rows of `count` unknowns from `first` on, of this rank's nodes, `n_unknowns` each. To be
  /// destroyed by the caller.
  IS own(int n_unknowns, int first, int count) const;

 private:
  std::vector<PetscInt> row_of_;     // by node
  std::vector<int> rank_of_;         // likewise
  std::vector<body::Node> node_of_;  // by row
  PetscInt begin_ = 0, end_ = 0;     // of this rank
};

}  // namespace tourmaline::krylov
