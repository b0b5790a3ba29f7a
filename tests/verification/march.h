#pragma once

#include <vector>

#include "solve/condensed_route.h"

namespace tourmaline::verified {

/// The last state of a model, and what happened at its contact in each step.
struct March {
  std::vector<double> state;
  std::vector<solve::StepOutcome> steps;

  std::vector<ContactStatus> statuses() const {
    std::vector<ContactStatus> all;
    for (const solve::StepOutcome &step : steps)
      all.insert(all.end(), step.status.begin(), step.status.end());
    return all;
  }
};

/// Marches a model through all its steps by the condensed route: the time loop for models that no
/// case file can describe, on meshes of the test's own.
template <int dim>
March march(const solve::Model<dim> &model) {
  const std::unique_ptr<solve::Route> route = solve::condensed_route(model);
  March at{body::initial_state(model.body, model.asked.initial), {}};
  for (int n = 1; n <= model.asked.time.steps; ++n) {
    std::vector<double> right_side(model.n_unknowns(), 0.);
    model.loads.integrate(model.time(n), right_side);
    body::add_history<dim>(model.products_by_field(at.state, false), right_side);
    const std::vector<double> before = at.state;
    for (const body::Prescribed &p : model.prescribed)
      at.state[p.unknown] = p.value.value(p.point, model.time(n));
    at.steps.push_back(route->advance(model.time(n), right_side, before, at.state));
  }
  return at;
}

}  // namespace tourmaline::verified
