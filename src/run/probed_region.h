#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "body/discretisation.h"
#include "solve/model.h"

namespace tourmaline::run {

/// A part of the body that consists of regions, and what a probe tells of it.
template <int dim>
class ProbedRegion {
 public:
  using Columns = std::vector<std::pair<std::string, double>>;

  /// Of regions by their places in the case. All ranks make one together.
  ProbedRegion(const body::Discretisation<dim> &body, const casefile::ModelCase &model,
               std::vector<std::size_t> regions);

  /// Volume, energies, then means and extremes of u, phi and theta: means over the volume, extremes
  /// over the nodes. `stored` has the energies of every region of the case.
  Columns columns(std::span<const double> state, const std::vector<body::Energies> &stored) const;

 private:
  bool has(std::size_t region) const;
  void add_fields(std::span<const double> state, Columns &columns) const;

  const body::NodeSharing &sharing_;
  std::vector<std::size_t> regions_;
  std::vector<int> components_;    // of the fields that are not left out
  std::vector<body::Node> nodes_;  // of its cells those that count here, ascending
  std::vector<double> weights_;    // by these, integral of the shape function [m^dim]
  double volume_ = 0;
};

}  // namespace tourmaline::run
