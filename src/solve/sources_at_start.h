#pragma once

#include <optional>

#include "solve/model.h"

namespace tourmaline::solve {

/// When the sources of circuits were what their formulas say, before anything happens in a run [s];
/// nothing: they are switched on at t = 0. A run that starts from another one goes on with them.
template <int dim>
std::optional<double> sources_at_start(const Model<dim> &model) {
  return model.asked.initial.from ? std::optional(0.) : std::nullopt;
}

}  // namespace tourmaline::solve
