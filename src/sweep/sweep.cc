#include "sweep/sweep.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "case/key_unit.h"
#include "output/atomic_file.h"
#include "output/folder_lock.h"
#include "output/status_line.h"
#include "prepared.h"
#include "stopwatch.h"
#include "sweep/chosen_outputs.h"
#include "sweep/processes.h"
#include "sweep/read_outputs.h"
#include "sweep/results.h"
#include "tourmaline/error.h"

namespace tourmaline::sweep {

namespace {

namespace fs = std::filesystem;

constexpr int machine_failed = 4;

void make(const fs::path &folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw MachineError(
        fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

// What the run said, on one line and without the program's name; nothing when somebody has taken
// the file away.
std::string said(const fs::path &log) {
  std::ifstream words(log);
  std::string text;
  for (std::string word; words >> word;)
    text += (text.empty() ? "" : " ") + word;
  constexpr std::string_view name = "tourmaline: ";
  return text.starts_with(name) ? text.substr(name.size()) : text;
}

// That of summary.json, where it can be read.
std::vector<std::string> warnings_in(const fs::path &folder) {
  std::ifstream in(folder / "summary.json");
  const auto summary = nlohmann::json::parse(in, nullptr, false);
  std::vector<std::string> warnings;
  if (summary.is_object() && summary.contains("warnings"))
    for (const auto &warning : summary["warnings"])
      if (warning.is_string())
        warnings.push_back(warning.get<std::string>());
  return warnings;
}

std::string reason_of(int status, const fs::path &log) {
  if (std::string text = said(log); !text.empty())
    return text;
  if (status > 128)
    return fmt::format("was killed by the signal {} ({})", status - 128, strsignal(status - 128));
  return fmt::format("ended with the exit status {} and no word", status);
}

// A killed run has not said what it would: that is the machine's failure.
int failure_status(int status) {
  return status >= 2 && status <= machine_failed ? status : machine_failed;
}

/// The members of a study while they run.
class Study {
 public:
  Study(const Request &request, Results &results, const std::vector<Prepared> &cases)
      : request_(request),
        results_(results),
        cases_(cases),
        found_(cases.size()),
        jobs_(request.jobs > 0 ? static_cast<std::size_t>(request.jobs) : jobs_for(cases)) {
    outcome_.members = results.members.size();
  }

  Outcome run() {
    for (std::size_t i = 0; i < results_.members.size(); ++i)
      if (!keep(i))
        waiting_.push_back(i);
    outcome_.kept = outcome_.members - waiting_.size();
    while (started_ < waiting_.size() || processes_.running() > 0) {
      fill();
      if (const auto end = processes_.wait(std::chrono::milliseconds(200)))
        finish(*end);
      obey_signal();
      show();
      if (outcome_.signal != 0 && processes_.running() == 0)
        break;
    }
    outcome_.missing =
        static_cast<std::size_t>(std::count_if(results_.rows.begin(), results_.rows.end(),
                                               [](const Row &r) { return r.status == "stopped"; }));
    return outcome_;
  }

 private:
  fs::path folder_of(std::size_t i) const { return request_.folder / results_.members[i].name; }
  fs::path log_of(std::size_t i) const { return folder_of(i) / "error.txt"; }

  // Whether the member is done already; a folder that cannot be read is none.
  bool keep(std::size_t i) {
    found_[i] = found_in(folder_of(i), cases_[i]);
    if (found_[i].state != Found::State::done)
      return false;
    try {
      take_results(i);
    } catch (const CaseError &) {
      found_[i] = {};
      return false;
    }
    forget_words(i);  // of one that was done when the sweep before was killed
    return true;
  }

  void forget_words(std::size_t i) {
    std::error_code ignored;
    fs::remove(log_of(i), ignored);
  }

  void fill() {
    while (outcome_.signal == 0 && started_ < waiting_.size() && processes_.running() < jobs_)
      start(waiting_[started_++]);
  }

  void start(std::size_t i) {
    std::vector<std::string> command{"run", request_.file.string(), "--quiet", "-o",
                                     folder_of(i).string()};
    const auto add = [&](const std::string &override) {
      command.emplace_back("--set");
      command.push_back(override);
    };
    if (request_.trust)
      command.emplace_back("--trust");
    std::for_each(request_.overrides.begin(), request_.overrides.end(), add);
    for (const std::string &override : overrides_of(results_.variations, results_.members[i]))
      add(override);
    try {
      make(folder_of(i));
      if (found_[i].state == Found::State::interrupted)
        command.emplace_back("--resume");
      if (!found_[i].obstacle.empty() && !request_.quiet)
        say(
            fmt::format("tourmaline: {} starts from the beginning, as its interrupted run cannot "
                        "go on: {}\n",
                        results_.members[i].name, found_[i].obstacle));
      processes_.start(
          i, [&] { return request_.program(command); }, log_of(i));
    } catch (const MachineError &error) {
      ++finished_;
      fail(i, machine_failed, error.what());
    }
  }

  void finish(const Processes::End &end) {
    const std::size_t i = end.number;
    if (end.status != 0 && outcome_.signal == 0) {
      ++finished_;
      return fail(i, failure_status(end.status), reason_of(end.status, log_of(i)));
    }
    forget_words(i);
    if (end.status != 0)
      return;
    ++finished_;
    if (found_in(folder_of(i), cases_[i]).state != Found::State::done)
      return fail(i, machine_failed, "its folder no longer holds the whole run of this case");
    try {
      take_results(i);
    } catch (const CaseError &error) {
      fail(i, machine_failed, error.what());
    }
  }

  void take_results(std::size_t i) {
    results_.rows[i] = {"done", read_outputs(folder_of(i), results_.outputs)};
    for (const std::string &warning : warnings_in(folder_of(i)))
      outcome_.warnings[warning].push_back(results_.members[i].name);
  }

  void fail(std::size_t i, int status, const std::string &reason) {
    results_.rows[i].status = "failed";
    outcome_.failures.push_back({results_.members[i].name, reason, status});
  }

  void say(const std::string &text) {
    line_.clear();
    std::cerr << text;
  }

  // The first signal asks the runs to end, the second does not ask.
  void obey_signal() {
    const int signal = processes_.take_signal();
    if (signal == 0)
      return;
    processes_.send(outcome_.signal == 0 ? signal : SIGKILL);
    outcome_.signal = signal;
  }

  void show() {
    seconds_ += watch_.lap();
    if (request_.quiet || !line_.is_terminal())
      return;
    const std::size_t n = waiting_.size(), done = outcome_.kept + finished_;
    std::string text =
        fmt::format("{}/{} done, {} running", done, outcome_.members, processes_.running());
    if (!outcome_.failures.empty())
      text += fmt::format(", {} failed", outcome_.failures.size());
    if (outcome_.signal != 0)
      text += ", stopping";
    else if (finished_ > 0)
      text +=
          fmt::format(", {} left", output::duration_text(seconds_ / static_cast<double>(finished_) *
                                                         static_cast<double>(n - finished_)));
    line_.draw(text, static_cast<int>(done), static_cast<int>(outcome_.members));
  }

  const Request &request_;
  Results &results_;
  const std::vector<Prepared> &cases_;
  std::vector<Found> found_;
  std::size_t jobs_;
  std::vector<std::size_t> waiting_;  // members to be run
  std::size_t started_ = 0, finished_ = 0;
  Outcome outcome_;
  Processes processes_;
  output::StatusLine line_;
  Stopwatch watch_;
  double seconds_ = 0;
};

std::vector<fs::path> write_results(const Results &results, const fs::path &folder) {
  std::vector<fs::path> files{folder / "sweep.csv"};
  output::write_file(files.front(), table_text(results));
  if (std::any_of(results.rows.begin(), results.rows.end(),
                  [](const Row &row) { return row.status == "done"; })) {
    files.push_back(folder / "sweep.svg");
    report::write_plot(plot_of(results), report::FigureFormat::svg, files.back());
  }
  return files;
}

}  // namespace

int Outcome::exit_status() const {
  if (signal != 0)
    return 128 + signal;
  int status = unwritten.empty() ? 0 : machine_failed;
  for (const Failure &failure : failures)
    status = std::max(status, failure.status);
  return status;
}

Outcome run(const Request &request) {
  Results results;
  results.variations = read_variations(request.variations);
  require_not_set(results.variations, request.overrides);
  results.members = members_of(results.variations);
  const std::vector<Prepared> cases = prepared(request, results.variations, results.members);
  std::vector<casefile::Case> asked;
  asked.reserve(cases.size());
  for (const Prepared &one : cases)
    asked.push_back(one.asked);
  results.outputs = chosen_outputs(request.outputs, asked);
  const std::vector<double> none(results.outputs.size(), std::numeric_limits<double>::quiet_NaN());
  if (!asked.empty())
    results.key_unit = casefile::unit_of_key(results.variations.front().key, asked.front());
  results.rows.assign(results.members.size(), {"stopped", none});
  const output::FolderLock lock(request.folder);  // before anything there is looked at
  Outcome outcome = Study(request, results, cases).run();
  try {
    outcome.files = write_results(results, request.folder);
  } catch (const MachineError &error) {
    outcome.unwritten = error.what();
  }
  return outcome;
}

}  // namespace tourmaline::sweep
