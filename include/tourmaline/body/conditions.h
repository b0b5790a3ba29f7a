#pragma once

#include <string>
#include <vector>

#include "tourmaline/body/operator.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {

/// A prescribed unknown (7), (10), (12), its value in time and place, and the boundary that
/// prescribes it.
struct Prescribed {
  std::size_t unknown;
  output::Vector point;
  casefile::Formula value;
  std::string boundary;
};

/// Prescribed unknowns of all [[boundary]] entries, ascending. Where two boundaries meet and both
/// prescribe an unknown, the entry that stands first in the case file holds.
template <int dim>
std::vector<Prescribed> prescribed_unknowns(const Discretisation<dim> &body,
                                            const std::vector<casefile::BoundaryCase> &boundaries);

/// Nodal values of formulas, component by component: u_0, phi_0, theta_0 of (14).
template <int dim>
std::vector<double> initial_state(const Discretisation<dim> &body,
                                  const casefile::InitialCase &initial);

}  // namespace tourmaline::body
