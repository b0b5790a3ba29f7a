#include "tourmaline/run/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <new>

#include "material/composition.h"
#include "parallel/ranks.h"
#include "run/lone_error.h"
#include "run/memory.h"
#include "run/process.h"
#include "run/rehearsal.h"
#include "run/resumption.h"
#include "run/start_state.h"
#include "run/time_loop.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

void check(const casefile::Case &asked) {
  if (asked.dimension == 2)
    material::Composition<2>{asked};
  else
    material::Composition<3>{asked};
  parallel::together([&] { require_memory(asked); });
}

void check_thoroughly(const casefile::Case &asked) {
  check(asked);
  rehearse(asked);
}

namespace {

void say(const std::string &text, bool quiet) {
  if (!quiet && parallel::is_first())
    std::cerr << "tourmaline: " << text << '\n';
}

// A complete run in a folder that cannot be written to needs no lock to be seen.
Resumption complete_run_in(const std::filesystem::path &directory, const casefile::Case &asked,
                           const RunOptions &options, const MachineError &no_lock) {
  output::require_unused(directory);
  Resumption found = resumption(asked, directory, options.friction_name);
  if (!found.is_complete())
    throw no_lock;
  return found;
}

// What the folder holds is looked at behind the lock, or another run might change it meanwhile. All
// ranks see the same folder.
Resumption find_in(const std::filesystem::path &directory, const casefile::Case &asked,
                   const RunOptions &options, std::unique_ptr<output::FolderLock> &lock) {
  Resumption found;
  const bool resumes = options.start == Start::checkpoint;
  parallel::on_first([&] {
    try {
      lock = std::make_unique<output::FolderLock>(directory);
    } catch (const MachineError &error) {
      if (!resumes)
        throw;
      found = complete_run_in(directory, asked, options, error);
    }
  });
  found.has_all_steps = found.has_report = parallel::from_first(found.is_complete()) != 0;
  if (resumes && !found.is_complete())
    parallel::together([&] { found = resumption(asked, directory, options.friction_name); });
  return found;
}

// Without being asked how loudly, as all warnings.
void tell_warning(const Resumption &found) {
  if (!found.warning.empty() && parallel::is_first())
    std::cerr << "tourmaline: warning: " << found.warning << '\n';
}

void tell_start(const Resumption &found, const casefile::Case &asked, const std::string &name,
                bool quiet) {
  if (found.is_complete())
    say("the run in " + name + " is complete; there is nothing to go on with", quiet);
  else if (found.has_all_steps)
    say("all steps of the run in " + name + " are done; making its page, which is missing", quiet);
  else if (found.checkpoint)
    say(fmt::format("going on in {} after step {}{}", name, found.checkpoint->step,
                    asked.time.tolerance ? "" : fmt::format(" of {}", asked.time.steps)),
        quiet);
  else
    say("there is no checkpoint in " + name + "; starting from the beginning", quiet);
}

// The name stands in a line of its own in files.
void require_sense(const casefile::Case &asked, const RunOptions &options) {
  const std::string &name = options.friction_name;
  if (!options.friction && !name.empty())
    throw CaseError(
        fmt::format("the program names friction laws, \"{}\", and gives none: set "
                    "RunOptions::friction",
                    name));
  if (!options.friction)
    return;
  if (asked.contacts.empty())
    throw CaseError(asked.source +
                    ": has no [contact], where the program's friction laws could stand");
  if (name.find_first_not_of(' ') == std::string::npos ||
      std::ranges::any_of(name, [](unsigned char c) { return c < ' ' || c == 127; }))
    throw CaseError(
        "the program gives friction laws without a name: RunOptions::friction_name must be one "
        "line with the law and all its parameters, as a run that goes on is known by it");
}

void put_what_is_missing(const Resumption &found, const std::filesystem::path &directory) {
  std::error_code ignored;  // of a folder that cannot be written to
  std::filesystem::remove(directory / output::checkpoint_name, ignored);
  if (!found.has_report)
    put_page_in(directory);
}

void run_in(const casefile::Case &asked, const std::filesystem::path &directory,
            const RunOptions &options) {
  start_process(asked.solver.threads);
  require_sense(asked, options);
  check(asked);
  parallel::on_first([&] { require_other_folder(asked.initial, directory); });
  std::unique_ptr<output::FolderLock> lock;  // of the first rank
  Resumption from = find_in(directory, asked, options, lock);
  if (options.start == Start::checkpoint)
    tell_start(from, asked, directory.string(), options.quiet);
  tell_warning(from);
  if (from.has_all_steps) {
    parallel::on_first([&] { put_what_is_missing(from, directory); });
    if (!options.quiet && parallel::is_first())
      std::cout << places_text(directory) << std::flush;
    return;
  }
  if (asked.dimension == 2)
    TimeLoop<2>(asked, directory, options, std::move(from.checkpoint), std::move(lock)).run();
  else
    TimeLoop<3>(asked, directory, options, std::move(from.checkpoint), std::move(lock)).run();
}

// What is no error of this library, on this rank and maybe no other.
[[noreturn]] void end_with(const char *what) {
  if (parallel::n_ranks() == 1)
    throw MachineError(what);
  std::cerr << "tourmaline: on rank " << parallel::rank() << ": " << what << '\n';
  parallel::end_all(4);
}

}  // namespace

void simulate(const casefile::Case &asked, const std::filesystem::path &directory,
              const RunOptions &options) {
  try {
    run_in(asked, directory, options);
  } catch (const Error &error) {
    require_error_of_all(error);
    throw;
  } catch (const std::bad_alloc &) {
    end_with("not enough memory");
  } catch (const std::exception &error) {
    end_with(error.what());
  }
}

}  // namespace tourmaline::run
