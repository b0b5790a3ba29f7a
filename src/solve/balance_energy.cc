// The balance of energy; those of forces, charges and heat stand in balance.cc.

#include <algorithm>
#include <cmath>

#include "larger.h"
#include "solve/balance.h"
#include "solve/sized_sum.h"

namespace tourmaline::solve {

using body::Energies;

namespace {

template <int dim>
SizedSum sum_of_energy(const BalanceStep<dim> &step, const EnergyWorks &works, double gained,
                       double lost) {
  SizedSum sum;
  for (const double term : {gained, lost, -works.load, -works.electric, -works.thermal,
                            works.contact.friction, works.conduction, -works.contact.foundation,
                            works.contact.gained, works.contact.dissipated})
    sum.add(term);
  if (!step.rates.forces.empty())
    for (const double term : {step.rates.kinetic_gained, step.rates.dissipated})
      sum.add(term);
  sum.size += std::abs(step.now.stored.sum()) + std::abs(step.before.stored.sum()) +
              std::abs(step.rates.kinetic_energy);
  return sum;
}

// What each field takes from outside, with a minus, and gives.
template <int dim>
std::array<std::vector<double>, 3> by_field(const BalanceStep<dim> &step,
                                            const EnergyWorks &works) {
  std::array<std::vector<double>, 3> of{
      {{-works.load, works.contact.friction, -works.contact.foundation, works.contact.received},
       {-works.electric},
       {-works.thermal, works.conduction}}};
  if (!step.rates.forces.empty())
    of[0].insert(of[0].end(), {step.rates.dissipated, step.rates.kinetic_gained});
  return of;
}

}  // namespace

template <int dim>
void Balance<dim>::add_energy(const Step &step, Columns &columns) {
  const EnergyWorks works = energy_works(model_, step, is_prescribed_, can_open_);
  const Energies gain = step.change_of_energy(model_.sharing());
  std::array<double, 3> lost_by_field = works.by_scheme;
  double lost = works.by_scheme[0] + works.by_scheme[2];
  if (!step.is_dynamic()) {
    const Energies loss = step.energy_of_change(model_.sharing());
    lost_by_field = by_field(loss);
    lost = loss.sum();
  }
  lost += works.contact.lost();
  put_energies(step, works, gain.sum(), lost, columns);
  const SizedSum imbalance = sum_of_energy(step, works, gain.sum(), lost);
  double round_off = 0;
  for (const double of_field : step.round_off.energy)
    if (std::isfinite(of_field))
      round_off += of_field;
  put_imbalance("energy_imbalance", imbalance.value, imbalance.size, round_off, columns);
  judged_.back().second =
      lack_of_energy(step, imbalance.size, by_field(gain), lost_by_field, by_field(step, works));
}

template <int dim>
void Balance<dim>::put_energies(const Step &step, const EnergyWorks &works, double gained,
                                double lost, Columns &columns) const {
  const Energies &energy = step.now.stored, shift = model_.op.energy_shift(step.now.unknowns);
  const double k = model_.step;
  columns.insert(columns.end(), {{"elastic_energy", energy.elastic + shift.elastic},
                                 {"electric_energy", energy.electric + shift.electric},
                                 {"thermal_energy", energy.thermal + shift.thermal},
                                 {"coupling_energy", energy.coupling + shift.coupling},
                                 {"stored_energy_rate", gained / k},
                                 {"load_power", works.load / k},
                                 {"electric_power", works.electric / k},
                                 {"thermal_power", works.thermal / k},
                                 {"friction_dissipation", works.contact.friction / k},
                                 {"conduction_loss", works.conduction / k},
                                 {"time_step_loss", lost / k}});
  if (step.is_dynamic())
    columns.insert(columns.end(), {{"kinetic_energy", step.rates.kinetic_energy},
                                   {"kinetic_energy_rate", step.rates.kinetic_gained / k}});
  if (has_damping_columns())
    columns.emplace_back("viscous_dissipation", step.rates.dissipated / k);
  if (has_foundation_columns())
    columns.emplace_back("foundation_power", works.contact.foundation / k);
  if (model_.laws.can_open())
    columns.insert(columns.end(), {{"contact_energy", works.contact.stored},
                                   {"contact_dissipation", works.contact.dissipated / k}});
  if (works.contacts.size() > 1)
    put_each_contact(works, columns);
}

template <int dim>
void Balance<dim>::put_each_contact(const EnergyWorks &works, Columns &columns) const {
  const double k = model_.step;
  for (std::size_t i = 0; i < works.contacts.size(); ++i) {
    const ContactWorks &contact = works.contacts[i];
    const std::string name = "_" + model_.asked.contacts[i].called();
    columns.emplace_back("friction_dissipation" + name, contact.friction / k);
    if (has_foundation_columns())
      columns.emplace_back("foundation_power" + name, contact.foundation / k);
    if (model_.laws.can_open())
      columns.insert(columns.end(), {{"contact_energy" + name, contact.stored},
                                     {"contact_dissipation" + name, contact.dissipated / k}});
  }
}

// Energy that does not change hides no lack, and neither does that of fields, such as a
// temperature, that others are not coupled to: each set of coupled fields has a balance of its own.
// A field of which there is nothing may hold what a solver let through from the others, 1e-14 of
// their scaled unknowns or less.
template <int dim>
double Balance<dim>::lack_of_energy(const Step &step, double whole,
                                    const std::array<double, 3> &gained,
                                    const std::array<double, 3> &lost,
                                    const std::array<std::vector<double>, 3> &works) const {
  constexpr double leaked = 1e-28;
  double worst = 0;
  for (int f = 0; f < 3; ++f) {
    if (std::isinf(step.round_off.energy[f]))
      continue;
    double stored = 0, loss = 0, round_off = 0;
    SizedSum imbalance;
    for (int g = 0; g < 3; ++g) {
      if (g != f && !coupled_[f][g])
        continue;
      stored += gained[g];
      loss += lost[g];
      if (!std::isinf(step.round_off.energy[g]))
        round_off += step.round_off.energy[g];
      for (const double work : works[g])
        imbalance.add(work);
    }
    imbalance.add(stored);
    imbalance.add(loss);
    const double lacks = std::abs(imbalance.value);
    worst = larger(worst, relative_to(std::isnan(lacks) ? lacks : std::max(0., lacks - round_off),
                                      std::max({imbalance.size, round_off, leaked * whole})));
  }
  return worst;
}

template void Balance<2>::add_energy(const BalanceStep<2> &, Columns &);
template void Balance<2>::put_energies(const BalanceStep<2> &, const EnergyWorks &, double, double,
                                       Columns &) const;
template void Balance<2>::put_each_contact(const EnergyWorks &, Columns &) const;
template double Balance<2>::lack_of_energy(const BalanceStep<2> &, double,
                                           const std::array<double, 3> &,
                                           const std::array<double, 3> &,
                                           const std::array<std::vector<double>, 3> &) const;
template void Balance<3>::add_energy(const BalanceStep<3> &, Columns &);
template void Balance<3>::put_energies(const BalanceStep<3> &, const EnergyWorks &, double, double,
                                       Columns &) const;
template void Balance<3>::put_each_contact(const EnergyWorks &, Columns &) const;
template double Balance<3>::lack_of_energy(const BalanceStep<3> &, double,
                                           const std::array<double, 3> &,
                                           const std::array<double, 3> &,
                                           const std::array<std::vector<double>, 3> &) const;

}  // namespace tourmaline::solve
