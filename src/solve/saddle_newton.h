#pragma once

#include <array>

#include "solve/saddle_system.h"

namespace tourmaline::solve {

/// Residuals of the blocks of (37), each over its own size, or a thousandth of that where the step
/// began if this is more, as round-off of what was does not go when all else does: the body's rows
/// by their largest sum of terms, u_nu of bilateral contact by the largest displacement, and the
/// laws, w |lambda - P(lambda + r y)| with the stiffness of a node for r, each by the size of the
/// mechanical rows around its point.
struct Verdict {
  static constexpr std::array names{"the balance of forces (31)", "the balance of charges (32)",
                                    "the balance of heat (33)", "the normal displacement (34)",
                                    "the contact law (35)"};
  std::array<double, 5> blocks{};
  double force_size = 0;  ///< of the mechanical rows [N]

  double body() const;
  double without_law() const;
  double worst() const;
  const char *worst_name() const;
};

struct SaddleSettings {
  double tolerance = 1e-12;  ///< of `Verdict::worst`
  int max_iterations = 100;
  int least_iterations = 0;  ///< also where the start is within the tolerance
};

/// Newton's method (43), (44) for one step, from the prediction. Its tangent jumps where points
/// begin to stick or slip, so it may cycle; then steps of the method of multipliers on the same
/// augmented Lagrangian, which alone, with exact minimisations, converge from any start, move
/// lambda_tau towards the solution, until Newton's method settles.
///
/// In a body that bends easily the forces inside are larger by many powers of ten than those that
/// act on it, and a residual within the tolerance of the former may be all of the latter: Newton's
/// method then goes on as long as it gains.
template <int dim>
class SaddleNewton {
 public:
  /// `data.laws` hold the law of this step; all arguments outlive the iteration.
  SaddleNewton(SaddleSystem<dim> &system, const StepData &data, SaddlePoint prediction);

  /// False when it has not converged in `max_iterations`.
  bool solve(const SaddleSettings &settings);

  const SaddlePoint &x() const { return x_; }
  int iterations() const { return iterations_; }  ///< linear systems assembled, factorised, solved
  Verdict verdict() const { return judge(data_); }
  /// w |lambda_tau - P(lambda_tau + r d)| [N].
  double law_residual(std::size_t point) const;

 private:
  bool newton(const SaddleSettings &settings);
  bool is_polished(const Verdict &now) const;
  void multiplier_step(const SaddleSettings &settings);
  std::vector<contact::AugmentedLagrangian> laws_with_held_multipliers() const;
  SaddlePoint direction(const StepData &data, const SaddlePoint &residual);
  double length(const StepData &data, const SaddlePoint &residual,
                const SaddlePoint &direction) const;
  double contact_power(const StepData &data, const SaddlePoint &direction, double length) const;
  void correct(const SaddlePoint &increment, double length);
  Verdict judge(const StepData &data) const;

  SaddleSystem<dim> &system_;
  const StepData data_;
  SaddlePoint x_;
  std::array<double, 3> least_sizes_{};  // of rows, by field
  double least_displacement_ = 0;
  int iterations_ = 0;
};

}  // namespace tourmaline::solve
