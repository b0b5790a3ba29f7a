#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "body/surface_exchange.h"
#include "contact/exchange.h"
#include "contact/friction_bound.h"
#include "contact/normal_law.h"
#include "tourmaline/case/contact_case.h"
#include "tourmaline/contact/friction.h"
#include "tourmaline/vector.h"

namespace tourmaline::contact {

/// The laws of a case's contact, asked place by place: who works with contact knows them by their
/// functions, and none by its name.
class ContactLaws {
 public:
  /// `step`: k [s].
  ContactLaws(const casefile::ContactCase &asked, double step);

  /// By which body and foundation are apart at the start [m], negative: pressed together; and where
  /// the foundation has moved to at a time [m].
  double gap(const Vector3 &point) const;
  Vector3 foundation(const Vector3 &point, double time) const;
  bool has_moving_foundation() const { return !asked_.foundation_displacement.empty(); }

  /// Whether the penetration, or the pressure along it, decides anything. If not, the contact is
  /// bilateral, with friction that `friction` says.
  bool has_normal_unknowns() const;
  /// Whether the contact can open; then it holds no body along its normal.
  bool can_open() const;
  /// Whether friction depends on the pressure, or only on whether there is any.
  bool friction_depends_on_pressure() const;
  /// Whether the friction of a step depends on the slip of those before.
  bool remembers_slip() const;

  /// `before`: penetration at the end of the last step [m].
  std::shared_ptr<const NormalLaw> normal(const Vector3 &point, double before) const;
  /// The pressure at a point that supports have moved from one penetration to another [m]: of a
  /// foundation that yields; where it is rigid, nothing tells it from the supports, and it has
  /// none.
  double pressure_under_supports(const Vector3 &point, double before, double now) const;
  /// Whether the foundation touches it there.
  bool is_closed_under_supports(const Vector3 &point, double before, double now) const;
  /// Friction that does not depend on the pressure; none where `bound` has it.
  FrictionAt friction() const;
  /// The bound that depends on the pressure, or nothing; `slipped`: the accumulated slip at the end
  /// of the last step [m].
  std::shared_ptr<const FrictionBound> bound(const Vector3 &point, double time,
                                             double slipped) const;
  /// Whether what crosses depends on the contact's state, and so on unknowns of the contact nodes;
  /// and what crosses then, nothing where it does not. `before`: of charge, D.nu at the end of the
  /// last step [C/m^2].
  bool crosses_by_state(Crossing what) const;
  /// What crosses by place alone, linearly: exactly integrated, not lumped. Nothing: none does.
  std::optional<body::SurfaceExchange> linear(Crossing what) const;
  std::shared_ptr<const Exchange> exchange(Crossing what, const Vector3 &point, double time,
                                           double before) const;
  /// Whether any crosses at all; of heat, whether friction makes some of it.
  bool lets_pass(Crossing what) const;
  bool is_warmed_by_friction() const;
  /// Whether charge that has crossed in one step stays in the next one.
  bool remembers_charge() const;

  /// A program's own friction takes the place of the case's.
  void replace_friction();
  bool has_own_friction() const { return is_replaced_; }
  /// Steps of another k [s] follow.
  void set_step(double step) { step_ = step; }

 private:
  bool has_bound() const;
  bool resists() const { return is_replaced_ || asked_.friction.resists(); }
  std::shared_ptr<const Exchange> heat_exchange(const Vector3 &point, double time) const;
  std::shared_ptr<const Exchange> charge_exchange(const Vector3 &point, double time,
                                                  double before) const;

  casefile::ContactCase asked_;
  double step_;
  bool is_replaced_ = false;
};

}  // namespace tourmaline::contact
