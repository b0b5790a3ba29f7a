#pragma once

#include <memory>
#include <vector>

#include "condensation/factorisation.h"
#include "condensation/symmetric_matrix.h"

namespace tourmaline::condensation {

/// L D L^T with pivoting (MUMPS, SYM = 2) of symmetric matrices of one pattern: analysed once,
/// factorised as often as their values change. Pivoting makes it fit for saddle points, whose
/// multipliers have zeros on the diagonal. Needs MPI to be initialised.
class SaddleFactorisation {
 public:
  /// `matrix` gives the pattern; entries at equal places are added. `position[v]`: place of
  /// variable v (from 0) in the order of elimination; a multiplier does best behind the unknowns
  /// that it acts on.
  SaddleFactorisation(SymmetricMatrix matrix, const std::vector<int> &position, int threads);
  ~SaddleFactorisation();
  SaddleFactorisation(const SaddleFactorisation &) = delete;
  SaddleFactorisation &operator=(const SaddleFactorisation &) = delete;

  /// The values of the matrix, in the order of its pattern.
  std::vector<double> &values();

  /// Factorises the matrix with its present values. Throws SolveError when it is singular,
  /// MachineError when the memory does not suffice.
  void factorise();

  /// Overwrites the right-hand side by the solution of the last factorised matrix.
  void solve(std::vector<double> &right_side);

  int count() const;  ///< factorisations so far
  /// Analysis; all factorisations' seconds; the last one's size, pivots and operations.
  const FactorisationStatistics &statistics() const;

 private:
  struct Instance;
  std::unique_ptr<Instance> instance_;
};

}  // namespace tourmaline::condensation
