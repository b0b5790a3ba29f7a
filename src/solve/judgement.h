#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "output/checkpoint.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// What to try where round-off decides the solution.
extern const char *const ill_conditioned_advice;

/// Judges each step by its balances and by the estimated forward error of its solution: above 1e-6
/// the run ends with a warning; above 0.1, where not one digit is certain, it fails. Of a body that
/// nothing but contact holds it fails sooner where forces do not balance: the body slides or
/// leaves, as far as round-off of its stiffness lets it.
class Judgement {
 public:
  Judgement() = default;
  /// `left_to_contact`: the motions that nothing but contact keeps the body from; empty: none.
  explicit Judgement(std::string left_to_contact) : left_to_contact_(std::move(left_to_contact)) {}

  /// `imbalances` by name, none of them an imbalance of round-off alone; `measure` tells how far
  /// the solution of a step that looks wrong can be trusted. Throws SolveError.
  void step(int n, double time, const std::vector<std::pair<std::string, double>> &imbalances,
            const std::function<Accuracy()> &measure);
  /// `forward_error` is that of the run so far, NaN where nothing is known. Throws SolveError.
  void forward_error(int n, double time, const Accuracy &accuracy);

  std::vector<std::string> warnings() const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  struct Worst {
    double value = 0, step = 0, time = 0;
  };
  static constexpr std::array names{"energy_imbalance", "force_imbalance", "charge_imbalance",
                                    "heat_imbalance"};

  void require_held(int n, double time, const std::string &name, double lacks) const;

  std::string left_to_contact_;
  std::array<Worst, 4> worst_;  // of the balances, by name
  Worst error_;                 // the forward error
};

}  // namespace tourmaline::solve
