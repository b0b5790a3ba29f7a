#pragma once

#include <span>
#include <string>
#include <vector>

#include "solve/model.h"

/// Temperatures are differences to the reference temperature theta_ref: one beyond theta_ref / 2 is
/// more likely an absolute one. None is refused, not even below absolute zero: the theory is
/// linear, and a tiny theta_ref is how a case does without thermoelastic heating.
namespace tourmaline::run {

/// Warnings of numbers among the prescribed, initial and foundation's temperatures beyond theta_ref
/// / 2 in size.
std::vector<std::string> temperature_warnings(const casefile::Case &asked);

/// A warning of temperatures in the body beyond theta_ref / 2 in size; empty when there are none.
template <int dim>
std::string temperature_warning(const solve::Model<dim> &model, std::span<const double> state);

}  // namespace tourmaline::run
