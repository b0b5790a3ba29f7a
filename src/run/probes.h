#pragma once

#include <span>
#include <vector>

#include "body/interpolation.h"
#include "output/probe_rows.h"
#include "run/probed_region.h"
#include "solve/boundary_flow.h"
#include "solve/model.h"

namespace tourmaline::run {

/// What the case's probes tell of a step.
template <int dim>
class Probes {
 public:
  /// All ranks make one together. Throws CaseError for a place outside of the body, with the
  /// nearest one in it.
  explicit Probes(const solve::Model<dim> &model);

  /// Of the step that ends at `time` [s] with that state; `passages` are those of its balance. All
  /// ranks ask together.
  std::vector<output::ProbeRows> rows(double time, std::span<const solve::Passage> passages,
                                      std::span<const double> state) const;

 private:
  /// A place or a line.
  struct Places {
    std::string name;
    bool is_line;
    std::vector<Vector3> at;  ///< [m]
    std::vector<body::Interpolation> fields;

    double along(std::size_t i) const;
  };

  struct Boundaries {
    std::string name;
    Vector3 about;  ///< [m]
    solve::BoundaryPart<dim> part;
  };

  struct Regions {
    std::string name;
    ProbedRegion<dim> part;
  };

  void find_regions();
  void find_places();
  static Places places_of(const casefile::ProbeCase &probe);
  output::ProbeRows rows_of(const Places &probe, std::span<const double> state) const;
  output::ProbeRows rows_of(const Boundaries &probe, const solve::BoundaryFlow &flow) const;
  static output::ProbeRows rows_of(const Regions &probe, std::span<const double> state,
                                   const std::vector<body::Energies> &stored);

  const solve::Model<dim> &model_;
  std::vector<Places> places_;
  std::vector<Boundaries> boundaries_;
  std::vector<Regions> regions_;
};

}  // namespace tourmaline::run
