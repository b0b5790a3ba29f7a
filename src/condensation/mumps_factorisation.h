#pragma once

#include <memory>
#include <span>
#include <vector>

#include "condensation/factorisation.h"
#include "condensation/symmetric_matrix.h"

namespace tourmaline::condensation {

/// By MUMPS, SYM = 1. Needs MPI to be initialised; on several ranks the factor is distributed,
/// right-hand sides and solutions are whole on every rank.
class MumpsFactorisation : public Factorisation {
 public:
  /// `position[v]`: place of variable v (from 0) in the order of elimination; the variables `schur`
  /// (from 0) must come last, in this order. Throws SolveError when a pivot vanishes, MachineError
  /// when the memory does not suffice.
  MumpsFactorisation(SymmetricMatrix matrix, const std::vector<int> &position,
                     const std::vector<int> &schur, int threads);
  ~MumpsFactorisation() override;

  const std::vector<double> &schur_complement() const override;
  const FactorisationStatistics &statistics() const override;
  /// Why MUMPS, where another was asked first.
  void set_reason(std::string reason);
  std::vector<double> reduce(std::vector<double> &right_side) override;
  void expand(std::span<const double> interface) override;

 private:
  struct Instance;
  std::unique_ptr<Instance> instance_;
};

}  // namespace tourmaline::condensation
