#include "solve/circuit.h"

#include <algorithm>

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

std::size_t index_of(const std::string &name,
                     const std::vector<casefile::ElectrodeCase> &electrodes) {
  const auto found = std::find_if(electrodes.begin(), electrodes.end(),
                                  [&](const auto &electrode) { return electrode.name == name; });
  return static_cast<std::size_t>(found - electrodes.begin());
}

}  // namespace

Circuit::Circuit(const std::vector<casefile::ElectrodeCase> &electrodes, double step) {
  for (std::size_t e = 0; e < electrodes.size(); ++e) {
    const casefile::ElectrodeCase &electrode = electrodes[e];
    if (!electrode.is_driven()) {
      free_.push_back(e);
      given_charge_.push_back(electrode.charge);
    }
    if (electrode.is_loaded())
      branches_.push_back(
          {e, electrode.to ? std::optional(index_of(*electrode.to, electrodes)) : std::nullopt,
           electrode.voltage.value_or(0.), electrode.resistor ? step / *electrode.resistor : 0,
           electrode.capacitor.value_or(0)});
  }
  const auto n = static_cast<Index>(free_.size());
  admittance_.setZero(n, n);
  for (const Branch &branch : branches_)
    add(branch);
}

std::optional<Index> Circuit::row_of(std::size_t electrode) const {
  const auto found = std::find(free_.begin(), free_.end(), electrode);
  return found == free_.end() ? std::nullopt : std::optional<Index>(found - free_.begin());
}

void Circuit::add(const Branch &branch) {
  const Index row = *row_of(branch.from);
  const double y = branch.leak + branch.capacitance;
  admittance_(row, row) += y;
  if (const auto other = branch.to ? row_of(*branch.to) : std::nullopt) {
    admittance_(*other, *other) += y;
    admittance_(row, *other) -= y;
    admittance_(*other, row) -= y;
  }
}

VectorXd Circuit::right_side(std::optional<double> before, double time, const VectorXd &charges,
                             const VectorXd &voltages_before, const VectorXd &voltages) const {
  VectorXd j = charges;
  for (const Branch &branch : branches_) {
    const Index row = *row_of(branch.from), from = static_cast<Index>(branch.from);
    const auto other = branch.to ? row_of(*branch.to) : std::nullopt;
    const Index to = branch.to ? static_cast<Index>(*branch.to) : 0;
    const double source_before = before ? branch.voltage.value({}, *before) : 0;
    const double end_before = branch.to ? voltages_before[to] : source_before;
    const double kept = branch.capacitance * (voltages_before[from] - end_before);
    j[row] += kept;
    if (other)
      j[*other] -= kept;
    else
      j[row] += (branch.leak + branch.capacitance) *
                (branch.to ? voltages[to] : branch.voltage.value({}, time));
  }
  for (std::size_t e = 0; e < given_charge_.size(); ++e)
    if (given_charge_[e])
      j[static_cast<Index>(e)] = given_charge_[e]->value({}, time);
  return j;
}

}  // namespace tourmaline::solve
