#include "solve/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

constexpr double dubious = 1e-6, wrong = 0.1;
constexpr double unheld = 1e-5;  // of forces on a body that slides

constexpr std::array titles{"the balance of energy", "the balance of forces",
                            "the balance of charges", "the balance of heat"};

constexpr const char *reason =
    "the body is probably ill-conditioned: very thin, barely held, or of constants that differ by "
    "many powers of ten";

// Nothing was measured where it is 0 or no number.
std::string known(const char *name, double value) {
  return value > 0 ? fmt::format(", {} {:.1e}", name, value) : "";
}

}  // namespace

const char *const ill_conditioned_advice =
    "lower solver.tolerance where it has been raised, look for a body that is very thin or barely "
    "held, and for constants or units that differ by "
    "many powers of ten; hold it at more places, model a thin part thicker or shorter, or, unless "
    "it is taken already, use solver.method = \"condensed\" with solver.body = \"direct\", which "
    "refines its solutions";

void Judgement::step(int n, double time,
                     const std::vector<std::pair<std::string, double>> &imbalances,
                     const std::function<Accuracy()> &measure) {
  for (const auto &[name, value] : imbalances)
    require_held(n, time, name, std::abs(value));
  for (const auto &[name, value] : imbalances) {
    const auto i = std::find(names.begin(), names.end(), name) - names.begin();
    const double size = std::abs(value);
    if (!(size <= wrong)) {
      const Accuracy accuracy = measure();
      throw SolveError(fmt::format(
          "step {}, t = {:g} s: {} lacks {:.2g} of the size of its terms ({}{}{}), so the solution "
          "has no digit that is certain, and nothing of this step was written; {}",
          n, time, titles[i], size, name, known("backward error", accuracy.backward_error),
          known("estimated forward error", accuracy.forward_error), ill_conditioned_advice));
    }
    if (size > worst_[i].value)
      worst_[i] = {size, static_cast<double>(n), time};
  }
}

void Judgement::require_held(int n, double time, const std::string &name, double lacks) const {
  if (left_to_contact_.empty() || name != "force_imbalance" || !(lacks > unheld))
    return;
  throw SolveError(fmt::format(
      "step {}, t = {:g} s: loads and contact forces differ by {:.1e} of their size "
      "(force_imbalance). Nothing but contact keeps the body from {}, and under these loads the "
      "contact does not: the body slides, or leaves. Nothing of this step was written. Prescribe "
      "further components of `displacement`, press the body to the foundation, or let inertia or "
      "damping resist (time.regime = \"dynamic\")",
      n, time, lacks, left_to_contact_));
}

void Judgement::forward_error(int n, double time, const Accuracy &accuracy) {
  const double error = accuracy.forward_error;
  if (std::isnan(error) || error <= error_.value)
    return;
  if (!(error <= wrong))
    throw SolveError(fmt::format(
        "step {}, t = {:g} s: the error of the solution is estimated at {:.2g} of its size{}, so "
        "it "
        "has no digit that is certain, and nothing of this step was written; {}",
        n, time, error, known("backward error", accuracy.backward_error), ill_conditioned_advice));
  error_ = {error, static_cast<double>(n), time};
}

std::vector<std::string> Judgement::warnings() const {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < worst_.size(); ++i)
    if (worst_[i].value > dubious)
      texts.push_back(fmt::format(
          "{} lacks up to {:.1e} of the size of its terms ({}, step {:.0f}, t = {:g} s): of the "
          "results no more digits than that are certain; {}",
          titles[i], worst_[i].value, names[i], worst_[i].step, worst_[i].time, reason));
  if (error_.value > dubious)
    texts.push_back(fmt::format(
        "the error of the solution is estimated at {:.1e} of its size (forward_error, step {:.0f}, "
        "t = {:g} s): no more digits than that are certain; {}",
        error_.value, error_.step, error_.time, reason));
  return texts;
}

void Judgement::save(output::SavedNumbers &numbers) const {
  std::vector<double> all{error_.value, error_.step, error_.time};
  for (const Worst &worst : worst_)
    all.insert(all.end(), {worst.value, worst.step, worst.time});
  numbers.put("judgement", all);
}

void Judgement::restore(const output::SavedNumbers &numbers) {
  const auto all = numbers.get("judgement", 3 * (1 + worst_.size()));
  error_ = {all[0], all[1], all[2]};
  for (std::size_t i = 0; i < worst_.size(); ++i)
    worst_[i] = {all[3 * i + 3], all[3 * i + 4], all[3 * i + 5]};
}

}  // namespace tourmaline::solve
