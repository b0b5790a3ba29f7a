#pragma once

#include <array>
#include <span>
#include <vector>

#include "output/checkpoint.h"
#include "solve/model.h"
#include "solve/rate_record.h"
#include "solve/start_of_motion.h"

namespace tourmaline::solve {

/// Velocity and acceleration of u from step to step, and what they add to a step. With
/// d = u_n - u_(n-1) Newmark's scheme with 1/4 and 1/2 is
///
///     v_n = 2 d / k - v_(n-1),    a_n = 4 (d / k - v_(n-1)) / k - a_(n-1),
///
/// and equilibrium holds at the end of the step, M a_n + C_1 v_n + C_2 d/k + K u_n = f_n
/// (`body::RateForces`). Times d, in the mean of both ends, it is the balance of energy: what M and
/// C_1 take is the kinetic energy gained and k v.C_1 v of the mean velocity, exactly. Nodes without
/// mass have the velocity d / k and no acceleration. In the quasistatic regime only C_2 is there.
///
/// Where u is prescribed this recursion would swing for ever after a kink. There the rates are
/// central differences of the formula, v_n = (u_(n+1) - u_(n-1)) / 2k, a_n = (u_(n+1) - 2 u_n +
/// u_(n-1)) / k^2, which a kink touches in one step. What the mean of both ends then makes too much
/// of T adds up to nothing, m k^2 (a_(n-1)^2 - a_n^2) / 8 with equal steps, and is told as lost.
template <int dim>
class Motion {
 public:
  /// `model` outlives this. Nothing is resisted: it does nothing.
  explicit Motion(const Model<dim> &model);

  /// From the initial state, which is settled in the dynamic regime (`settle`); acceleration from
  /// the equilibrium of what has mass. On all ranks.
  void begin(std::span<const double> state);
  /// What the step from `before` to `time` knows of the motion; `now` has its prescribed values.
  void add_history(double time, std::span<const double> before, std::span<const double> now,
                   std::vector<double> &right_side);
  /// The step to `now` is done. On all ranks.
  void end_step(std::span<const double> before, std::span<const double> now);
  /// Of that step, or of the start.
  const RateRecord &record() const { return record_; }
  bool is_inertial() const { return forces_ && forces_->is_dynamic(); }

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  // By unknown, zero but for displacements: rates, and their products with M, C_1 and C_2.
  struct Rates {
    std::vector<double> velocity, acceleration, difference;  // the last is d / k
    std::vector<double> momentum, inertia, damping, backward_damping;
  };
  void multiply(Rates &rates) const;
  void describe(const Rates &now);
  void find_given(double time);
  void add_energies(const Rates &next, std::span<const double> d);
  double lost_at_supports(const Rates &next, std::span<const double> d) const;

  const Model<dim> &model_;
  const body::RateForces<dim> *forces_;
  // Prescribed displacements that move in time, of nodes with mass, and their rates at the end of
  // the step at hand.
  struct Given {
    const body::Prescribed *of;
    PrescribedRates rates;
  };
  std::vector<Given> given_;
  Rates rates_;
  RateRecord record_;
};

}  // namespace tourmaline::solve
