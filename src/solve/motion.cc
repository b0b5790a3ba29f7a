#include "solve/motion.h"

namespace tourmaline::solve {

using body::field_of;
using body::Fields;
using body::RateForces;

template <int dim>
Motion<dim>::Motion(const Model<dim> &model) : model_(model), forces_(model.op.rate_forces()) {
  if (!forces_)
    return;
  for (std::vector<double> *of : {&rates_.velocity, &rates_.acceleration, &rates_.difference})
    of->assign(model.n_unknowns(), 0.);
  for (const body::Prescribed &p : model.prescribed)
    if (is_inertial() && field_of<dim>(p.unknown) == 0 && p.value.depends_on_time() &&
        !forces_->is_massless(static_cast<body::Node>(p.unknown / Fields<dim>::count)))
      given_.push_back({&p, {}});
}

template <int dim>
void Motion<dim>::find_given(double time) {
  for (Given &one : given_)
    one.rates = prescribed_rates(model_, *one.of, time);
}

template <int dim>
void Motion<dim>::multiply(Rates &rates) const {
  using Forces = RateForces<dim>;
  rates.momentum = model_.op.rate_product(Forces::Kind::inertia, rates.velocity);
  rates.inertia = model_.op.rate_product(Forces::Kind::inertia, rates.acceleration);
  rates.damping = model_.op.rate_product(Forces::Kind::damping, rates.velocity);
  rates.backward_damping = model_.op.rate_product(Forces::Kind::backward_damping, rates.difference);
}

template <int dim>
void Motion<dim>::begin(std::span<const double> state) {
  if (!forces_)
    return;
  if (is_inertial()) {
    rates_.velocity = initial_velocity(model_);
    rates_.difference = rates_.velocity;
    rates_.acceleration = initial_acceleration(model_, state, rates_.velocity);
  }
  multiply(rates_);
  describe(rates_);
  for (std::size_t i = 0; i < state.size(); ++i)
    if (model_.counts(i))
      record_.kinetic_energy += rates_.velocity[i] * rates_.momentum[i] / 2;
  record_.kinetic_energy = model_.sharing().sum(record_.kinetic_energy);
}

// Of given rates it is what leaves them of the product with the end's value.
template <int dim>
void Motion<dim>::add_history(double time, std::span<const double> before,
                              std::span<const double> now, std::vector<double> &right_side) {
  if (!forces_)
    return;
  find_given(time);
  const double k = model_.step;
  std::vector<double> known(before.size(), 0.);
  const auto fill = [&](const auto &rate) {
    for (std::size_t i = 0; i < known.size(); ++i)
      known[i] = field_of<dim>(i) == 0 ? rate(i) : 0;
  };
  const auto add = [&](typename RateForces<dim>::Kind kind) {
    const std::vector<double> product = model_.op.rate_product(kind, known);
    for (std::size_t i = 0; i < product.size(); ++i)
      right_side[i] += product[i];
  };
  const auto &v = rates_.velocity, &a = rates_.acceleration;
  if (is_inertial()) {
    fill([&](std::size_t i) { return 4 / (k * k) * before[i] + 4 / k * v[i] + a[i]; });
    for (const Given &one : given_)
      known[one.of->unknown] = 4 / (k * k) * now[one.of->unknown] - one.rates.acceleration;
    add(RateForces<dim>::Kind::inertia);
  }
  if (!forces_->is_damped())
    return;
  fill([&](std::size_t i) { return 2 / k * before[i] + v[i]; });
  for (const Given &one : given_)
    known[one.of->unknown] = 2 / k * now[one.of->unknown] - one.rates.velocity;
  add(RateForces<dim>::Kind::damping);
  fill([&](std::size_t i) { return before[i] / k; });
  add(RateForces<dim>::Kind::backward_damping);
}

template <int dim>
void Motion<dim>::end_step(std::span<const double> before, std::span<const double> now) {
  if (!forces_)
    return;
  const double k = model_.step;
  Rates next = rates_;
  std::vector<double> moved(now.size(), 0.);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (field_of<dim>(i) != 0)
      continue;
    const double d = moved[i] = now[i] - before[i];
    next.difference[i] = next.velocity[i] = d / k;
    if (!is_inertial() || forces_->is_massless(static_cast<body::Node>(i / Fields<dim>::count)))
      continue;
    next.velocity[i] = 2 * d / k - rates_.velocity[i];
    next.acceleration[i] = 4 / k * (d / k - rates_.velocity[i]) - rates_.acceleration[i];
  }
  for (const Given &one : given_) {
    next.velocity[one.of->unknown] = one.rates.velocity;
    next.acceleration[one.of->unknown] = one.rates.acceleration;
  }
  multiply(next);
  describe(next);
  add_energies(next, moved);
  rates_ = std::move(next);
}

// Damping takes k v.C v of the mean velocity, which is d / k but at supports.
template <int dim>
void Motion<dim>::add_energies(const Rates &next, std::span<const double> d) {
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (!model_.counts(i))
      continue;
    record_.dissipated += d[i] * next.backward_damping[i];
    if (!is_inertial())
      continue;
    const double moved = model_.step * (next.velocity[i] + rates_.velocity[i]) / 2,
                 damping = (rates_.damping[i] + next.damping[i]) / 2;
    record_.kinetic_energy += next.velocity[i] * next.momentum[i] / 2;
    record_.kinetic_gained +=
        (next.velocity[i] + rates_.velocity[i]) * (next.momentum[i] - rates_.momentum[i]) / 2;
    record_.dissipated += moved * damping;
    record_.lost += (d[i] - moved) * damping +
                    d[i] * (rates_.backward_damping[i] - next.backward_damping[i]) / 2;
  }
  if (!given_.empty())
    record_.lost += lost_at_supports(next, d);
  for (double *sum :
       {&record_.dissipated, &record_.kinetic_energy, &record_.kinetic_gained, &record_.lost})
    *sum = model_.sharing().sum(*sum);
}

// By how much d.M a of the mean of both ends exceeds the kinetic energy gained: with v and a the
// means, and what d and a are beyond k v and (v_n - v_(n-1)) / k at supports,
// d.M a = k v.M (v_n - v_(n-1)) / k + d.M (a - ...) + (d - k v).M (v_n - v_(n-1)) / k.
template <int dim>
double Motion<dim>::lost_at_supports(const Rates &next, std::span<const double> d) const {
  const double k = model_.step;
  std::vector<double> beyond(d.size(), 0.);
  double lost = 0;
  for (const Given &one : given_) {
    const std::size_t i = one.of->unknown;
    beyond[i] = (next.acceleration[i] + rates_.acceleration[i]) / 2 -
                (next.velocity[i] - rates_.velocity[i]) / k;
    if (model_.counts(i))
      lost += (d[i] / k - (next.velocity[i] + rates_.velocity[i]) / 2) *
              (next.momentum[i] - rates_.momentum[i]);
  }
  const std::vector<double> force = model_.op.rate_product(RateForces<dim>::Kind::inertia, beyond);
  for (std::size_t i = 0; i < d.size(); ++i)
    if (model_.counts(i))
      lost += d[i] * force[i];
  return lost;
}

// Forces and their resultants; energies are added by whoever knows the step.
template <int dim>
void Motion<dim>::describe(const Rates &now) {
  record_ = {};
  record_.forces.resize(now.inertia.size());
  for (std::size_t i = 0; i < now.inertia.size(); ++i) {
    const double damping = now.damping[i] + now.backward_damping[i],
                 inertia = is_inertial() ? now.inertia[i] : 0;
    record_.forces[i] = inertia + damping;
    if (const std::size_t c = i % Fields<dim>::count; c < dim && model_.counts(i)) {
      record_.inertia[c] -= inertia;
      record_.damping[c] -= damping;
    }
  }
  model_.sharing().sum(record_.inertia);
  model_.sharing().sum(record_.damping);
}

template <int dim>
void Motion<dim>::save(output::SavedNumbers &numbers) const {
  if (!forces_)
    return;
  numbers.put_field("velocity", rates_.velocity);
  numbers.put_field("acceleration", rates_.acceleration);
  numbers.put_field("mean velocity", rates_.difference);
}

template <int dim>
void Motion<dim>::restore(const output::SavedNumbers &numbers) {
  if (!forces_)
    return;
  numbers.fill("velocity", rates_.velocity);
  numbers.fill("acceleration", rates_.acceleration);
  numbers.fill("mean velocity", rates_.difference);
  multiply(rates_);
  describe(rates_);
}

template class Motion<2>;
template class Motion<3>;

}  // namespace tourmaline::solve
