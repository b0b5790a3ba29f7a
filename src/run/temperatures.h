#pragma once

#include <span>
#include <string>
#include <vector>

#include "solve/model.h"

/// Temperatures are differences to the reference temperature theta_ref: none is below -theta_ref,
/// and one beyond theta_ref / 2 is more likely an absolute one.
namespace tourmaline::run {

/// Throws CaseError for a prescribed, initial or foundation's temperature, a number, that is not
/// above absolute zero.
void check_temperatures(const casefile::Case &asked);

/// The case with formulas of these temperatures that throw CaseError, with place and time, where
/// their value is not above absolute zero.
casefile::Case above_absolute_zero(const casefile::Case &asked);

/// Warnings of numbers among these temperatures beyond theta_ref / 2 in size.
std::vector<std::string> temperature_warnings(const casefile::Case &asked);

/// A warning of temperatures in the body beyond theta_ref / 2 in size; empty when there are none.
template <int dim>
std::string temperature_warning(const solve::Model<dim> &model, std::span<const double> state);

}  // namespace tourmaline::run
