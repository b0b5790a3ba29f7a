#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "output/records.h"

namespace tourmaline::output {

/// Facets by rows of contact.csv (of one step, from 0), their nodes in the order of
/// `NamedBoundary`.
using ContactFacets = std::vector<std::vector<std::uint32_t>>;

/// The facets of the boundaries of these names, each once, in ascending order. `nodes`: those of
/// the rows, ascending. Throws std::invalid_argument when a facet has another one.
ContactFacets contact_facets(const std::vector<NamedBoundary> &boundaries,
                             std::span<const std::string> names,
                             std::span<const std::uint32_t> nodes);

/// Field files of the contact surface in VTK's XML format: lines in 2D, triangles or quadrilaterals
/// in 3D, quadratic ones where the facets are. The points are the rows of contact.csv.
class ContactSurface {
 public:
  /// Throws std::invalid_argument when a facet refers to a row that there is not, or has a number
  /// of nodes that no facet has.
  ContactSurface(int dimension, std::span<const ContactRow> rows, const ContactFacets &facets);

  /// Writes the columns of contact.csv to `path`, whole or not at all: components of a vector as
  /// one array, the status as 0 (open), 1 (stick) or 2 (slip), of several contacts the number.
  /// Throws std::invalid_argument when there is another number of rows than at first, MachineError
  /// when the file cannot be written.
  void write(const std::filesystem::path &path, double time,
             std::span<const ContactRow> rows) const;

 private:
  std::size_t n_points_, n_cells_;
  std::string topology_;  // the elements <Points> and <Cells>
};

}  // namespace tourmaline::output
