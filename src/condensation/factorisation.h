#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tourmaline::condensation {

/// What is known of a factorisation.
struct FactorisationStatistics {
  double analyse_seconds = 0, factorise_seconds = 0;
  long long factor_entries = 0;  ///< doubles in L, the Schur complement apart
  int negative_pivots = 0;
  double flops = 0;
  int subtrees = 0;    ///< of the tree of fronts, each of one thread; 0 where there is one thread
  std::string solver;  ///< "own" or "mumps"
  std::string reason;  ///< why that one, where another was asked first
};

/// L D L^T without pivoting of a symmetric quasi-definite matrix K, with the Schur complement S of
/// its last-eliminated variables c:
///
///     K = [K_ii K_ic; K_ci K_cc],   S = K_cc - K_ci K_ii^-1 K_ic
///
/// `reduce` is the forward substitution, s = b_c - K_ci K_ii^-1 b_i; `expand` the backward one, x_i
/// from x_c. Every `expand` belongs to the `reduce` before it.
class Factorisation {
 public:
  Factorisation() = default;
  virtual ~Factorisation() = default;
  Factorisation(const Factorisation &) = delete;
  Factorisation &operator=(const Factorisation &) = delete;

  /// Column-major, symmetric, both triangles filled, on the first rank.
  virtual const std::vector<double> &schur_complement() const = 0;
  virtual const FactorisationStatistics &statistics() const = 0;

  /// `right_side` is overwritten (by the solution, after `expand`); returns s.
  virtual std::vector<double> reduce(std::vector<double> &right_side) = 0;
  /// `interface` holds x_c; fills `right_side` of the last `reduce` with the solution.
  virtual void expand(std::span<const double> interface) = 0;
};

}  // namespace tourmaline::condensation
