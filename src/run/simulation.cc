#include "tourmaline/run/simulation.h"

#include <fmt/format.h>

#include <iostream>

#include "material/composition.h"
#include "parallel/ranks.h"
#include "run/memory.h"
#include "run/process.h"
#include "run/resumption.h"
#include "run/temperatures.h"
#include "run/time_loop.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

void check(const casefile::Case &asked) {
  if (asked.dimension == 2)
    material::Composition<2>{asked};
  else
    material::Composition<3>{asked};
  check_temperatures(asked);
  parallel::together([&] { require_memory(asked); });
}

namespace {

void say(const std::string &text, bool quiet) {
  if (!quiet && parallel::is_first())
    std::cerr << "tourmaline: " << text << '\n';
}

// A complete run in a folder that cannot be written to needs no lock to be seen.
Resumption complete_run_in(const std::filesystem::path &directory, const casefile::Case &asked,
                           const MachineError &no_lock) {
  output::require_unused(directory);
  const Resumption found = resumption(asked, directory);
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
      found = complete_run_in(directory, asked, error);
    }
  });
  found.has_all_steps = found.has_report = parallel::from_first(found.is_complete()) != 0;
  if (resumes && !found.is_complete())
    parallel::together([&] { found = resumption(asked, directory); });
  return found;
}

void tell_start(const Resumption &found, const casefile::Case &asked, const std::string &name,
                bool quiet) {
  if (found.is_complete())
    say("the run in " + name + " is complete; there is nothing to go on with", quiet);
  else if (found.has_all_steps)
    say("all steps of the run in " + name + " are done; making its page, which is missing", quiet);
  else if (found.checkpoint)
    say(fmt::format("going on in {} after step {} of {}", name, found.checkpoint->step,
                    asked.time.steps),
        quiet);
  else
    say("there is no checkpoint in " + name + "; starting from the beginning", quiet);
}

}  // namespace

void simulate(const casefile::Case &asked, const std::filesystem::path &directory,
              const RunOptions &options) {
  const Process process(asked.solver.threads);
  check(asked);
  std::unique_ptr<output::FolderLock> lock;  // of the first rank
  Resumption from = find_in(directory, asked, options, lock);
  if (options.start == Start::checkpoint)
    tell_start(from, asked, directory.string(), options.quiet);
  if (from.has_all_steps) {
    parallel::on_first([&] {
      std::error_code ignored;  // of a folder that cannot be written to
      std::filesystem::remove(directory / output::checkpoint_name, ignored);
      if (!from.has_report)
        put_page_in(directory);
    });
    if (!options.quiet && parallel::is_first())
      std::cout << places_text(directory) << std::flush;
    return;
  }
  const casefile::Case limited = above_absolute_zero(asked);
  try {
    if (asked.dimension == 2)
      TimeLoop<2>(limited, directory, options, std::move(from.checkpoint), std::move(lock)).run();
    else
      TimeLoop<3>(limited, directory, options, std::move(from.checkpoint), std::move(lock)).run();
  } catch (const Error &) {
    throw;  // is that of all ranks
  } catch (const std::exception &error) {
    if (parallel::n_ranks() == 1)
      throw;
    std::cerr << "tourmaline: on rank " << parallel::rank() << ": " << error.what() << '\n';
    parallel::end_all(4);
  }
}

}  // namespace tourmaline::run
