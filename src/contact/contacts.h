#pragma once

#include <vector>

#include "contact/interface.h"
#include "contact/laws.h"

namespace tourmaline::contact {

/// The laws of all contacts of a case. What is asked of them together is whether any of them is so;
/// without contact none is.
class Contacts {
 public:
  Contacts() = default;
  /// `step`: k [s].
  Contacts(const std::vector<casefile::ContactCase> &asked, double step);

  /// By the order of the case file.
  const ContactLaws &operator[](std::size_t contact) const { return all_[contact]; }
  template <int dim>
  const ContactLaws &of(const InterfaceNode<dim> &at) const {
    return all_[at.contact];
  }

  std::size_t size() const { return all_.size(); }
  /// What crosses by place alone, of all contacts.
  std::vector<body::SurfaceExchange> linear_exchanges() const;

  bool has_moving_foundation() const;
  bool has_normal_unknowns() const;
  bool can_open() const;
  bool friction_depends_on_pressure() const;
  bool remembers_slip() const;
  bool crosses_by_state(Crossing what) const;
  bool is_warmed_by_friction() const;
  bool remembers_charge() const;

  /// Of the contact that the place belongs to.
  FrictionAt friction() const;
  /// A program's own friction takes the place of the case's at all contacts.
  void replace_friction();
  bool has_own_friction() const { return any(&ContactLaws::has_own_friction); }
  /// Steps of another k [s] follow.
  void set_step(double step);

 private:
  bool any(bool (ContactLaws::*is_so)() const) const;

  std::vector<ContactLaws> all_;
};

}  // namespace tourmaline::contact
