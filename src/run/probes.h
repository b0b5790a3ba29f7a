#pragma once

#include <span>
#include <vector>

#include "body/interpolation.h"
#include "output/probe_rows.h"
#include "tourmaline/case/case.h"

namespace tourmaline::run {

/// What the case's probes tell of a state.
template <int dim>
class Probes {
 public:
  /// All ranks make one together. Throws CaseError for a place outside of the body, with the
  /// nearest one in it.
  Probes(const casefile::Case &asked, const body::Discretisation<dim> &body);

  /// Of all probes in the order of the case.
  std::vector<output::ProbeRows> rows(std::span<const double> state) const;

 private:
  /// A place or a line.
  struct Places {
    std::string name;
    bool is_line;
    std::vector<Vector3> at;  ///< [m]
    std::vector<body::Interpolation> fields;

    double along(std::size_t i) const;
  };

  static Places places_of(const casefile::ProbeCase &probe);
  static output::ProbeRows rows_of(const Places &probe, std::span<const double> state);

  std::vector<Places> places_;
};

}  // namespace tourmaline::run
