#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solve/contact_body.h"
#include "solve/coupled_programme.h"

namespace tourmaline::solve {

/// The natural map of a coupled programme at some d,
///
///     F_i = lambda_i - w_i R_i(lambda_i / w_i + r_i d_i; b_i),    lambda = f - A d,
///
/// r_i w_i the largest curvature of the point's own block of A. It is zero at solutions, and
/// piecewise smooth. `strength` times the friction bounds are meant.
///
/// Where a point begins to touch, its bound jumps from zero to what it is without pressure
/// (cohesion, all of Tresca's). If closing brings the friction that opens the point again, neither
/// is a solution. The bound is then a share s of what it is, between 0 and 1, at delta = 0 and p =
/// 0: the graph of the jump is filled, so that there is a solution. With a `ramp` e [N] >= 0 the
/// shares are unknowns of their own, with the trial force y along the normal
///
///     s = 0 and y <= 0,   or   y = e s,   or   s = 1 and y >= e.
///
/// Where temperatures or potentials are exchanged, their entries of d stand behind those of points,
/// and F has for each what its row lacks (`ExchangePoint`).
class NaturalMap {
 public:
  NaturalMap(const CoupledProgramme &programme, double strength, std::optional<double> ramp = {});
  /// What `contact` refers to outlives the map.
  NaturalMap(const CoupledContact &contact, double strength, std::optional<double> ramp = {});

  /// d and f - A d, and by coupling s, without a ramp nothing.
  struct Place {
    Eigen::VectorXd d, force, share;
  };
  Place at(Eigen::VectorXd d) const;
  /// With the shares given.
  Place at(Eigen::VectorXd d, Eigen::VectorXd share) const;
  /// Whether any bound jumps.
  bool has_jumps() const;

  Eigen::VectorXd value(const Place &x) const;  ///< F [N]
  /// What crosses at an exchange.
  contact::Exchange::Value flow(const ExchangePoint &at, const Place &x) const;
  /// What the shares lack of the relation above [N].
  Eigen::VectorXd share_value(const Place &x) const;
  /// |F|^2, each point's part over its curvature [m^2].
  double merit(const Place &x) const;
  /// The largest |F_i| over the size of the forces; of what is exchanged, over the size of its
  /// field's.
  double residual(const Place &x) const;
  bool is_zero(const Place &x, double tolerance) const;  ///< whether the residual is within it
  std::vector<std::size_t> unsettled(const Place &x, double tolerance) const;

  struct Direction {
    Eigen::VectorXd d, resisted, share;  // resisted = A d
  };
  /// Newton's, or of large systems nearly Newton's; nothing where the linear system cannot be
  /// solved. Points that are held go there at once and take no part in it.
  /// `is_last`: as of `ContactTangent`.
  std::optional<Direction> newton_direction(const Place &x, bool is_last = false) const;
  /// The linear system of that direction.
  ContactTangent tangent(const Place &x) const;
  Place along(const Place &x, const Direction &direction, double length) const;
  /// Whether directions are those of systems that are solved in part only.
  bool is_solved_in_part() const { return body_->carries_forces(); }
  /// Where such a step has led, its forces free of the step's round-off if that costs little.
  Place arrived(const Place &x) const { return body_->carries_forces() ? x : at(x.d, x.share); }

  /// Lengths between 0 and 1 at which points change their branch on the way from x; at most some
  /// twenty, in ascending order.
  std::vector<double> turns(const Place &x, const Direction &direction) const;

  /// Held points put exactly where they are held.
  Place settled(const Place &x) const;

  CoupledSolution solution(const Place &x) const;
  /// The friction laws with the bounds that hold at x.
  std::vector<contact::PointLaw> friction_at(const Place &x) const;
  /// By coupling what friction at x depends on: the bound [N/m^2], or the share of the point's own
  /// law that holds; and the friction laws with such numbers given.
  Eigen::VectorXd bounds(const Place &x) const;
  std::vector<contact::PointLaw> friction_at(const Place &x, const Eigen::VectorXd &bounds) const;

 private:
  struct Pressure {
    double value = 0;
    bool is_closed = false;
  };
  /// A point's law as it is at x, and how its traction depends on what is not its own trial value.
  struct Branch {
    contact::TangentMatrix derivative;
    contact::Tangent by_pressure, by_slip, by_share;
    bool is_held = false;  // the row is that of d = 0
  };
  /// Of a direction what is known beforehand, and what is asked for: points that are not held, and
  /// shares.
  struct Unknowns {
    std::vector<Branch> branches;
    std::vector<std::size_t> shares;  // couplings
    Eigen::VectorXd d, share;
  };

  NaturalMap(std::shared_ptr<ContactBody> body, const std::vector<ContactPoint> &points,
             const std::vector<FrictionCoupling> &couplings,
             std::span<const ExchangePoint> exchanges, double strength, std::optional<double> ramp);
  const ContactPoint &point(std::size_t i) const { return points_[i]; }
  const FrictionCoupling *coupling(std::size_t i) const;
  double largest_value(const Place &x) const;
  double residual_of_exchanges(const Place &x) const;
  double size_of_jump(const FrictionCoupling &coupling) const;
  contact::Tangent trial(std::size_t i, const Place &x) const;
  double normal_force(std::size_t j, const Place &x) const;
  Pressure pressure(const FrictionCoupling &coupling, const Place &x) const;
  double pressure(std::size_t normal, const Place &x) const;
  /// What an exchange sees of its node, and how that changes: the pressure by the trial value, the
  /// work of friction by the slip and the pressure.
  struct Sight {
    contact::ContactState state;
    double by_trial = 0;
    contact::Tangent friction_by_slip;
    double friction_by_pressure = 0;
  };
  Sight sight(const ExchangePoint &at, const Place &x) const;
  double exchange_value(const ExchangePoint &at, const Place &x) const;
  ContactTangent::Exchange tangent_at(const ExchangePoint &at, const Place &x) const;
  double share(std::size_t j, const Place &x) const;
  double share_wanted(std::size_t j, const Place &x) const;
  contact::LocalLaw law(std::size_t i, const Place &x) const;
  contact::PointLaw friction(std::size_t j, const Place &x, double share) const;
  contact::FrictionBound::Value bound(const FrictionCoupling &coupling, const Place &x) const;
  double slip_size(std::size_t i, const Place &x) const;
  contact::Tangent point_value(std::size_t i, const Place &x) const;
  Branch branch(std::size_t i, const Place &x) const;
  void add_coupling(std::size_t j, const Place &x, Branch &branch) const;
  Unknowns unknowns(const Place &x) const;
  ContactTangent::Point tangent_at(std::size_t i, const Place &x, const Unknowns &u) const;
  ContactTangent tangent(const Place &x, const Unknowns &u) const;
  double excess(std::size_t i, const Place &x) const;
  double length_to_turn(std::size_t i, const Place &x, const Direction &direction,
                        Place &moving) const;

  std::shared_ptr<ContactBody> body_;
  const std::vector<ContactPoint> &points_;
  const std::vector<FrictionCoupling> &couplings_;
  std::span<const ExchangePoint> exchanges_;
  double strength_;
  std::vector<double> curvature_;  // by point [N/m]
  std::vector<int> coupling_of_;   // by point; -1: none
  std::optional<double> ramp_;
  std::vector<double> jump_;  // by coupling: of the bound, where its point begins to touch [N]
  double largest_force_ = 0;  // of f [N]
};

}  // namespace tourmaline::solve
