#include "solve/energy_works.h"

#include <cmath>

namespace tourmaline::solve {

using body::field_of;
using body::Fields;

namespace {

// What moves a prescribed displacement does work as a load does, and so does the foundation along
// the normal: together it is zero where u_nu = 0. A load moves with the body: told by how it moves
// against a foundation that goes far, its work would be a small difference.
template <int dim>
void add_mechanical(const BalanceStep<dim> &step, std::size_t i, bool is_prescribed, bool can_open,
                    EnergyWorks &works) {
  const double moving = step.working_load(i, is_prescribed);
  const double pressing = can_open ? 0 : step.working_contact(i) - step.working_friction(i);
  const double carried = step.carried_by(i), along = step.change(i) - carried;
  works.load += is_prescribed ? moving * carried + (moving + pressing) * along
                              : moving * step.change(i) + pressing * along;
  works.by_scheme[0] += (step.friction[i] - step.working_friction(i)) * along;
}

// Friction is worked against.
template <int dim>
ContactWorks tangential_works(const contact::InterfaceNode<dim> &at, const BalanceStep<dim> &step) {
  ContactWorks works;
  for (int c = 0; c < dim; ++c) {
    const std::size_t i = body::unknown<dim>(at.node, c);
    const double carried = step.carried_by(i);
    works.friction -= step.friction[i] * (step.change(i) - carried);
    works.foundation += step.working_contact(i) * carried;
  }
  return works;
}

// A rigid foundation that reaches into the body at the start gets out of it in the first step: it
// presses the body by as much as the two have overlapped.
template <int dim>
ContactWorks response_works(const Model<dim> &model, const contact::InterfaceNode<dim> &at,
                            const BalanceStep<dim> &step) {
  double received = 0, force = 0;
  typename Model<dim>::Vector then, now;
  for (int c = 0; c < dim; ++c) {
    const std::size_t i = body::unknown<dim>(at.node, c);
    then[c] = step.before.unknowns[i];
    now[c] = step.now.unknowns[i];
    const double pressing = step.working_contact(i) - step.working_friction(i);
    received -= pressing * (step.change(i) - step.carried_by(i));
    force -= pressing * at.normal[c];
  }
  const double before = then.dot(at.normal) - model.reach(at, model.time_before(step.time)),
               after = now.dot(at.normal) - model.reach(at, step.time);
  const auto law = model.laws.of(at).normal(at.point, before);
  const double pressed_in = std::isinf(law->potential(before)) ? force * before : 0;
  return {0,
          pressed_in,
          received + pressed_in,
          at.weight * law->stored(after),
          at.weight * (law->stored(after) - law->stored(before)),
          at.weight * law->dissipated(after)};
}

template <int dim>
void add_contacts(const Model<dim> &model, const BalanceStep<dim> &step, EnergyWorks &works) {
  works.contacts.resize(model.asked.contacts.size());
  for (const contact::InterfaceNode<dim> &at : model.interface) {
    works.contacts[at.contact] += tangential_works(at, step);
    if (model.laws.of(at).can_open())
      works.contacts[at.contact] += response_works(model, at, step);
  }
  for (const ContactWorks &of_one : works.contacts)
    works.contact += of_one;
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

// Of what stands at the unknowns.
void sum_over_ranks(const body::NodeSharing &sharing, EnergyWorks &works) {
  for (double *work : {&works.load, &works.electric, &works.thermal, &works.conduction,
                       &works.by_scheme[0], &works.by_scheme[2]})
    *work = sharing.sum(*work);
}

}  // namespace

ContactWorks &ContactWorks::operator+=(const ContactWorks &other) {
  friction += other.friction;
  foundation += other.foundation;
  received += other.received;
  stored += other.stored;
  gained += other.gained;
  dissipated += other.dissipated;
  return *this;
}

template <int dim>
EnergyWorks energy_works(const Model<dim> &model, const BalanceStep<dim> &step,
                         const std::vector<bool> &is_prescribed,
                         const std::vector<bool> &can_open) {
  const double per_watt = -model.step / model.op.reference_temperature();
  EnergyWorks works;
  for (std::size_t i = 0; i < step.now.unknowns.size(); ++i) {
    if (!model.counts(i))
      continue;
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
  sum_over_ranks(model.sharing(), works);
  works.by_scheme[0] += step.rates.lost;
  add_contacts(model, step, works);
  return works;
}

template EnergyWorks energy_works<2>(const Model<2> &, const BalanceStep<2> &,
                                     const std::vector<bool> &, const std::vector<bool> &);
template EnergyWorks energy_works<3>(const Model<3> &, const BalanceStep<3> &,
                                     const std::vector<bool> &, const std::vector<bool> &);

}  // namespace tourmaline::solve
