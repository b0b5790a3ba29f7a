#pragma once

#include <array>
#include <span>
#include <vector>

#include "condensation/elimination.h"
#include "condensation/factorisation.h"
#include "condensation/pages.h"
#include "condensation/trapezoid.h"
#include "parallel/team.h"

namespace tourmaline::condensation {

/// Thrown where a pivot has not the sign of its entry on the diagonal, or no digit is left of it.
struct WeakPivot {
  int variable;
};

/// L S L^T with signs S of a symmetric quasi-definite matrix by the multifrontal method, without
/// pivoting: such a factorisation exists for every order of elimination (Vanderbei, SIAM J. Optim.
/// 5, 1995), so the tree of fronts and all memory are known before the first number. Threads work
/// on subtrees of their own, then together on the large fronts at the root; a front's numbers do
/// not depend on who computes them, so their number changes no bit.
class Multifrontal : public Factorisation {
 public:
  /// `schur`: the variables of the groups that are kept, in the order of S. Throws WeakPivot,
  /// MachineError.
  Multifrontal(const GroupedMatrix &matrix, const std::vector<int> &schur, int threads);

  const std::vector<double> &schur_complement() const override { return schur_complement_; }
  const FactorisationStatistics &statistics() const override { return statistics_; }
  std::vector<double> reduce(std::vector<double> &right_side) override;
  void expand(std::span<const double> interface) override;

 private:
  class Work;
  friend class Work;
  struct Subtree {
    int first, root;  // fronts first ... root
  };

  void plan();
  void share_out();
  std::array<std::size_t, 2> stacks(std::span<const int> fronts) const;
  Trapezoid panels(int front) const;
  void factorise(const GroupedMatrix &matrix);
  void require_memory(std::size_t doubles) const;
  void take_schur_complement(const Trapezoid &rest);
  template <typename Task>
  void for_each_subtree(const Task &task);
  void forward(int front, double *work, parallel::Team &team);
  void backward(int front, double *work, parallel::Team &team);

  Elimination elimination_;
  parallel::Team team_, alone_{1};
  std::vector<int> schur_;
  std::vector<Subtree> subtrees_;         // of one thread each
  std::vector<int> top_;                  // the fronts above them
  std::vector<std::size_t> panels_;       // by front, where they begin in the factor
  std::vector<char> stack_, is_subtree_;  // by front
  std::vector<int> front_of_;             // by group
  std::size_t factor_size_ = 0;
  std::size_t beside_ = 0;  // the most that a front takes beside its panels
  Pages factor_;
  std::vector<double> schur_complement_;
  FactorisationStatistics statistics_;
  std::vector<double> x_;                  // by place
  std::vector<double> handed_;             // by row below a front
  std::vector<std::vector<double>> work_;  // by member of the team, of a front's height
  std::vector<double> *right_side_ = nullptr;
};

}  // namespace tourmaline::condensation
