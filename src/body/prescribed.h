#pragma once

#include <string>
#include <vector>

#include "body/operator.h"
#include "tourmaline/case/boundary_case.h"
#include "tourmaline/case/load_case.h"

namespace tourmaline::body {

/// A prescribed unknown (7), (10), (12), its value in time and place, and the boundary that
/// prescribes it.
struct Prescribed {
  std::size_t unknown;
  Vector3 point;
  casefile::Formula value;
  std::string boundary;
  int electrode = -1;  ///< of the case's electrodes; -1: a boundary's condition

  /// Whether the case gives it; if not, something else finds it or the case does without it.
  bool is_given() const { return !boundary.empty(); }
};

/// Prescribed unknowns of all [[boundary]] entries and the potentials of all [[electrode]] entries,
/// ascending. An electrode whose voltage is not given has the value 0 here: the circuit adds its
/// voltage. On the axis of a revolved body u_x is prescribed as 0. Where two boundaries meet and
/// both prescribe an unknown, the entry that stands first in the case file holds, [[boundary]]
/// before [[electrode]].
template <int dim>
std::vector<Prescribed> prescribed_unknowns(
    const Discretisation<dim> &body, const std::vector<casefile::BoundaryCase> &boundaries,
    const std::vector<casefile::ElectrodeCase> &electrodes = {});

/// The nodes where the case says something of displacements or potentials, of electrodes, contacts
/// and the axis of a revolved body, ascending: what holds the body, and what circuits and contacts
/// are made of, all ranks have to know.
template <int dim>
std::vector<Node> nodes_with_conditions(const Discretisation<dim> &body,
                                        const casefile::Case &asked);

/// Throws CaseError where something else than 0 is prescribed as u_x on the axis of a revolved
/// body, at the end of any step.
template <int dim>
void check_axis(const Discretisation<dim> &body, const casefile::Case &asked,
                const std::vector<Prescribed> &prescribed);

/// With all unknowns of a component among them, those that are not given as well
/// (`Prescribed::is_given`), with the value 0: temperatures that are known before a step begins
/// where heat flows steadily, and fields that the case does without.
template <int dim>
std::vector<Prescribed> with_all(int component, const Discretisation<dim> &body,
                                 std::vector<Prescribed> prescribed);

/// By unknown of the body, whether it is prescribed.
std::vector<bool> mask_of(const std::vector<Prescribed> &prescribed, std::size_t n_unknowns);

/// The nodes that each electrode holds. Throws CaseError for an electrode that holds none because
/// other conditions stand first at all of them.
template <int dim>
std::vector<std::vector<Node>> electrode_nodes(
    const std::vector<Prescribed> &prescribed,
    const std::vector<casefile::ElectrodeCase> &electrodes);

/// Nodal values of formulas, component by component: u_0, phi_0, theta_0 of (14).
template <int dim>
std::vector<double> initial_state(const Discretisation<dim> &body,
                                  const casefile::InitialCase &initial);

}  // namespace tourmaline::body
