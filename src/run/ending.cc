#include "run/ending.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace tourmaline::run {

namespace {

constexpr std::array<const char *, 4> balances{"energy", "force", "charge", "heat"};

// A coordinate that is round-off beside the body's size is 0.
std::string place(int dimension, const Vector3 &point, double size) {
  std::string text;
  for (int c = 0; c < dimension; ++c)
    text += fmt::format("{}{:.4g}", c == 0 ? "(" : ", ",
                        std::abs(point[c]) <= 1e-12 * size ? 0. : point[c]);
  return text + ")";
}

std::string number(double value) {
  return fmt::format("{:.5g}", value == 0 ? 0. : value);
}

std::string line(const std::string &name, const std::string &text) {
  return fmt::format("  {:<13} {}\n", name, text);
}

std::string extreme_line(int dimension, const output::Extreme &extreme, double size) {
  const std::string most = number(extreme.maximum),
                    at_most = place(dimension, extreme.at_maximum, size);
  // A length has no interesting minimum.
  if (extreme.field == "displacement")
    return line(extreme.field, fmt::format("at most {} m, at {}", most, at_most));
  const char *unit = extreme.field == "potential" ? "V" : "K";
  return line(extreme.field,
              fmt::format("{} {} at {} to {} {} at {}", number(extreme.minimum), unit,
                          place(dimension, extreme.at_minimum, size), most, unit, at_most));
}

}  // namespace

void Highlights::see(const output::HistoryRow &row) {
  last_ = row;
  for (const char *balance : balances)
    for (const auto &[name, value] : row.quantities)
      // What is no number is worse than any.
      if (name == std::string(balance) + "_imbalance" && !(std::abs(value) <= imbalance_)) {
        imbalance_name_ = balance;
        imbalance_ = std::abs(value);
        imbalance_step_ = row.step;
      }
}

void Highlights::save(output::SavedNumbers &numbers) const {
  double which = -1;
  for (std::size_t i = 0; i < balances.size(); ++i)
    if (imbalance_name_ == balances[i])
      which = static_cast<double>(i);
  numbers.put("largest imbalance", {which, imbalance_, static_cast<double>(imbalance_step_)});
}

void Highlights::restore(const output::SavedNumbers &numbers) {
  const auto saved = numbers.get("largest imbalance", 3);
  imbalance_name_ = saved[0] < 0 ? "" : balances.at(static_cast<std::size_t>(saved[0]));
  imbalance_ = saved[1];
  imbalance_step_ = static_cast<int>(saved[2]);
}

std::string ending_text(int dimension, const Highlights &highlights,
                        const std::vector<output::Extreme> &extremes, double size) {
  const output::HistoryRow &last = highlights.last();
  std::string text = fmt::format("{} {} done, t = {:.6g} s\n", last.step,
                                 last.step == 1 ? "step" : "steps", last.time);
  for (const output::Extreme &extreme : extremes)
    text += extreme_line(dimension, extreme, size);
  if (last.stick + last.slip + last.open > 0)
    text += line("contact", fmt::format("{} of {} nodes stick, {} slip, {} are open", last.stick,
                                        last.stick + last.slip + last.open, last.slip, last.open));
  if (const double *pressure = last.find("max_pressure"))
    text += line("pressure", fmt::format("at most {} N/m^2, opening at most {} m",
                                         number(*pressure), number(*last.find("max_opening"))));
  if (!highlights.imbalance_name().empty())
    text += line("balances",
                 highlights.imbalance() == 0
                     ? "closed to the last digit"
                     : fmt::format("closed up to {:.1e} ({}, step {})", highlights.imbalance(),
                                   highlights.imbalance_name(), highlights.imbalance_step()));
  return text;
}

std::string places_text(const std::filesystem::path &directory) {
  std::string text = line("results", directory.string());
  if (std::error_code error; exists(directory / "report.html", error))
    text += line("report", (directory / "report.html").string());
  return text;
}

}  // namespace tourmaline::run
