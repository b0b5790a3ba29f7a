#include "tourmaline/run/simulation.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <iostream>

#include "case/electrodes.h"
#include "case/interval.h"
#include "case/resolved.h"
#include "material/composition.h"
#include "output/progress.h"
#include "parallel/ranks.h"
#include "report/page.h"
#include "run/available_memory.h"
#include "run/ending.h"
#include "run/locking.h"
#include "run/memory.h"
#include "run/plausibility.h"
#include "run/process.h"
#include "run/recorder.h"
#include "run/resumption.h"
#include "run/schedule.h"
#include "run/step_check.h"
#include "run/survey.h"
#include "run/versions.h"
#include "solve/condensed_route.h"
#include "solve/iterative_route.h"
#include "solve/monolithic_route.h"
#include "stopwatch.h"
#include "tourmaline/contact/friction.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

namespace {

template <int dim>
class Simulation {
 public:
  /// Starts behind the checkpoint, if there is one.
  Simulation(const casefile::Case &asked, const std::filesystem::path &directory,
             const RunOptions &options, std::optional<output::Checkpoint> checkpoint,
             std::unique_ptr<output::FolderLock> lock);
  void run();

 private:
  void open_folder(const std::filesystem::path &directory,
                   std::unique_ptr<output::FolderLock> lock);
  int begin();
  void march(int first, Schedule &schedule);
  output::Summary take_steps(int first, Schedule &schedule);
  void prescribe(double time, std::vector<double> &state) const;
  void sum_loads(double time);
  void step(int n);
  solve::StepOutcome advance(int n);
  void go_back_to_direct(int n, const SolveError &error);
  void pause(int n, const Schedule::Pause &pause);
  void save(int n);
  void restore();
  output::Summary close_tables(Schedule &schedule);
  void put_report();
  void keep_what_there_is();
  std::string what_is_left() const;
  void tell(const output::Summary &done, int signal) const;
  output::Summary summary() const;

  double start_seconds_ = process_age();
  std::optional<output::Checkpoint> checkpoint_;  // to start from
  std::string inputs_;                            // of the run, for later checkpoints
  std::map<std::string, std::string> contents_;   // of the files it reads: digests
  bool quiet_;
  output::Progress progress_;
  bool iterative_;       // decided once: what is available changes with what is taken
  int direct_from_ = 0;  // the step from which on it is not, after all
  solve::Model<dim> model_;
  std::vector<double> state_;  // of the last step that is done
  std::vector<double> next_, loads_, right_side_;
  std::optional<output::ResultFolder> folder_;
  std::optional<Recorder<dim>> recorder_;
  std::unique_ptr<solve::Route> route_;
  int done_ = 0;        // steps
  int saved_step_ = 0;  // of the checkpoint that is there; 0: none
  Highlights highlights_;
  std::optional<LockingWatch<dim>> locking_;
  int newton_total_ = 0, newton_max_ = 0, newton_first_ = 0;
  double step_seconds_ = 0, seconds_before_ = 0;  // before: of the processes that it goes on from
};

template <int dim>
std::unique_ptr<solve::Route> make_route(const solve::Model<dim> &model, bool iterative) {
  if (model.asked.solver.method == "monolithic")
    return solve::monolithic_route(model);
  if (iterative) {
    casefile::require_given_voltages(model.asked, "the iterative solver");
    return solve::iterative_route(model);
  }
  return solve::condensed_route(model);
}

// The steps are done: what is missing then is only the page.
void put_report_in(const std::filesystem::path &directory) {
  try {
    report::write_page({directory}, directory / "report.html");
  } catch (const MachineError &error) {
    throw MachineError(fmt::format("{}; all other results are in {}, and --resume makes the page",
                                   error.what(), directory.string()));
  }
}

// Evaluates the case's formulas once before anything is written: a formula that is undefined
// somewhere should not leave a folder behind. Then opens the folder, which may fail, before the
// factorisation.
template <int dim>
Simulation<dim>::Simulation(const casefile::Case &asked, const std::filesystem::path &directory,
                            const RunOptions &options, std::optional<output::Checkpoint> checkpoint,
                            std::unique_ptr<output::FolderLock> lock)
    : checkpoint_(std::move(checkpoint)),
      inputs_(parallel::is_first() ? inputs_of(asked) : ""),
      contents_(parallel::is_first() ? contents_of(asked) : decltype(contents_){}),
      quiet_(options.quiet),
      progress_(asked.time.steps, options.quiet || !parallel::is_first()),
      iterative_(checkpoint_ ? checkpoint_->numbers.get("iterative", 1)[0] != 0
                             : solves_iteratively(asked)),
      model_((progress_.stage("mesh and operator"), asked)) {
  state_ = body::initial_state(model_.body, asked.initial);
  std::vector<double> trial = state_;
  prescribe(model_.time(1), trial);
  sum_loads(model_.time(1));
  for (const auto &node : model_.interface)
    model_.friction(
        contact::contact_place(node.point, model_.time(1), Eigen::Matrix<double, dim, 0>{}));
  if (options.friction)
    model_.friction = options.friction;
  open_folder(directory, std::move(lock));
  recorder_.emplace(model_, *folder_);
  locking_.emplace(model_);
  progress_.stage(iterative_ ? "preconditioner" : "factorisation");
  route_ = make_route(model_, iterative_);
}

template <int dim>
void Simulation<dim>::open_folder(const std::filesystem::path &directory,
                                  std::unique_ptr<output::FolderLock> lock) {
  const output::Piece piece{parallel::rank(), parallel::n_ranks()};
  const auto open = [&] {
    if (checkpoint_)
      folder_.emplace(directory, dim, piece, *checkpoint_, std::move(lock));
    else
      folder_.emplace(directory, dim, piece, std::move(lock));
  };
  parallel::on_first([&] {
    open();
    folder_->put_case(casefile::resolved(model_.asked));
  });
  if (!folder_)
    open();
}

// Returns the first step to take.
template <int dim>
int Simulation<dim>::begin() {
  if (!checkpoint_) {
    recorder_->initial(state_);
    return 1;
  }
  restore();
  done_ = saved_step_ = static_cast<int>(checkpoint_->step);
  checkpoint_.reset();
  return done_ + 1;
}

template <int dim>
void Simulation<dim>::prescribe(double time, std::vector<double> &state) const {
  for (const body::Prescribed &p : model_.prescribed)
    state[p.unknown] = p.value.value(p.point, time);
}

template <int dim>
void Simulation<dim>::sum_loads(double time) {
  loads_.assign(model_.n_unknowns(), 0.);
  model_.loads.integrate(time, loads_);
}

template <int dim>
solve::StepOutcome Simulation<dim>::advance(int n) {
  next_ = state_;
  prescribe(model_.time(n), next_);
  try {
    return route_->advance(model_.time(n), right_side_, state_, next_);
  } catch (const SolveError &error) {
    if (!iterative_ || model_.asked.solver.body != "automatic")
      throw;
    go_back_to_direct(n, error);
    return advance(n);
  }
}

// "automatic" took the iterative solution to save memory. Where that fails, a factorisation is
// worth all the memory that there is.
template <int dim>
void Simulation<dim>::go_back_to_direct(int n, const SolveError &error) {
  route_.reset();
  const double needed = factorised_memory(model_.asked), available = available_memory().bytes;
  if (parallel::from_first(needed > available) != 0)
    throw SolveError(
        fmt::format("{} A factorisation needs about {:.3g} GiB of memory, and {:.3g} "
                    "GiB are available",
                    error.what(), needed / (1 << 30), available / (1 << 30)));
  iterative_ = false;
  direct_from_ = n;
  progress_.stage("factorisation");
  route_ = make_route(model_, iterative_);
}

template <int dim>
void Simulation<dim>::step(int n) {
  Stopwatch watch;
  sum_loads(model_.time(n));
  StepCheck(n, model_.time(n)).loads(dim, model_.body.points(), loads_);
  right_side_ = loads_;
  if (route_->is_refined())
    model_.cells.add_history(state_, right_side_);
  else
    model_.op.add_history(state_, right_side_);
  const solve::StepOutcome outcome = advance(n);
  newton_total_ += outcome.newton_iterations;
  newton_max_ = std::max(newton_max_, outcome.newton_iterations);
  if (n == 1)
    newton_first_ = outcome.newton_iterations;
  step_seconds_ += watch.lap();
  const output::HistoryRow row = recorder_->step(n, outcome, loads_, state_, next_, *route_, [&] {
    return route_->accuracy(right_side_, next_, outcome);
  });
  highlights_.see(row);
  locking_->step(row, next_);
  progress_.step(row);
  std::swap(state_, next_);
  done_ = n;
}

template <int dim>
void Simulation<dim>::march(int first, Schedule &schedule) {
  for (int n = first; n <= model_.asked.time.steps; ++n) {
    step(n);
    if (n < model_.asked.time.steps)
      pause(n, schedule.after(n));
  }
}

template <int dim>
void Simulation<dim>::pause(int n, const Schedule::Pause &pause) {
  if (pause.saves)
    save(n);
  if (pause.stopped_by != 0)
    throw Stopped(fmt::format("stopped by {} after step {} of {}; the results of these steps and a "
                              "checkpoint are in {}",
                              signal_name(pause.stopped_by), n, model_.asked.time.steps,
                              folder_->directory().string()),
                  pause.stopped_by);
}

template <int dim>
void Simulation<dim>::run() {
  const int first = begin();
  Schedule schedule(casefile::interval(model_.asked.output.checkpoint));
  const output::Summary done = take_steps(first, schedule);
  // From here on only the page may be missing, which `--resume` makes.
  parallel::on_first([&] { put_report(); });
  progress_.done();
  tell(done, schedule.received());
}

// The error that ends the steps also says where those before it are.
template <int dim>
output::Summary Simulation<dim>::take_steps(int first, Schedule &schedule) {
  try {
    march(first, schedule);
    return close_tables(schedule);
  } catch (const CaseError &error) {
    keep_what_there_is();
    throw CaseError(error.what() + what_is_left());
  } catch (const SolveError &error) {
    keep_what_there_is();
    throw SolveError(error.what() + what_is_left());
  } catch (const MachineError &error) {
    keep_what_there_is();
    throw MachineError(
        error.what() + what_is_left() +
        (saved_step_ > 0 ? fmt::format("; --resume goes on after step {}", saved_step_) : ""));
  } catch (const Stopped &) {
    keep_what_there_is();
    throw;
  } catch (const std::exception &) {
    if (parallel::n_ranks() == 1)  // otherwise the others know nothing of it
      keep_what_there_is();
    throw;
  }
}

template <int dim>
std::string Simulation<dim>::what_is_left() const {
  if (done_ == 0)
    return "; no step has been computed";
  return fmt::format("; the results of {} of {} are in {}",
                     done_ == 1 ? "step 1" : fmt::format("steps 1 to {}", done_),
                     model_.asked.time.steps, folder_->directory().string());
}

// From now on a signal lets the run be finished: it is nearly done.
template <int dim>
output::Summary Simulation<dim>::close_tables(Schedule &schedule) {
  if (parallel::is_first())
    schedule.answer(
        "tourmaline: all steps are done; the results are being finished (a second signal ends "
        "this at once)\n");
  recorder_->finish(state_);
  const output::Summary done = summary();
  parallel::on_first([&] { folder_->put_summary(done); });
  return done;
}

double largest_extent(const std::vector<Vector3> &points) {
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] =
        std::minmax_element(points.begin(), points.end(),
                            [axis](const auto &a, const auto &b) { return a[axis] < b[axis]; });
    largest = std::max(largest, (*most)[axis] - (*least)[axis]);
  }
  return largest;
}

template <int dim>
void Simulation<dim>::tell(const output::Summary &done, int signal) const {
  if (!parallel::is_first())
    return;
  for (const std::string &warning : done.warnings)
    std::cerr << "tourmaline: warning: " << warning << '\n';
  if (signal != 0)
    std::cerr << fmt::format("tourmaline: {} came when all steps were done; the run is complete\n",
                             signal_name(signal));
  if (!quiet_)
    std::cout << ending_text(dim, highlights_, done.extremes, largest_extent(model_.body.points()))
              << places_text(folder_->directory()) << std::flush;
}

// Everything that later steps, or what is told of the run at its end, depend on.
template <int dim>
void Simulation<dim>::save(int n) {
  parallel::on_first([&] {
    output::Checkpoint checkpoint;
    checkpoint.program = program_version();
    checkpoint.inputs = inputs_;
    checkpoint.ranks = parallel::n_ranks();
    checkpoint.step = n;
    output::SavedNumbers &numbers = checkpoint.numbers;
    numbers.put("state", state_);
    numbers.put("iterative", {double(iterative_)});
    numbers.put("direct from", {double(direct_from_)});
    numbers.put("newton", {double(newton_total_), double(newton_max_), double(newton_first_)});
    numbers.put("seconds", {step_seconds_, seconds_before_ + process_age()});
    route_->save(numbers);
    recorder_->save(numbers);
    highlights_.save(numbers);
    locking_->save(numbers);
    folder_->put_checkpoint(std::move(checkpoint));
  });
  saved_step_ = n;
}

template <int dim>
void Simulation<dim>::restore() {
  const output::SavedNumbers &numbers = checkpoint_->numbers;
  numbers.fill("state", state_);
  direct_from_ = static_cast<int>(numbers.get("direct from", 1)[0]);
  const auto newton = numbers.get("newton", 3);
  newton_total_ = static_cast<int>(newton[0]);
  newton_max_ = static_cast<int>(newton[1]);
  newton_first_ = static_cast<int>(newton[2]);
  const auto seconds = numbers.get("seconds", 2);
  step_seconds_ = seconds[0];
  seconds_before_ = seconds[1];
  route_->restore(numbers);
  recorder_->restore(state_, numbers);
  highlights_.restore(numbers);
  locking_->restore(numbers);
}

template <int dim>
void Simulation<dim>::put_report() {
  if (!model_.asked.output.report)
    return;
  progress_.stage("report");
  put_report_in(folder_->directory());
}

// The error that ended the steps is the one to tell of.
template <int dim>
void Simulation<dim>::keep_what_there_is() {
  progress_.done();
  try {
    recorder_->finish(state_);
    parallel::on_first([&] { put_report(); });
  } catch (const std::exception &) {
  }
  progress_.done();
}

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::size_t>(usage.ru_maxrss);
}

template <int dim>
output::Summary Simulation<dim>::summary() const {
  const solve::RouteReport report = route_->report();
  output::Summary summary;
  summary.title = model_.asked.title;
  summary.version = program_version();
  summary.components = component_versions();
  summary.inputs = contents_;
  summary.sizes = {{"dimension", dim},
                   {"nodes", model_.body.n_nodes()},
                   {"cells", model_.body.n_cells()},
                   {"unknowns", report.unknowns},
                   {"electric_and_thermal_unknowns", report.electric_and_thermal_unknowns},
                   {"contact_nodes", model_.interface.size()},
                   {"factor_entries", report.factor_entries},
                   {"factor_flops", static_cast<std::int64_t>(report.factor_flops)},
                   {"steps", model_.asked.time.steps},
                   {"ranks", parallel::n_ranks()}};
  summary.iterations = {{"newton_total", newton_total_},
                        {"newton_max", newton_max_},
                        {"newton_first", newton_first_}};
  if (report.krylov_iterations > 0) {
    summary.iterations["krylov_total"] = static_cast<std::int64_t>(report.krylov_iterations);
    summary.iterations["krylov_max"] = report.krylov_largest;
    summary.iterations["preconditioners"] = report.preconditioners;
    summary.iterations["safe_steps"] = report.safe_steps;
  }
  summary.factorisations = report.factorisations;
  if (report.negative_pivots >= 0)
    summary.negative_pivots = report.negative_pivots;
  summary.backward_error = report.backward_error;
  summary.forward_error = report.forward_error;
  summary.is_refined = report.is_refined;
  summary.warnings = recorder_->warnings();
  summary.extremes = recorder_->extremes(state_);
  summary.materials = materials_of(model_.asked);
  summary.seconds.mesh = model_.mesh_seconds;
  summary.seconds.assemble = model_.assemble_seconds;
  summary.seconds.analyse = report.analyse_seconds;
  summary.seconds.factorise = report.factorise_seconds;
  summary.seconds.condense = report.condense_seconds;
  summary.seconds.step = {step_seconds_, step_seconds_ / model_.asked.time.steps,
                          report.substitution_seconds, report.contact_seconds};
  summary.seconds.start = start_seconds_;
  summary.seconds.total = seconds_before_ + process_age();
  summary.seconds.output = recorder_->seconds();
  if (model_.asked.solver.body == "automatic" && iterative_)
    summary.warnings.push_back(fmt::format(
        "solver.body = \"automatic\": the body's equations were solved iteratively, because a "
        "factorisation needs about {:.3g} GiB, more than half of what is available",
        factorised_memory(model_.asked) / (1 << 30)));
  if (direct_from_ > 0)
    summary.warnings.push_back(
        fmt::format("solver.body = \"automatic\": the iterative solution of the body's equations, "
                    "taken to save memory, failed in step {}; from there on they were factorised",
                    direct_from_));
  if (const std::string text = locking_->warning(); !text.empty())
    summary.warnings.push_back(text);
  for (const std::string &text : material_warnings(model_.asked))
    summary.warnings.push_back(text);
  if (const std::string text = strain_warning(model_, std::span(state_)); !text.empty())
    summary.warnings.push_back(text);
  summary.peak_memory_bytes = parallel::sum(peak_memory());
  return summary;
}

}  // namespace

void check(const casefile::Case &asked) {
  if (asked.dimension == 2)
    material::Composition<2>{asked};
  else
    material::Composition<3>{asked};
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
        put_report_in(directory);
    });
    if (!options.quiet && parallel::is_first())
      std::cout << places_text(directory) << std::flush;
    return;
  }
  try {
    if (asked.dimension == 2)
      Simulation<2>(asked, directory, options, std::move(from.checkpoint), std::move(lock)).run();
    else
      Simulation<3>(asked, directory, options, std::move(from.checkpoint), std::move(lock)).run();
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
