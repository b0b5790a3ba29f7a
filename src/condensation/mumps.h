#pragma once

#include <dmumps_c.h>

#include <string>
#include <vector>

#include "condensation/factorisation.h"
#include "condensation/symmetric_matrix.h"

namespace tourmaline::condensation {

/// A symmetric matrix in MUMPS: its entries from all ranks, our ordering, and the settings that
/// both factorisations share. Errors of MUMPS become SolveError and MachineError.
class Mumps {
 public:
  enum class Job : int { initialise = -1, finish = -2, analyse = 1, factorise = 2, solve = 3 };
  enum class Pivoting : int { none = 1, symmetric = 2 };  ///< SYM of MUMPS
  /// For the texts of errors: what the matrix is, and what to do when the memory does not suffice.
  struct Advice {
    std::string matrix, memory;
  };

  /// `position[v]`: place of variable v (from 0) in the order of elimination; the last `kept` are
  /// not eliminated. MUMPS wants one that is: where there is none, it gets one of its own, which
  /// has nothing to do with the others.
  Mumps(SymmetricMatrix matrix, const std::vector<int> &position, std::size_t kept,
        Pivoting pivoting, int threads, Advice advice);
  ~Mumps();
  Mumps(const Mumps &) = delete;
  Mumps &operator=(const Mumps &) = delete;

  void call(Job job);
  void analyse();
  /// Pivoting, if any, makes the factor larger than the analysis foresees, by an amount that nobody
  /// knows: where its space does not suffice, it is tried again with more.
  void factorise();
  void release_entries();  ///< once no other factorisation follows
  /// One right-hand side, which `Job::solve` overwrites by the solution; a variable of MUMPS's own
  /// is added to it.
  void set_right_side(std::vector<double> &right_side);

  int &icntl(int i) { return data.icntl[i - 1]; }  ///< numbered as in MUMPS's guide
  int infog(int i) const { return data.infog[i - 1]; }

  DMUMPS_STRUC_C data{};
  SymmetricMatrix matrix;
  FactorisationStatistics statistics;

 private:
  int attempt(Job job);
  void check() const;
  void set_controls(int threads);
  void add_pivot();
  void set_matrix();

  std::vector<int> position_;  // from 1
  Advice advice_;
};

}  // namespace tourmaline::condensation
