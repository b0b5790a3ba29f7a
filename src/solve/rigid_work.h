#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "case/free_modes.h"
#include "solve/model.h"
#include "tourmaline/contact_status.h"
#include "tourmaline/vector.h"

namespace tourmaline::solve {

/// What forces on the body do along rigid motions: nothing, in equilibrium, where nothing else
/// resists these.
class RigidWork {
 public:
  /// The imbalance from where on forces do not balance: loads may be given, and solutions found, to
  /// no more digits.
  static constexpr double unbalanced = 1e-5;
  /// The `beside` of loads alone, whose sums have round-off, and of loads with the forces of a
  /// solution, which are known to so many digits of the largest.
  static constexpr double summed = 1e-9, uncertain = 1e-3;

  /// Along the motions that nothing but the contact resists, and of it only what can let go.
  template <int dim>
  static RigidWork left_to_contact(const Model<dim> &model);
  explicit RigidWork(std::vector<casefile::RigidMotion> motions);

  /// The imbalance that solutions may have, which need not be known to more digits than were asked
  /// for. `is_far`: the body has moved so far that round-off of its stiffness balances a load.
  static double allowed(const casefile::SolverCase &asked, bool is_far);

  /// The force's first `size` components, in N, at a point.
  void add(const Vector3 &point, const double *force, int size);
  /// `loads` by unknown, of all ranks.
  template <int dim>
  void add_loads(const Model<dim> &model, std::span<const double> loads);
  /// `forces` at the interface, `dim` of each node.
  template <int dim>
  void add_at_contact(const Model<dim> &model, const Eigen::VectorXd &forces);

  /// The most that is left along a motion beyond `round_off` [N], over the sizes of what works
  /// there and `beside` of the sizes of all forces. NaN where forces or `round_off` are not finite.
  double imbalance(double beside, double round_off = 0) const;
  /// That of nodal forces [N] of a stiffness, the root of the sum of its diagonal's squares [N/m],
  /// times a motion [m]: sums of many have it at random.
  static double round_off(double stiffness, double motion);

 private:
  std::vector<casefile::RigidMotion> motions_;
  std::vector<double> sums_;  // of each motion work and the sizes of its terms; of all, sizes
};

/// How far a body moves that its contact holds [m]: a hundredth of its size, and as far as it is
/// prescribed or nodes that are not open, by their `status`, follow gaps and foundation. A
/// stiffness times that has the round-off of forces that balance.
template <int dim>
double held_motion(const Model<dim> &model, double time, const std::vector<ContactStatus> &status);
/// What that is at the nodes of a body, `RigidWork::round_off` of its whole stiffness [N].
template <int dim>
double round_off_where_held(const Model<dim> &model, double time,
                            const std::vector<ContactStatus> &status);

}  // namespace tourmaline::solve
