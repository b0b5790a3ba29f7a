#include "sweep/chosen_outputs.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "case/nearest.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::sweep {

namespace {

std::vector<std::string> usual_names(const std::vector<casefile::Case> &cases) {
  std::vector<std::string> names{"max_displacement", "min_potential", "max_potential",
                                 "min_temperature", "max_temperature"};
  if (std::any_of(cases.begin(), cases.end(),
                  [](const auto &one) { return !one.contacts.empty(); }))
    names.insert(names.begin(), "slip");
  std::erase_if(names, [&](const std::string &name) {
    const std::size_t field = name.find('_');
    return field != std::string::npos &&
           std::none_of(cases.begin(), cases.end(), [&](const casefile::Case &one) {
             return one.model.has(name.substr(field + 1));
           });
  });
  return names;
}

// Columns of probes, whose names may begin so, have a point.
bool is_place(const std::string &name) {
  return name.starts_with(of_place) && name.find('.') == std::string::npos;
}

std::string joined(const std::vector<std::string> &names, bool places) {
  std::string text;
  for (const std::string &name : names)
    if (is_place(name) == places)
      text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Reads what stands after `--columns`.
class Chooser {
 public:
  Chooser(std::vector<Output> possible, double end) : possible_(std::move(possible)), end_(end) {
    for (const Output &output : possible_)
      names_.push_back(output.name);
  }

  Output choose(const std::string &name) const {
    if (const Output *output = find(name))  // first, as names of boundaries may have colons
      return *output;
    const auto at = name.rfind('@'), colon = name.find(':');
    const bool is_reduced = colon != std::string::npos && reduction_named(name.substr(0, colon));
    if (is_reduced && at != std::string::npos && !find(name.substr(colon + 1)))
      return in_window(name, colon, at);
    if (!is_reduced && at != std::string::npos)
      return at_time(name, at);
    if (colon != std::string::npos)
      return reduced_column(name, colon);
    fail_unknown(name, "", name, "");
  }

 private:
  [[noreturn]] void fail(const std::string &name, const std::string &reason) const {
    throw CaseError("--columns " + casefile::shortened(name) + ": " + reason);
  }

  [[noreturn]] void fail_unknown(const std::string &name, const std::string &before,
                                 const std::string &column, const std::string &behind) const {
    const auto meant = casefile::nearest(column, names_);
    fail(name,
         "no column of history.csv or of a probe that is no line, as PROBE.COLUMN, and no place of "
         "an extreme is "
         "called so" +
             (meant ? "; did you mean \"" + before + *meant + behind + "\"?" : "") +
             "; allowed: " + joined(names_, false) +
             ", each also as min:NAME, max:NAME, mean:NAME, rms:NAME, last:NAME or NAME@TIME, "
             "the first four also over a part of the time, mean:NAME@FROM..TO" +
             ", and " + joined(names_, true) + "; the folder of a study is said by -o or --output");
  }

  // WORD:NAME@FROM..TO
  Output in_window(const std::string &name, std::size_t colon, std::size_t at) const {
    const std::string word = name.substr(0, colon + 1), time = name.substr(at),
                      column = name.substr(colon + 1, at - colon - 1);
    Reduction reduction = *reduction_named(name.substr(0, colon));
    const auto dots = time.find("..");
    if (!find(column))
      fail_unknown(name, word, column, dots == std::string::npos ? "" : time);
    if (dots == std::string::npos)
      fail(name, fmt::format("{0} and {1} each make one number of a column, and here are both; "
                             "write {0}{2} or {2}{1}, or {0}{2}@FROM..TO of a part of the time",
                             word, time, column));
    if (reduction.kind == Reduction::Kind::last)
      fail(name, fmt::format("the last value of a part of the time is {}@{}; write that", column,
                             time.substr(dots + 2)));
    const auto from = seconds(time.substr(1, dots - 1)), to = seconds(time.substr(dots + 2));
    if (!from || !to || !(*from >= 0 && *from < *to && *to <= end_))
      fail(name,
           fmt::format("behind @ must be two numbers of seconds, FROM..TO, the first at least "
                       "0, the second above it and at most {}, the end of the runs",
                       end_));
    reduction.window = Reduction::Window{*from, *to};
    return made_of(name, word, column, time, reduction);
  }

  static std::optional<double> seconds(const std::string &text) {
    double time = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
    if (error != std::errc() || end != text.data() + text.size())
      return std::nullopt;
    return time;
  }

  const Output *find(const std::string &name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? nullptr : &possible_[found - names_.begin()];
  }

  Output made_of(const std::string &name, const std::string &before, const std::string &column,
                 const std::string &behind, const Reduction &reduction) const {
    const Output *output = find(column);
    if (!output)
      fail_unknown(name, before, column, behind);
    if (is_place(column))
      fail(name, column + " is a place, which a run has at its end only; write " + column);
    return {name, output->unit, column, reduction};
  }

  Output reduced_column(const std::string &name, std::size_t colon) const {
    const std::string word = name.substr(0, colon);
    const auto reduction = reduction_named(word);
    if (!reduction)
      fail(name, "\"" + word + "\" is nothing that can be made of a column" +
                     casefile::did_you_mean(word, reduction_words()) +
                     "; allowed: last:NAME, min:NAME, max:NAME, mean:NAME, rms:NAME, NAME@TIME");
    return made_of(name, name.substr(0, colon + 1), name.substr(colon + 1), "", *reduction);
  }

  Output at_time(const std::string &name, std::size_t at) const {
    const std::string text = name.substr(at + 1);
    if (text.find("..") != std::string::npos)
      fail(name, fmt::format("a part of the time has many values; write mean:{0}, or rms:, min: or "
                             "max:",
                             name));
    const std::optional<double> time = seconds(text);
    if (!time || !(*time > 0 && *time <= end_))
      fail(name, fmt::format("the time behind @ must be a number of seconds, above 0 and at most "
                             "{}, the end of the runs; write NAME@TIME",
                             end_));
    return made_of(name, "", name.substr(0, at), name.substr(at),
                   {.kind = Reduction::Kind::at, .time = *time});
  }

  std::vector<Output> possible_;
  std::vector<std::string> names_;
  double end_;  // of the longest run [s]
};

bool is_same(const Output &one, const Output &other) {
  const auto column = [](const Output &o) { return o.column.empty() ? o.name : o.column; };
  return column(one) == column(other) && one.reduction == other.reduction;
}

}  // namespace

std::vector<Output> chosen_outputs(const std::vector<std::string> &names,
                                   const std::vector<casefile::Case> &cases) {
  double end = 0;
  for (const casefile::Case &one : cases)
    end = std::max(end, one.time.end);
  const Chooser chooser(outputs_of(cases), end);
  std::vector<Output> chosen;
  for (const std::string &name : names.empty() ? usual_names(cases) : names) {
    Output output = chooser.choose(name);
    if (std::any_of(chosen.begin(), chosen.end(),
                    [&](const Output &before) { return is_same(before, output); }))
      throw CaseError("--columns " + name + ": is asked for twice");
    chosen.push_back(std::move(output));
  }
  return chosen;
}

}  // namespace tourmaline::sweep
