#include "run/rehearsal.h"

#include <algorithm>

#include "parallel/ranks.h"
#include "run/probes.h"
#include "run/start_state.h"
#include "run/step_check.h"
#include "solve/contact_nodes.h"
#include "solve/exchange_nodes.h"
#include "solve/start_of_motion.h"

namespace tourmaline::run {

int tried_steps(const casefile::TimeCase &time) {
  return std::min(time.steps, 100);
}

template <int dim>
void rehearse(const solve::Model<dim> &model, int n_steps) {
  const Probes<dim> refuses_places_outside(model);
  const std::vector<double> before = body::initial_state(model.body, model.asked.initial);
  std::vector<double> state = before, loads;
  if (model.asked.time.is_dynamic())
    solve::initial_velocity(model);
  const std::vector<bool> is_prescribed = body::mask_of(model.prescribed, model.n_unknowns());
  solve::ContactNodes<dim> contact(model, is_prescribed);
  solve::ExchangeNodes<dim> exchange(model);
  for (int i = 0; i < n_steps; ++i) {
    const long long later = model.asked.time.steps - 1LL;  // than the first
    const int n = n_steps == 1 ? 1 : 1 + static_cast<int>(later * i / (n_steps - 1));
    const double time = model.time(n);
    parallel::together([&] {
      for (const body::Prescribed &p : model.prescribed)
        state[p.unknown] = p.value.value(p.point, time);
    });
    loads.assign(model.n_unknowns(), 0.);
    model.add_loads(time, loads);
    parallel::together([&] { StepCheck(n, time).loads(dim, model.body.points(), loads); });
    contact.begin_step(time, before, state);
    exchange.begin_step(time, state);
  }
}

template <int dim>
void rehearse_from_start(solve::Model<dim> &model) {
  start_state(model);
  rehearse(model, tried_steps(model.asked.time));
}

namespace {

template <int dim>
void rehearse_in(const casefile::Case &asked) {
  solve::Model<dim> model(asked);
  rehearse_from_start(model);
}

}  // namespace

void rehearse(const casefile::Case &asked) {
  if (asked.dimension == 2)
    rehearse_in<2>(asked);
  else
    rehearse_in<3>(asked);
}

template void rehearse<2>(const solve::Model<2> &, int);
template void rehearse<3>(const solve::Model<3> &, int);
template void rehearse_from_start<2>(solve::Model<2> &);
template void rehearse_from_start<3>(solve::Model<3> &);

}  // namespace tourmaline::run
