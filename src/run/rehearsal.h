#pragma once

#include "solve/model.h"

namespace tourmaline::run {

/// Evaluates what a case says by formulas at all places, before anything is solved: in step 1 and,
/// where more are wanted, in so many in all, up to the last one. Throws CaseError where a formula
/// is undefined or out of range, and for conditions that contradict each other at a node.
template <int dim>
void rehearse(const solve::Model<dim> &model, int n_steps);

/// A hundred of them, or all where there are fewer.
int tried_steps(const casefile::TimeCase &time);

/// The same from the start state on, which is made as well; in `tried_steps`.
template <int dim>
void rehearse_from_start(solve::Model<dim> &model);

/// The same of a case, whose mesh and operator are built for it.
void rehearse(const casefile::Case &asked);

}  // namespace tourmaline::run
