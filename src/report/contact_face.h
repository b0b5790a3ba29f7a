#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tourmaline/vector.h"

namespace tourmaline::report {

/// A facet of the contact of a solid body by rows of one step of contact.csv: its corners in a
/// circle, then the nodes amid its sides and in its middle, if there are any.
using ContactFacet = std::vector<std::uint32_t>;

/// A part of the contact of a solid body, laid out in a plane so that none of its nodes hides
/// another. The nodes stand facet by facet, as often as they are of one.
struct ContactFace {
  std::string contact;  ///< which one it is of; empty where there is only one
  std::string place;    ///< where it is: "z = 0 m", "around z, radius 0.02 m", "facing z"
  std::string across;   ///< what `x` is, with its unit
  std::string up;       ///< what `y` is, with its unit
  std::string origin;   ///< where one that is unrolled begins, and which way it goes
  std::vector<std::uint32_t> sizes;  ///< nodes of each facet
  std::vector<std::uint32_t> rows;
  std::vector<double> x, y;  ///< [m]
};

/// Corners of a facet of so many nodes.
std::size_t corners_of(std::size_t nodes);

/// The contact in connected parts, by the least of their rows. A part of which nothing is hidden
/// when it is seen along an axis is laid out so; one around an axis, everywhere at the same
/// distance from it, is unrolled; of any other each side is laid out along the axis that it faces
/// most. `contacts` says of each place which contact it belongs to, `names` how they are called;
/// both are empty where there is only one.
std::vector<ContactFace> contact_faces(const std::vector<ContactFacet> &facets,
                                       const std::vector<Vector3> &places,
                                       const std::vector<std::size_t> &contacts = {},
                                       const std::vector<std::string> &names = {});

}  // namespace tourmaline::report
