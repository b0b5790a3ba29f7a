#pragma once

#include <memory>
#include <span>
#include <vector>

#include "condensation/condensed_body.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// The temperature of a static case: heat flows steadily,
///
///     G theta = q,
///
/// with conduction and exchange G and the heat sources q of the load level, whatever u and phi are.
/// So it is known before a step is solved, whose unknowns u and phi then have it prescribed
/// everywhere. A body that neither a prescribed temperature nor an exchange holds has no such
/// temperature of its own; it keeps its initial one, where that is uniform and nothing warms it.
template <int dim>
class SteadyHeat {
 public:
  /// `model`, a static case's, outlives this. Iteratively without a factorisation. Throws CaseError
  /// where a body that nothing holds is not uniform at the start.
  SteadyHeat(const Model<dim> &model, bool iteratively);

  /// Sets the temperatures of `state`. Collective. Throws CaseError where a body that nothing holds
  /// is warmed, SolveError where the iteration does not converge.
  void fill(double time, std::span<double> state);

 private:
  static constexpr int n = body::Fields<dim>::count;
  static std::size_t theta(body::Node node) {
    return body::unknown<dim>(node, body::Fields<dim>::temperature);
  }

  bool is_held() const;
  void keep_initial();
  void require_unwarmed(double time, const std::vector<double> &heat) const;
  std::vector<double> heat_at(double time) const;
  void iterate(double time, const std::vector<double> &heat, std::vector<double> &x) const;

  const Model<dim> &model_;
  std::vector<double> diagonal_;        // of G, by node [W/K]
  double step_;                         // so long that no heat is stored [s]
  bool keeps_initial_ = false;          // as nothing holds it
  std::vector<body::Prescribed> held_;  // temperatures that are given, or kept
  std::vector<bool> is_free_;           // by node: theta is to be found
  std::unique_ptr<condensation::CondensedBody<dim>> factorised_;
};

}  // namespace tourmaline::solve
