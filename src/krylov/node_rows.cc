#include "krylov/node_rows.h"

#include <algorithm>
#include <numeric>

#include "parallel/ranks.h"

namespace tourmaline::krylov {

using body::Node;

NodeRows::NodeRows(const body::NodeGraph &graph)
    : row_of_(graph.n_nodes()), rank_of_(graph.n_nodes()), node_of_(graph.n_nodes()) {
  std::vector<double> closeness(graph.n_nodes(), -parallel::n_ranks());  // the largest wins
  for (Node i = 0; i < graph.n_nodes(); ++i)
    if (graph.row[i] != graph.row[i + std::size_t{1}])
      closeness[i] = -parallel::rank();
  parallel::largest(closeness);
  std::iota(node_of_.begin(), node_of_.end(), Node{0});
  std::stable_sort(node_of_.begin(), node_of_.end(),
                   [&](Node a, Node b) { return closeness[a] > closeness[b]; });
  for (std::size_t row = 0; row < node_of_.size(); ++row) {
    row_of_[node_of_[row]] = static_cast<PetscInt>(row);
    rank_of_[node_of_[row]] = static_cast<int>(-closeness[node_of_[row]]);
    begin_ += closeness[node_of_[row]] > -parallel::rank();
    end_ += closeness[node_of_[row]] >= -parallel::rank();
  }
}

IS NodeRows::own(int n_unknowns, int first, int count) const {
  std::vector<PetscInt> rows;
  for (PetscInt row = begin_; row < end_; ++row)
    for (int c = 0; c < count; ++c)
      rows.push_back(n_unknowns * row + first + c);
  IS set = nullptr;
  check(ISCreateGeneral(PETSC_COMM_WORLD, static_cast<PetscInt>(rows.size()), rows.data(),
                        PETSC_COPY_VALUES, &set));
  check(ISSetBlockSize(set, count));
  return set;
}

}  // namespace tourmaline::krylov
