#include "krylov/node_rows.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "parallel/ranks.h"

namespace tourmaline::krylov {

using body::Node;

// Rows are known to the owners first.
NodeRows::NodeRows(const body::NodeSharing &sharing)
    : sharing_(sharing), row_of_(sharing.n_nodes()) {
  for (Node node = 0; node < sharing.n_nodes(); ++node)
    if (sharing.is_own(node))
      own_.push_back(node);
  const std::vector<std::uint32_t> counts =
      parallel::joined(std::vector{static_cast<std::uint32_t>(own_.size())});
  begin_ = static_cast<PetscInt>(
      std::accumulate(counts.begin(), counts.begin() + parallel::rank(), std::uint32_t{0}));
  std::vector<double> rows(row_of_.size(), 0.);
  for (std::size_t i = 0; i < own_.size(); ++i)
    rows[own_[i]] = begin_ + static_cast<double>(i);
  sharing.take_from_owners(rows);
  std::transform(rows.begin(), rows.end(), row_of_.begin(),
                 [](double row) { return static_cast<PetscInt>(row); });
}

IS NodeRows::own(int n_unknowns, int first, int count) const {
  std::vector<PetscInt> rows;
  for (PetscInt row = begin_; row < begin_ + n_own(); ++row)
    for (int c = 0; c < count; ++c)
      rows.push_back(n_unknowns * row + first + c);
  IS set = nullptr;
  check(ISCreateGeneral(PETSC_COMM_WORLD, static_cast<PetscInt>(rows.size()), rows.data(),
                        PETSC_COPY_VALUES, &set));
  check(ISSetBlockSize(set, count));
  return set;
}

}  // namespace tourmaline::krylov
