#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "output/checkpoint.h"
#include "solve/anderson.h"
#include "solve/exchange_nodes.h"
#include "solve/model.h"
#include "solve/route.h"
#include "solve/stall.h"

namespace tourmaline::solve {

/// What crosses the contact by its state, for routes that solve a step with it held: at each site
/// the body's equations are K x = b + slope x + rest in its unknown theta or phi, exact in that
/// where the law is linear in it, at the contact's state of the round before. A fixed point, with
/// Anderson's acceleration.
template <int dim>
class HeldExchanges {
 public:
  /// `model` outlives this.
  explicit HeldExchanges(const Model<dim> &model);

  /// Whether nothing is held: rounds are not needed.
  bool is_empty() const { return nodes_.size() == 0; }
  const std::vector<ExchangeSite> &sites() const { return nodes_.sites(); }

  /// The step that ends at `time`; `state` holds the prescribed values. What crosses is first held
  /// as it was in the last round of the last step.
  void begin_step(double time, std::span<const double> state);
  /// By site [of the body's rows, per K or V].
  const Eigen::VectorXd &slopes() const { return slope_; }
  /// Adds to b.
  void add_rests(std::span<double> right_side) const;

  /// Takes what was found with these; true where it asks for no others: rows that differ by no more
  /// than `tolerance` times the largest sum of terms of a row at the contact, in either field, or
  /// by round-off that no round takes away. Throws SolveError after many rounds.
  bool settle(double time, std::span<const double> state, const StateAtNode &state_at,
              double tolerance);

  /// What has crossed.
  void end_step(std::span<const double> state, const StateAtNode &state_at, StepOutcome &outcome);
  void take_back() { nodes_.take_back(); }
  /// Adds that to b.
  void add_flows(const StepOutcome &outcome, std::span<double> right_side) const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  void ask(std::span<const double> state, const StateAtNode &state_at);
  double lack(std::span<const double> state) const;
  void mix();

  const Model<dim> &model_;
  ExchangeNodes<dim> nodes_;
  Eigen::VectorXd slope_, rest_, asked_slope_, asked_rest_;
  bool is_new_ = true;  // nothing has been held yet
  // Of the step at hand:
  Anderson anderson_;
  Stall stall_;
  int rounds_ = 0;
  double size_ = 0;  // of an entry of theta or phi
};

}  // namespace tourmaline::solve
