#pragma once

#include <span>
#include <string>
#include <vector>

#include "solve/model.h"

namespace tourmaline::run {

/// Warnings of material constants that are possible and yet hardly meant, as those in GPa or pC/N
/// instead of Pa and C/N: an electromechanical coupling factor above 0.98, diagonal stiffnesses
/// of one material that differ by more than 1e4, of two materials by more than 1e5, permittivities
/// above 1e-6 C/(V m), densities below 30 kg/m^3, reference temperatures below 50 K. Throws
/// CaseError for materials that are not complete.
std::vector<std::string> material_warnings(const casefile::Case &asked);

/// A state of a run, and when it was.
struct Moment {
  std::span<const double> state;
  int step;
  double time;
};

/// A warning of strains above 0.1, for which a linear theory does not hold, with the largest of
/// these moments; empty when there are none. All ranks ask together.
template <int dim>
std::string strain_warning(const solve::Model<dim> &model, const std::vector<Moment> &moments);

}  // namespace tourmaline::run
