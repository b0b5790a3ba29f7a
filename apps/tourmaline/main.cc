#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/json_schema.h"
#include "case/nearest.h"
#include "case/reference.h"
#include "case/resolved.h"
#include "case/snapping.h"
#include "material/description.h"
#include "output/folder_lock.h"
#include "parallel/available_memory.h"
#include "parallel/ranks.h"
#include "printable_output.h"
#include "report/figures.h"
#include "report/page.h"
#include "run/dense_kernels.h"
#include "run/expected_cost.h"
#include "run/lone_error.h"
#include "run/process.h"
#include "run/survey.h"
#include "sweep_command.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"
#include "tourmaline/run/simulation.h"

namespace {

enum ExitStatus { done = 0, wrong_case = 2, solve_failed = 3, machine_failed = 4 };

/// What the command line asked for.
struct Asked {
  std::filesystem::path file, directory;
  std::vector<std::filesystem::path> folders;
  std::vector<std::string> overrides;
  std::string material, materials_file;
  bool quiet = false, resume = false, json = false, trust = false;
  std::string format = "svg";
  std::vector<std::string> fields;
  std::optional<double> time;
  double megabytes = 0;
};

// A rank alone may not find its files.
tourmaline::casefile::Case case_of(const Asked &asked) {
  try {
    return tourmaline::casefile::read_file(
        asked.file, asked.overrides, tourmaline::mesh::mesh_file_reader({.trusted = asked.trust}));
  } catch (const tourmaline::Error &error) {
    tourmaline::run::require_error_of_all(error);
    throw;
  }
}

void run(const Asked &asked) {
  const auto read = case_of(asked);
  const auto directory = asked.directory.empty()
                             ? std::filesystem::path("results") / asked.file.stem()
                             : asked.directory;
  using tourmaline::run::Start;
  tourmaline::run::simulate(
      read, directory,
      {.quiet = asked.quiet, .start = asked.resume ? Start::checkpoint : Start::beginning});
}

void check(const Asked &asked) {
  const auto read = case_of(asked);
  tourmaline::run::check(read);
  const std::string cost = tourmaline::run::expected_cost(read);
  std::cout << tourmaline::casefile::resolved(read) << tourmaline::run::survey(read) << cost;
  for (const std::string &warning : tourmaline::casefile::snapping_warnings(read))
    std::cout << "\n# warning: " << warning << "\n";
}

void materials(const Asked &asked) {
  using namespace tourmaline::material;
  if (asked.material.empty()) {
    std::cout << (asked.json ? library_json(asked.materials_file)
                             : describe_library(asked.materials_file));
    return;
  }
  tourmaline::casefile::MaterialCase material;
  material.library = asked.material;
  if (!asked.materials_file.empty())
    material.file = asked.materials_file;
  std::cout << (asked.json ? entry_json(material) : describe(material));
}

// Two folders are no part of each other, so their page stands beside them, where one stands now.
void report_page(const Asked &asked) {
  const std::filesystem::path file = !asked.file.empty()         ? asked.file
                                     : asked.folders.size() == 1 ? asked.folders[0] / "report.html"
                                                                 : "report.html";
  // A run that is at work there makes its page itself.
  tourmaline::output::require_unused(file.has_parent_path() ? file.parent_path() : ".");
  tourmaline::report::write_page(asked.folders, file,
                                 static_cast<std::size_t>(asked.megabytes * 1e6));
  std::cout << file.string() << '\n';
}

void figures(const Asked &asked) {
  const tourmaline::report::FigureRequest request{tourmaline::report::figure_format(asked.format),
                                                  asked.fields, asked.time};
  const std::filesystem::path &folder = asked.folders.front();
  const auto files = tourmaline::report::write_figures(
      folder, asked.directory.empty() ? folder / "figures" : asked.directory, request);
  for (const std::filesystem::path &file : files)
    std::cout << file.string() << '\n';
}

void add_case(CLI::App &command, Asked &asked) {
  command.add_option("CASE", asked.file, "the case file (TOML)")->required();
  command
      .add_option(
          "--set", asked.overrides,
          "another value for a key of the case file, key.path=value with the value as TOML; "
          "may be given several times")
      ->allow_extra_args(false);
  command.add_flag("--trust", asked.trust,
                   "let the script of a geometry (mesh.file) do anything that you may, without "
                   "limits of time and memory");
}

void add_run(CLI::App &app, Asked &asked) {
  CLI::App *command = app.add_subcommand("run", "simulate a case");
  add_case(*command, asked);
  command->add_option(
      "-o,--output", asked.directory,
      "folder of the results, made when missing; results/<name of the case> if not given");
  command->add_flag("-q,--quiet", asked.quiet, "print nothing but warnings and errors");
  command->add_flag("--resume", asked.resume,
                    "go on with the interrupted run of this case in that folder; without a "
                    "checkpoint there, from the beginning");
  command->callback([&asked] { run(asked); });
}

void add_check(CLI::App &app, Asked &asked) {
  CLI::App *command =
      app.add_subcommand("check", "check a case and print it with all defaults filled in");
  add_case(*command, asked);
  command->callback([&asked] { check(asked); });
}

void add_report(CLI::App &app, Asked &asked) {
  CLI::App *command =
      app.add_subcommand("report", "make the page of one result folder, or of two side by side");
  command->add_option("DIR", asked.folders, "folders that `run` left; one or two")
      ->required()
      ->expected(1, 2);
  command->add_option("-o,--output", asked.file,
                      "the page; if not given DIR/report.html, of two folders report.html");
  command
      ->add_option(
          "--size", asked.megabytes,
          "how large the page may be [MB], 1 to 10000: it holds as many moments of the fields "
          "as fit; if not given some 12 million numbers")
      ->check(CLI::Range(1., 1e4));
  command->callback([&asked] { report_page(asked); });
}

void add_figures(CLI::App &app, Asked &asked) {
  CLI::App *command = app.add_subcommand("figures", "draw figures of a result folder for a paper");
  command->add_option("DIR", asked.folders, "a folder that `run` left")->required()->expected(1);
  command->add_option("-o,--output", asked.directory,
                      "folder of the figures, made when missing; DIR/figures if not given");
  command->add_option("--format", asked.format, "svg, png or pdf; svg if not given");
  command
      ->add_option("--field", asked.fields,
                   "a field to draw, NAME or NAME.COMPONENT, or a curve along the contact, "
                   "contact.pressure, contact.gap or another contact.COLUMN; may be given several "
                   "times; if not given, what the paper shows")
      ->allow_extra_args(false);
  command->add_option(
      "--time", asked.time,
      "the moment [s], inside the run; the nearest field file is taken, if not given the last");
  command->callback([&asked] { figures(asked); });
}

void add_materials(CLI::App &app, Asked &asked) {
  CLI::App *command = app.add_subcommand("materials", "list the built-in materials, or show one");
  command->add_option("NAME", asked.material, "the material to show");
  command->add_option("--file", asked.materials_file, "a file of materials instead of the library");
  command->add_flag("--json", asked.json,
                    "print it as JSON, for programs: constants, and what a case must add");
  command->callback([&asked] { materials(asked); });
}

void add_reference(CLI::App &app) {
  app.add_subcommand("reference", "print the reference of the case file: every key")->callback([] {
    std::cout << tourmaline::casefile::reference_page();
  });
}

void add_schema(CLI::App &app) {
  app.add_subcommand("schema", "print the JSON Schema of the case file, for editors")->callback([] {
    std::cout << tourmaline::casefile::json_schema();
  });
}

// CLI11 says of a misspelt command only that one is missing.
void check_command(const CLI::App &app, int argc, char **argv) {
  if (argc < 2 || argv[1][0] == '-')
    return;
  std::vector<std::string> names;
  for (const CLI::App *command : app.get_subcommands([](const CLI::App *) { return true; })) {
    if (command->get_name() == argv[1])
      return;
    names.push_back(command->get_name());
  }
  throw tourmaline::CaseError("there is no command \"" + std::string(argv[1]) + "\"" +
                              tourmaline::casefile::did_you_mean(argv[1], names) +
                              "; see tourmaline --help");
}

int answer(int argc, char **argv);

/// Throws what the commands throw; of the errors on the command line, CLI11's are reported here.
int obey(int argc, char **argv) {
  Asked asked;
  int status = done;
  CLI::App app("Frictional contact of thermo-piezoelectric bodies.", "tourmaline");
  app.set_version_flag("--version", "tourmaline " TOURMALINE_VERSION
                                    "\ndense kernels of OpenBLAS: " +
                                        tourmaline::run::dense_kernels());
  app.set_help_all_flag("--help-all", "the help of all commands");
  app.require_subcommand(1);
  app.failure_message([](const CLI::App *, const CLI::Error &error) {
    return std::string("tourmaline: ") + error.what() + "; see tourmaline --help\n";
  });
  add_run(app, asked);
  add_sweep(app, argv[0], answer, status);
  add_check(app, asked);
  add_report(app, asked);
  add_figures(app, asked);
  add_materials(app, asked);
  add_schema(app);
  add_reference(app);
  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return app.exit(error, std::cout, std::cerr) == 0 ? done : wrong_case;
  }
  if (!std::cout.flush())
    throw tourmaline::MachineError("the standard output cannot be written");
  return status;
}

// Errors of the parts that the program is made of may run over several lines with empty ones
// between.
std::string one_paragraph(const std::string &text) {
  std::string joined;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
    if (!blank)
      joined += c;
    else if (!joined.empty() && joined.back() != ' ')
      joined += ' ';
  }
  return joined;
}

std::string in_shell(const std::string &argument) {
  constexpr const char *plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./=,:+@%";
  if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos)
    return argument;
  std::string quoted = "'";
  for (const char c : argument)
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The command with which a run that was stopped goes on.
std::string resuming_command(int argc, char **argv) {
  const int ranks = tourmaline::parallel::n_ranks();
  std::string command = ranks > 1 ? "mpirun -np " + std::to_string(ranks) + " " : "";
  bool resumes = false;
  for (int i = 0; i < argc; ++i) {
    command += (i > 0 ? " " : "") + in_shell(argv[i]);
    resumes |= std::string(argv[i]) == "--resume";
  }
  return command + (resumes ? "" : " --resume");
}

// All ranks end with the same error; one tells it.
int report(int status, const std::string &text) {
  if (tourmaline::parallel::speaks())
    std::cerr << "tourmaline: " << one_paragraph(text) << '\n';
  return status;
}

/// Whether what is asked for factorises, or says with what it would.
bool uses_dense_kernels(int argc, char **argv) {
  constexpr std::array<std::string_view, 4> asked{"run", "check", "sweep", "--version"};
  return argc > 1 && std::ranges::find(asked, argv[1]) != asked.end();
}

/// What the program does, and its exit status.
int answer(int argc, char **argv) {
  try {
    if (uses_dense_kernels(argc, argv))
      tourmaline::run::start_again_with_better_kernels(argv);
    // Of all else that it is asked for one process does all.
    const bool runs = argc > 1 && std::string_view(argv[1]) == "run";
    if (!runs && !tourmaline::parallel::speaks())
      return done;
    // MPI runs until an error has been told: a rank that ended before the first one has spoken
    // would take it along.
    if (runs && tourmaline::parallel::is_launched())
      tourmaline::run::start_process(1);
    return obey(argc, argv);
  } catch (const tourmaline::CaseError &error) {
    return report(wrong_case, error.what());
  } catch (const tourmaline::SolveError &error) {
    return report(solve_failed, error.what());
  } catch (const tourmaline::MachineError &error) {
    return report(machine_failed, error.what());
  } catch (const tourmaline::Stopped &stop) {
    return report(128 + stop.signal,
                  std::string(stop.what()) + "; to go on: " + resuming_command(argc, argv));
  } catch (const std::bad_alloc &) {
    return report(machine_failed, "not enough memory");
  } catch (const std::exception &error) {
    return report(machine_failed, error.what());
  }
}

// OpenBLAS, started halfway, would wait for its threads for ever at an ordered end.
void require_room_or_end() {
  try {
    tourmaline::parallel::require_room_to_start();
  } catch (const tourmaline::MachineError &error) {
    std::_Exit(report(machine_failed, error.what()));
  }
}

// Of standard streams that are closed: a file of the results that got one would have what is
// printed in it.
void keep_standard_descriptors() {
  int next = ::open("/dev/null", O_RDONLY);
  while (next >= 0 && next <= STDERR_FILENO)
    next = ::open("/dev/null", O_RDONLY);
  ::close(next);
}

}  // namespace

int main(int argc, char **argv) {
  keep_standard_descriptors();
  const PrintableOutput said(std::cout), complained(std::cerr);
  // A write beyond the limit of file sizes (ulimit -f) fails like one on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  require_room_or_end();
  return answer(argc, argv);
}
