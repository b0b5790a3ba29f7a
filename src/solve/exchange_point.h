#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "contact/exchange.h"

namespace tourmaline::solve {

/// A temperature or potential of a contact node that a law acts on, as an unknown of the contact
/// problem behind those of its points: theta or phi is `of_value` times the entry, so that the rows
/// of all entries are in N. Its row is
///
///     lambda + of_flow q = 0,    lambda = f - A d,
///
/// with q [W/m^2, C/m^2] what the law lets out of the body.
struct ExchangePoint {
  Eigen::Index entry = 0;             ///< of d
  std::size_t field = 0;              ///< of `InterfaceProgramme::fields`
  std::size_t slip = 0;               ///< the point of the node's slip
  std::optional<std::size_t> normal;  ///< of its normal; nothing: its pressure is known
  /// The pressure where it is known, and the penetration at which the normal's entry is 0.
  contact::ContactState known;
  double of_value = 1, of_flow = 1;
  std::shared_ptr<const contact::Exchange> law;
};

}  // namespace tourmaline::solve
