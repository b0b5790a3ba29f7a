#pragma once

#include "body/prescribed.h"
#include "material/composition.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::body {

/// Throws CaseError where something gives two potentials to one conductor: conducting cells that
/// share nodes, in one region or in several. It has one potential; what a dielectric of a large
/// permittivity, which stands for it, would carry between two is no property of the metal.
/// Boundaries may prescribe the same value, an electrode with a given voltage may stand beside them
/// if that is it in all steps, and a second electrode may not: which of them has the charge would
/// be left open.
template <int dim>
void check_conductors(const Discretisation<dim> &body,
                      const material::Composition<dim> &composition, const casefile::Case &asked,
                      const std::vector<Prescribed> &prescribed);

}  // namespace tourmaline::body
