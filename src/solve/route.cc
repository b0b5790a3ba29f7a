#include "solve/route.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "body/fields.h"
#include "condensation/factorisation.h"
#include "larger.h"

namespace tourmaline::solve {

namespace {

double largest_so_far(double before, double now) {
  return std::isnan(before) ? now : larger(before, now);
}

// What adds up over the steps, through the routes and the processes of a run.
template <typename Report>
void for_each_count(Report &report, const auto &of_count) {
  of_count(report.factorisations);
  of_count(report.factorise_seconds);
  of_count(report.condense_seconds);
  of_count(report.substitution_seconds);
  of_count(report.contact_seconds);
  of_count(report.estimate_seconds);
  of_count(report.krylov_iterations);
  of_count(report.krylov_largest);  // which a route has in `so_far_` alone
  of_count(report.preconditioners);
  of_count(report.safe_steps);
  of_count(report.contact_columns);
}

std::vector<double> counts_of(const RouteReport &report) {
  std::vector<double> counts;
  for_each_count(report, [&](auto count) { counts.push_back(static_cast<double>(count)); });
  return counts;
}

void set_counts(RouteReport &report, std::span<const double> counts) {
  auto next = counts.begin();
  for_each_count(report,
                 [&]<typename Count>(Count &count) { count = static_cast<Count>(*next++); });
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

void Route::say(const char *what, int done, int all) const {
  if (listener_)
    listener_(what, done, all);
}

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
  numbers.put("route", {now.backward_error, now.forward_error, double(now.is_refined), measured_[0],
                        measured_[1], measured_[2]});
  numbers.put("route's counts", counts_of(now));
  save_memory(numbers);
}

void Route::restore(const output::SavedNumbers &numbers, bool of_other_step) {
  const auto before = numbers.get("route", 6);
  so_far_.backward_error = before[0];
  so_far_.forward_error = before[1];
  if (before[2] != 0 && !is_refined())
    refine_again();
  std::copy_n(before.begin() + 3, measured_.size(), measured_.begin());
  set_counts(so_far_, numbers.get("route's counts", counts_of(so_far_).size()));
  restore_memory(numbers);
  if (of_other_step)
    return forget_matrices();
  RouteReport own;
  describe(own);
  so_far_.preconditioners -= own.preconditioners;  // which are those that it had
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
  std::vector<double> before = counts_of(all);
  std::ranges::transform(before, counts_of(own), before.begin(), std::minus<>());
  set_counts(so_far_, before);
  measured_ = other.memory.measured;
  if (all.is_refined && !is_refined())
    refine_again();
  restore_memory(other.memory.numbers);
  forget_matrices();
}

}  // namespace tourmaline::solve
