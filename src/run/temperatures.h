#pragma once

#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "output/records.h"
#include "tourmaline/case/case.h"

/// Temperatures are differences to the reference temperature theta_ref: one beyond theta_ref / 2 is
/// more likely an absolute one. None is refused, not even below absolute zero: the theory is
/// linear, and a tiny theta_ref is how a case does without thermoelastic heating.
namespace tourmaline::run {

/// Warnings of numbers among the prescribed, initial and foundation's temperatures beyond theta_ref
/// / 2 in size.
std::vector<std::string> temperature_warnings(const casefile::Case &asked);

/// The temperature of a run that lies farthest from the reference temperature.
class TemperaturePeak {
 public:
  /// Before the first step.
  void begin(const std::vector<output::Extreme> &extremes);
  void step(const output::HistoryRow &row);
  /// A warning of one beyond theta_ref / 2 in size; empty when there was none.
  std::string warning(double reference) const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  void see(double temperature, int n, double time);

  double value_ = 0;  // difference to theta_ref [K]
  int step_ = 0;      // when it was first there
  double time_ = 0;
};

}  // namespace tourmaline::run
