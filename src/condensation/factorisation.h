#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "condensation/symmetric_matrix.h"

namespace tourmaline::condensation {

/// What MUMPS tells about a factorisation.
struct FactorisationStatistics {
  double analyse_seconds = 0, factorise_seconds = 0;
  long long factor_entries = 0;  ///< doubles in L, the Schur complement apart
  int negative_pivots = 0;
  double flops = 0;
};

/// L D L^T without pivoting (MUMPS, SYM = 1) of a symmetric quasi-definite matrix K, with the Schur
/// complement S of its last-eliminated variables c:
///
///     K = [K_ii K_ic; K_ci K_cc],   S = K_cc - K_ci K_ii^-1 K_ic
///
/// `reduce` is the forward substitution, s = b_c - K_ci K_ii^-1 b_i; `expand` the backward one, x_i
/// from x_c. Every `expand` belongs to the `reduce` before it. Needs MPI to be initialised; on
/// several ranks the factor is distributed, right-hand sides and solutions are whole on every rank.
class Factorisation {
 public:
  /// `position[v]`: place of variable v (from 0) in the order of elimination; the variables `schur`
  /// (from 0) must come last, in this order. Throws SolveError when a pivot vanishes, MachineError
  /// when the memory does not suffice.
  Factorisation(SymmetricMatrix matrix, const std::vector<int> &position,
                const std::vector<int> &schur, int threads);
  ~Factorisation();
  Factorisation(const Factorisation &) = delete;
  Factorisation &operator=(const Factorisation &) = delete;

  /// Column-major, symmetric, both triangles filled; schur.size() squared, on the first rank.
  const std::vector<double> &schur_complement() const;
  const FactorisationStatistics &statistics() const;

  /// `right_side` is overwritten (by the solution, after `expand`); returns s.
  std::vector<double> reduce(std::vector<double> &right_side);
  /// `interface` holds x_c; fills `right_side` of the last `reduce` with the solution.
  void expand(std::span<const double> interface);

 private:
  struct Instance;
  std::unique_ptr<Instance> instance_;
};

}  // namespace tourmaline::condensation
