#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "case/free_modes.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// What forces on the body do along the rigid motions that nothing but its contact resists. In
/// equilibrium that is nothing.
class RigidWork {
 public:
  /// From where on an imbalance is no longer that of numbers known to few digits.
  static constexpr double unbalanced = 1e-5;
  /// Of all forces, what counts beside those that work: as loads are summed, and where forces of a
  /// solution are added.
  static constexpr double summed = 1e-9, uncertain = 1e-3;

  template <int dim>
  static RigidWork left_to_contact(const Model<dim> &model);
  explicit RigidWork(std::vector<casefile::RigidMotion> motions);

  /// The force's first `size` components, in N, at a point.
  void add(const Vector3 &point, const double *force, int size);
  template <class Vector>
  void add(const Vector3 &point, const Vector &force) {
    add(point, force.data(), static_cast<int>(force.size()));
  }
  /// Where each rank has added forces of its own.
  void sum(const body::NodeSharing &sharing);

  /// The most that is left along a motion beyond `round_off` [N], over the sizes of what works
  /// there and `beside` of the sizes of all forces.
  double imbalance(double beside, double round_off = 0) const;

 private:
  std::vector<casefile::RigidMotion> motions_;
  std::vector<double> sums_;  // of each motion work and the sizes of its terms; of all, sizes
};

/// How far a body moves that its contact holds [m]: a hundredth of its size, with what gaps leave
/// and where the foundation goes. A stiffness times that has the round-off of forces that balance.
template <int dim>
double held_motion(const Model<dim> &model, double time);

}  // namespace tourmaline::solve
