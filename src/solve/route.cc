#include "solve/route.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/fields.h"
#include "condensation/factorisation.h"
#include "larger.h"

namespace tourmaline::solve {

namespace {

double largest_so_far(double before, double now) {
  return std::isnan(before) ? now : larger(before, now);
}

}  // namespace

const char *name_of(ContactStage stage) {
  switch (stage) {
    case ContactStage::convex:
      return "convex";
    case ContactStage::newton:
      return "newton";
    case ContactStage::fixed_point:
      return "fixed_point";
    case ContactStage::continuation:
      return "continuation";
  }
  return "unknown";
}

void Route::see_backward_error(double error) {
  so_far_.backward_error = largest_so_far(so_far_.backward_error, error);
}

void Route::see_forward_error(double error) {
  so_far_.forward_error = largest_so_far(so_far_.forward_error, error);
}

template <int dim>
bool Route::outgrew_measured(const body::NodeSharing &sharing, std::span<const double> state) {
  constexpr double times = 10;
  std::array<double, 3> size{};
  for (std::size_t i = 0; i < state.size(); ++i)
    size[body::field_of<dim>(i)] = larger(size[body::field_of<dim>(i)], std::abs(state[i]));
  sharing.largest(size);
  bool outgrew = false;
  for (std::size_t f = 0; f < size.size(); ++f)
    if (size[f] > times * measured_[f]) {
      measured_[f] = size[f];
      outgrew = true;
    }
  return outgrew;
}

template bool Route::outgrew_measured<2>(const body::NodeSharing &, std::span<const double>);
template bool Route::outgrew_measured<3>(const body::NodeSharing &, std::span<const double>);

void Route::forget_errors() {
  so_far_.backward_error = so_far_.forward_error = std::numeric_limits<double>::quiet_NaN();
}

void Route::add_factorisation(const condensation::FactorisationStatistics &statistics,
                              RouteReport &report) {
  report.analyse_seconds = statistics.analyse_seconds;
  report.factorise_seconds += statistics.factorise_seconds;
  report.factor_entries = statistics.factor_entries;
  report.factor_flops = statistics.flops;
  report.factorised_by = statistics.solver;
  report.instead_of_own = statistics.reason;
}

RouteReport Route::report() const {
  RouteReport report = so_far_;
  report.is_refined = is_refined();
  describe(report);
  return report;
}

void Route::save(output::SavedNumbers &numbers) const {
  const RouteReport now = report();
  numbers.put("route", {now.backward_error, now.forward_error, double(now.is_refined),
                        double(now.factorisations), now.factorise_seconds, now.substitution_seconds,
                        now.contact_seconds, double(now.krylov_iterations),
                        double(now.krylov_largest), double(now.safe_steps), measured_[0],
                        measured_[1], measured_[2], now.estimate_seconds});
  save_memory(numbers);
}

void Route::restore(const output::SavedNumbers &numbers, bool of_other_step) {
  const auto before = numbers.get("route", 14);
  so_far_.backward_error = before[0];
  so_far_.forward_error = before[1];
  if (before[2] != 0 && !is_refined())
    refine_again();
  so_far_.factorisations = static_cast<int>(before[3]);
  so_far_.factorise_seconds = before[4];
  so_far_.substitution_seconds = before[5];
  so_far_.contact_seconds = before[6];
  so_far_.krylov_iterations = static_cast<std::size_t>(before[7]);
  so_far_.krylov_largest = static_cast<int>(before[8]);
  so_far_.safe_steps = static_cast<int>(before[9]);
  std::copy_n(before.begin() + 10, measured_.size(), measured_.begin());
  so_far_.estimate_seconds = before[13];
  restore_memory(numbers);
  if (of_other_step)
    forget_matrices();
}

Route::Memory Route::memory() const {
  Memory memory{measured_, {}};
  save_memory(memory.numbers);
  return memory;
}

Route::Handover Route::hand_over() {
  Handover done{report(), memory()};
  is_counted_ = true;
  return done;
}

void Route::take_over(const Handover &other) {
  const RouteReport &all = other.report;
  RouteReport own;
  if (is_counted_)
    describe(own);
  so_far_.backward_error = all.backward_error;
  so_far_.forward_error = all.forward_error;
  so_far_.factorisations = all.factorisations - own.factorisations;
  so_far_.factorise_seconds = all.factorise_seconds - own.factorise_seconds;
  so_far_.condense_seconds = all.condense_seconds + (is_counted_ ? 0 : so_far_.condense_seconds);
  so_far_.substitution_seconds = all.substitution_seconds - own.substitution_seconds;
  so_far_.contact_seconds = all.contact_seconds;
  so_far_.estimate_seconds = all.estimate_seconds;
  so_far_.krylov_iterations = all.krylov_iterations;
  so_far_.krylov_largest = all.krylov_largest;
  so_far_.safe_steps = all.safe_steps;
  measured_ = other.memory.measured;
  if (all.is_refined && !is_refined())
    refine_again();
  restore_memory(other.memory.numbers);
  forget_matrices();
}

}  // namespace tourmaline::solve
