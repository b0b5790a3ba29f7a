#pragma once

#include <Eigen/Dense>
#include <optional>

#include "solve/interface_newton.h"

namespace tourmaline::solve {

/// What a residual of the programme at d is compared to: the largest of the terms of its forces
/// [N].
double size_of_forces(const InterfaceProgramme &programme, const Eigen::VectorXd &d);
/// The same of the rows of another field.
double size_of_flows(const InterfaceProgramme &programme, const Eigen::VectorXd &d,
                     std::size_t field);

/// That size along the way to a solution. Of a large contact it costs as much as a product with A.
class ForceSize {
 public:
  /// The programme outlives this.
  explicit ForceSize(const InterfaceProgramme &programme) : programme_(programme) {}

  double at(const Eigen::VectorXd &d);
  /// Whether a residual [N] at d is within `tolerance` of it. Where the contact is large it may be
  /// said to be more though it is not, if the size has grown since it was asked for.
  bool is_within(const Eigen::VectorXd &d, double residual, double tolerance);

 private:
  bool exceeds_all(const Eigen::VectorXd &d, double residual, double tolerance) const;

  struct Known {
    Eigen::VectorXd d;
    double size = 0;
  };
  const InterfaceProgramme &programme_;
  std::optional<Known> last_;
};

}  // namespace tourmaline::solve
