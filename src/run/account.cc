#include "run/account.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>

#include "parallel/ranks.h"
#include "run/process.h"

namespace tourmaline::run {

namespace {

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::size_t>(usage.ru_maxrss);
}

}  // namespace

Account::Account() : start_(process_age()) {}

void Account::step(int n, const solve::StepOutcome &outcome, double seconds) {
  newton_total_ += outcome.newton_iterations;
  newton_max_ = std::max(newton_max_, outcome.newton_iterations);
  if (n == 1)
    newton_first_ = outcome.newton_iterations;
  if (outcome.slip_jumped && ++slip_jumps_ == 1)
    first_slip_jump_ = n;
  in_steps_ += seconds;
  if (outcome.has_stages())
    ++stages_[static_cast<std::size_t>(outcome.stage)];
}

void Account::put(const solve::RouteReport &report, int steps, output::Summary &summary) const {
  put_iterations(report, summary);
  summary.factorisations = report.factorisations;
  summary.factorised_by = report.factorised_by;
  summary.instead_of_own = report.instead_of_own;
  if (report.negative_pivots >= 0)
    summary.negative_pivots = report.negative_pivots;
  summary.backward_error = report.backward_error;
  summary.forward_error = report.forward_error;
  summary.is_refined = report.is_refined;
  summary.seconds.start = start_;
  summary.seconds.analyse = report.analyse_seconds;
  summary.seconds.factorise = report.factorise_seconds;
  summary.seconds.condense = report.condense_seconds;
  summary.seconds.step = {in_steps_, in_steps_ / steps, report.substitution_seconds,
                          report.contact_seconds, report.estimate_seconds};
  summary.seconds.total = before_ + process_age();
  summary.peak_memory_bytes = parallel::sum(peak_memory());
}

void Account::put_iterations(const solve::RouteReport &report, output::Summary &summary) const {
  summary.iterations = {{"newton_total", newton_total_},
                        {"newton_max", newton_max_},
                        {"newton_first", newton_first_}};
  const bool has_stages =
      std::any_of(stages_.begin(), stages_.end(), [](double n) { return n > 0; });
  for (int stage = 1; has_stages && stage < solve::n_contact_stages; ++stage)
    summary
        .iterations[fmt::format("steps_by_{}", name_of(static_cast<solve::ContactStage>(stage)))] =
        static_cast<std::int64_t>(stages_[static_cast<std::size_t>(stage)]);
  if (slip_jumps_ > 0)
    summary.iterations["steps_with_slip_jumps"] = slip_jumps_;
  if (report.is_iterative) {
    summary.iterations["krylov_total"] = static_cast<std::int64_t>(report.krylov_iterations);
    summary.iterations["krylov_max"] = report.krylov_largest;
    summary.iterations["preconditioners"] = report.preconditioners;
    summary.iterations["safe_steps"] = report.safe_steps;
    summary.iterations["contact_columns"] = report.contact_columns;
  }
}

std::string Account::jump_warning(bool is_dynamic) const {
  if (slip_jumps_ == 0)
    return "";
  if (is_dynamic)
    return fmt::format(
        "slip jumped in {}: friction falls faster with slip than the body and its inertia over one "
        "step resist. Of several states that a step may then come to this is one; shorter steps "
        "leave one only",
        steps_with_jumps());
  return fmt::format(
      "slip jumped in {}: where it set in, friction falls faster with slip than the body unloads, "
      "and nothing quasistatic holds it until it has come to rest. What stands behind such a step "
      "is in equilibrium; of several such states it need not be the one that a simulation with "
      "inertia comes to",
      steps_with_jumps());
}

std::string Account::steps_with_jumps() const {
  return slip_jumps_ == 1
             ? fmt::format("step {}", first_slip_jump_)
             : fmt::format("{} steps, first in step {}", slip_jumps_, first_slip_jump_);
}

void Account::save(output::SavedNumbers &numbers) const {
  numbers.put("contact stages", stages_);
  numbers.put("newton", {double(newton_total_), double(newton_max_), double(newton_first_),
                         double(slip_jumps_), double(first_slip_jump_)});
  numbers.put("seconds", {in_steps_, before_ + process_age()});
}

void Account::restore(const output::SavedNumbers &numbers) {
  const auto stages = numbers.get("contact stages", stages_.size());
  std::copy(stages.begin(), stages.end(), stages_.begin());
  const auto newton = numbers.get("newton", 5);
  newton_total_ = static_cast<int>(newton[0]);
  newton_max_ = static_cast<int>(newton[1]);
  newton_first_ = static_cast<int>(newton[2]);
  slip_jumps_ = static_cast<int>(newton[3]);
  first_slip_jump_ = static_cast<int>(newton[4]);
  const auto seconds = numbers.get("seconds", 2);
  in_steps_ = seconds[0];
  before_ = seconds[1];
}

}  // namespace tourmaline::run
