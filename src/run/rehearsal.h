#pragma once

#include "solve/model.h"

namespace tourmaline::run {

/// Evaluates what a case says by formulas at all places, before anything is solved: in step 1 and,
/// where more are wanted, in so many in all, up to the last one. Throws CaseError where a formula
/// is undefined or out of range, and for conditions that contradict each other at a node.
template <int dim>
void rehearse(const solve::Model<dim> &model, int n_steps);

/// The same of a case, whose mesh and operator are built for it; in up to a hundred steps.
void rehearse(const casefile::Case &asked);

}  // namespace tourmaline::run
