#include "sweep_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <regex>

#include "limits.h"
#include "parallel/ranks.h"
#include "sweep/sweep.h"
#include "tourmaline/error.h"

namespace {

using tourmaline::sweep::Outcome;
using tourmaline::sweep::Request;

void tell(const Outcome &outcome, bool quiet) {
  for (const auto &failure : outcome.failures)
    std::cerr << "tourmaline: " << failure.member << " failed: " << failure.reason << '\n';
  for (const auto &[warning, members] : outcome.warnings)
    std::cerr << fmt::format(
        "tourmaline: warning in {}{}: {}\n", members.front(),
        members.size() > 1 ? fmt::format(" and {} more", members.size() - 1) : "", warning);
  if (!outcome.unwritten.empty())
    std::cerr << "tourmaline: " << outcome.unwritten << '\n';
  if (outcome.signal != 0)
    std::cerr << fmt::format(
        "tourmaline: stopped; {} of {} cases have not run to their end, and run when the same "
        "command is given again\n",
        outcome.missing, outcome.members);
  if (quiet)
    return;
  std::cout << fmt::format("{} cases: {} done before, {} failed\n", outcome.members, outcome.kept,
                           outcome.failures.size());
  for (const auto &file : outcome.files)
    std::cout << file.string() << '\n';
}

// Before there was --columns, --output was it: what looks like columns is no folder, unless it
// stands in one.
void require_folder(const std::string &output) {
  static const std::regex columns("[^/]*,[^/]*|(last|min|max|mean|rms):[^/]*|[^/]*@[0-9.]+");
  if (std::regex_match(output, columns))
    throw tourmaline::CaseError(fmt::format(
        "sweep --output {0}: --output is the folder of the study; what sweep.csv and sweep.svg "
        "show is chosen by --columns {0}. If a folder is meant, write ./{0}",
        output));
}

int sweep(Request request, char *name, const CommandLine &program) {
  if (tourmaline::parallel::is_launched())
    throw tourmaline::CaseError(
        "sweep: each case is run by a process of its own, so this command is given without mpirun; "
        "--jobs says how many run side by side");
  require_folder(request.folder.string());
  if (request.folder.empty())
    request.folder = std::filesystem::path("results") / (request.file.stem().string() + "-sweep");
  // Descriptors of this process mean others in its copies.
  if (std::error_code ignored; request.file.string().starts_with("/dev/"))
    if (const auto file = std::filesystem::canonical(request.file, ignored); !file.empty())
      request.file = file;
  request.program = [&](std::vector<std::string> words) {
    std::vector<char *> argv{name};
    for (std::string &word : words)
      argv.push_back(word.data());
    argv.push_back(nullptr);
    look_at_limits_of_copy(environ);
    return program(static_cast<int>(words.size()) + 1, argv.data());
  };
  const Outcome outcome = tourmaline::sweep::run(request);
  tell(outcome, request.quiet);
  return outcome.exit_status();
}

}  // namespace

void add_sweep(CLI::App &app, char *name, const CommandLine &program, int &status) {
  CLI::App *command = app.add_subcommand("sweep", "simulate a case for several values of its keys");
  const auto request = std::make_shared<Request>();
  command->add_option("CASE", request->file, "the case file (TOML)")->required();
  command
      ->add_option("--vary", request->variations,
                   "a key and its values: key.path=V1,V2,... or key.path=lin:A:B:N or "
                   "key.path=log:A:B:N, N values from A to B; of several --vary every value with "
                   "every other's")
      ->required()
      ->allow_extra_args(false);
  command
      ->add_option("--set", request->overrides,
                   "another value for a key of the case file, in all cases; may be given several "
                   "times")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--columns", request->outputs,
          "what sweep.csv and sweep.svg show: columns of history.csv, or of probes that are no "
          "lines as "
          "PROBE.COLUMN, NAME or last:NAME at the end, "
          "min:NAME, max:NAME, mean:NAME, rms:NAME over all steps, mean:NAME@FROM..TO over a part "
          "of the time, NAME@TIME at a time [s]; at_max_FIELD_x, ...: places of extremes. "
          "NAME,NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("-o,--output", request->folder,
                      "folder of the study, made when missing; results/<name of the case>-sweep if "
                      "not given");
  command
      ->add_option("--jobs", request->jobs,
                   "cases that run side by side; if not given as many as cores (over "
                   "solver.threads) and memory allow")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--trust", request->trust,
                    "let the script of a geometry (mesh.file) do anything that you may, without "
                    "limits of time and memory");
  command->add_flag("-q,--quiet", request->quiet, "print nothing but warnings and errors");
  command->callback([=, &status] { status = sweep(*request, name, program); });
}
