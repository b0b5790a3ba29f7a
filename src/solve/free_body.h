#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solve/exchange_nodes.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// The body with most of its unknowns held: what the others answer, by the matrix K of a step.
/// Vectors are by unknown of this rank [SI].
template <int dim>
class FreeBody {
 public:
  virtual ~FreeBody() = default;

  /// Changes the free entries x of `state` by what solves (K - D) dx = lacks in their rows, with D
  /// the `slopes` of what crosses at the sites. All ranks together. Throws SolveError.
  virtual void answer(std::span<const double> lacks, const std::vector<double> &slopes,
                      std::vector<double> &state) = 0;
};

/// `sites`: potentials, all of which are free. Of displacements those of contact nodes alone may
/// be. By a factorisation, or iteratively without one. `model` outlives this. Null: nothing is
/// free.
template <int dim>
std::unique_ptr<FreeBody<dim>> free_body(const Model<dim> &model, const std::vector<bool> &is_free,
                                         const std::vector<ExchangeSite> &sites, bool iteratively);

}  // namespace tourmaline::solve
