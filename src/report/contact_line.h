#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tourmaline::report {

/// A part of the boundary of a plane body as a run writes it: its facets by nodes of the body, from
/// end to end, with the middle node between if there is one.
struct NamedFacets {
  std::string name;
  std::vector<std::vector<std::uint32_t>> facets;
  std::size_t contact = 0;  ///< which contact it is of, where there are several
};

/// A connected piece of the contact of a plane body, along its facets.
struct ContactPiece {
  std::string name;                 ///< of the boundaries that it is made of
  std::string abscissa;             ///< what `along` is, with its unit
  std::string origin;               ///< where a curve begins, and which way it goes
  std::vector<std::uint32_t> rows;  ///< of one step of contact.csv; a closed one ends as it begins
  std::vector<double> along;        ///< coordinate of each row, ascending [m]
};

/// The pieces of the contact on `boundaries`, by the least of their nodes. `places` [m] are those
/// of the contact nodes in the order of contact.csv, which is that of their numbers. A straight
/// piece along an axis is measured by that coordinate, any other by its length: an open one from
/// the end that comes first in the table, a closed one counter-clockwise from the node that does.
/// Where more than two facets meet, pieces end. Empty when the facets have another number of nodes
/// than there are places. Pieces of several contacts end where these meet, each with the last node
/// of its own: `contacts` says of each place which contact the node belongs to.
std::vector<ContactPiece> contact_pieces(const std::vector<NamedFacets> &boundaries,
                                         const std::vector<std::pair<double, double>> &places,
                                         const std::vector<std::size_t> &contacts = {});

}  // namespace tourmaline::report
