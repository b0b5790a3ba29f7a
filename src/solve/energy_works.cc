#include "solve/energy_works.h"

namespace tourmaline::solve {

using body::field_of;
using body::Fields;

namespace {

// What moves a prescribed displacement does work as a load does, and so does the foundation along
// the normal: together it is zero where u_nu = 0. Friction is worked against.
template <int dim>
void add_mechanical(const BalanceStep<dim> &step, std::size_t i, bool is_prescribed, bool can_open,
                    EnergyWorks &works) {
  const double moving = step.working_load(i, is_prescribed);
  const double pressing = can_open ? 0 : step.working_contact(i) - step.working_friction(i);
  const double carried = step.carried_by(i), along = step.change(i) - carried;
  works.load += moving * carried + (moving + pressing) * along;
  works.friction -= step.friction[i] * along;
  works.by_scheme[0] += (step.friction[i] - step.working_friction(i)) * along;
  works.foundation += step.working_contact(i) * carried;
}

// Heat that flows steadily changes no energy; what the body takes up as its entropy changes comes
// from outside.
template <int dim>
void add_steady_heat(const BalanceStep<dim> &step, std::size_t i, EnergyWorks &works) {
  works.thermal -= step.now.unknowns[i] * (step.now.products.sum(i) - step.before.products.sum(i));
}

template <int dim>
void add_heat(const BalanceStep<dim> &step, std::size_t i, double per_watt, EnergyWorks &works) {
  const std::size_t node = i / Fields<dim>::count;
  const double supplied = step.heat_supplied[node] + step.heat_crossed[node];
  works.thermal += step.working(i) * (-step.loads[i] - per_watt * supplied);
  works.conduction -= per_watt * step.now.unknowns[i] * step.conducted[node];
  works.by_scheme[2] += per_watt * (step.now.unknowns[i] - step.working(i)) * step.conducted[node];
}

}  // namespace

template <int dim>
EnergyWorks energy_works(const Model<dim> &model, const BalanceStep<dim> &step,
                         const std::vector<bool> &is_prescribed,
                         const std::vector<bool> &can_open) {
  const double per_watt = -model.step / model.op.reference_temperature();
  EnergyWorks works;
  works.by_scheme[0] = step.rates.lost;
  works.foundation = step.normal.pressed_in;
  for (std::size_t i = 0; i < step.now.unknowns.size(); ++i) {
    const int field = field_of<dim>(i);
    if (field == 0)
      add_mechanical(step, i, is_prescribed[i],
                     !can_open.empty() && can_open[i / Fields<dim>::count], works);
    else if (field == 1)
      works.electric -= step.working(i) * (step.now.charges[i] - step.before.charges[i]);
    else if (model.asked.time.is_static())
      add_steady_heat(step, i, works);
    else
      add_heat(step, i, per_watt, works);
  }
  return works;
}

template EnergyWorks energy_works<2>(const Model<2> &, const BalanceStep<2> &,
                                     const std::vector<bool> &, const std::vector<bool> &);
template EnergyWorks energy_works<3>(const Model<3> &, const BalanceStep<3> &,
                                     const std::vector<bool> &, const std::vector<bool> &);

}  // namespace tourmaline::solve
