#pragma once

#include <cstddef>
#include <functional>
#include <variant>

#include "tourmaline/contact/friction_law.h"
#include "tourmaline/contact/tresca.h"
#include "tourmaline/vector.h"

namespace tourmaline::casefile {
struct FrictionCase;
}

namespace tourmaline::contact {

/// A friction law: Tresca's, or one of a program's own. A law is convex in the slip increment; no
/// friction is the bound zero.
using Friction = std::variant<Tresca, OwnLaw>;

inline const FrictionLaw &law_of(const Friction &friction) {
  const auto *own = std::get_if<OwnLaw>(&friction);
  return own ? *own->law : std::get<Tresca>(friction);
}

/// Where and when a law is asked for.
struct ContactPlace {
  Vector3 point;  ///< [m]
  double time;    ///< [s]
  /// orthonormal columns of the tangent plane, which the law's components belong to: those along
  /// which the point is free to slip come first
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> directions;
  std::size_t contact = 0;  ///< which of the case's contacts, in the order of the case file
};

template <class Directions>
ContactPlace contact_place(const Vector3 &point, double time, const Directions &directions,
                           std::size_t contact) {
  ContactPlace place{point, time, {}, contact};
  place.directions.setZero(3, directions.cols());
  place.directions.topRows(directions.rows()) = directions;
  return place;
}

using FrictionAt = std::function<Friction(const ContactPlace &)>;

/// The law of a case, without what of it depends on the pressure (`ContactLaws`); it throws
/// CaseError where the bound is negative.
FrictionAt friction_of(const casefile::FrictionCase &asked);

}  // namespace tourmaline::contact
