#pragma once

#include <span>
#include <string>
#include <vector>

#include "body/discretisation.h"
#include "output/records.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::run {

/// The fields at the places of the case's probes.
template <int dim>
class Probes {
 public:
  /// Throws CaseError for a place outside of the body, with the nearest node. All ranks together.
  Probes(const body::Discretisation<dim> &body, const casefile::Case &asked);

  struct Probe {
    std::string name;
    output::ProbeRows rows;                ///< without values
    std::vector<body::NodeShares> shares;  ///< by place
  };
  const std::vector<Probe> &all() const { return all_; }

  static output::ProbeRows rows(const Probe &probe, std::span<const double> state);

 private:
  std::vector<Probe> all_;
};

}  // namespace tourmaline::run
