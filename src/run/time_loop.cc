#include "run/time_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "case/interval.h"
#include "case/resolved.h"
#include "case/snapping.h"
#include "case/tables_in_time.h"
#include "contact/checked_law.h"
#include "output/place.h"
#include "parallel/ranks.h"
#include "report/page.h"
#include "run/contact_edges.h"
#include "run/contact_sums.h"
#include "run/locking.h"
#include "run/lone_error.h"
#include "run/memory.h"
#include "run/plausibility.h"
#include "run/rehearsal.h"
#include "run/resumption.h"
#include "run/step_check.h"
#include "run/survey.h"
#include "run/versions.h"
#include "stopwatch.h"
#include "tourmaline/contact/friction.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

// The steps are done: what is missing then is only the page.
void put_page_in(const std::filesystem::path &directory) {
  try {
    report::write_page({directory}, directory / "report.html");
  } catch (const CaseError &error) {  // what it reads is the run's, not the user's
    throw MachineError(fmt::format("{}; start again without --resume", error.what()));
  } catch (const MachineError &error) {
    throw MachineError(fmt::format("{}; all other results are in {}, and --resume makes the page",
                                   error.what(), directory.string()));
  }
}

// Empty on the other ranks, which have its error.
template <class Make>
auto made_on_first(const Make &make) {
  decltype(make()) made;
  parallel::on_first([&] { made = make(); });
  return made;
}

template <int dim>
solve::Model<dim> announced(const casefile::Case &asked, bool iterative,
                            output::Progress &progress) {
  progress.stage("mesh and operator");
  return solve::Model<dim>(asked, iterative && !may_be_factorised(asked));
}

// Evaluates the case's formulas once before anything is written: a formula that is undefined
// somewhere should not leave a folder behind. Then opens the folder, which may fail, before the
// factorisation.
template <int dim>
TimeLoop<dim>::TimeLoop(const casefile::Case &asked, const std::filesystem::path &directory,
                        const RunOptions &options, std::optional<output::Checkpoint> checkpoint,
                        std::unique_ptr<output::FolderLock> lock)
    : checkpoint_(std::move(checkpoint)),
      inputs_(made_on_first([&] { return inputs_of(asked, options.friction_name); })),
      contents_(made_on_first([&] { return contents_of(asked); })),
      friction_name_(options.friction_name),
      quiet_(options.quiet),
      progress_(asked.time.tolerance ? 0 : asked.time.steps, asked.time.end,
                options.quiet || !parallel::is_first()),
      iterative_(checkpoint_ ? ChosenRoute<dim>::was_iterative(checkpoint_->numbers)
                             : solves_iteratively(asked)),
      model_(announced<dim>(asked, iterative_, progress_)),
      evolution_(model_),
      most_strained_(model_.n_unknowns()),
      adrift_(model_) {
  rehearse(model_, checkpoint_ ? 1 : tried_steps(asked.time));
  if (options.friction) {
    model_.friction = contact::checked(options.friction, options.friction_name);
    model_.laws.replace_friction();
  }
  open_folder(directory, std::move(lock));
  recorder_.emplace(model_, *folder_);
  if (checkpoint_)
    checkpoint_->numbers.for_each_field(
        [&](std::vector<double> &field) { field = model_.sharing().part_of(std::move(field)); });
  const output::SavedNumbers *numbers = checkpoint_ ? &checkpoint_->numbers : nullptr;
  if (asked.time.tolerance)
    chosen_.emplace(model_, evolution_).plan(numbers);
  else
    given_.emplace(model_, evolution_, numbers);
  evolution_.make_ready(iterative_, progress_,
                        checkpoint_ ? static_cast<int>(checkpoint_->step) + 1 : 1);
}

template <int dim>
void TimeLoop<dim>::open_folder(const std::filesystem::path &directory,
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
    folder_->put_case(casefile::resolved_with_law(model_.asked, friction_name_));
  });
  if (!folder_)
    open();
}

template <int dim>
void TimeLoop<dim>::begin() {
  if (checkpoint_) {
    restore();
    done_ = saved_step_ = static_cast<int>(checkpoint_->step);
    checkpoint_.reset();
  } else {
    evolution_.begin();
    recorder_->initial(evolution_.state(), evolution_.motion().record());
    temperature_.begin(recorder_->extremes(evolution_.state()));
  }
  state_ = evolution_.state();
}

template <int dim>
void TimeLoop<dim>::book(TakenStep step) {
  account_.step(step.n, step.outcome, step.seconds);
  adrift_.step(step.n, step.outcome, step.loads, step.state);
  const output::HistoryRow row = record(step);
  evolution_.see_balanced(step.n, recorder_->balanced());
  highlights_.see(row);
  most_strained_.step(row, step.state);
  temperature_.step(row);
  progress_.expect(chosen_ ? 0 : model_.steps.count());
  progress_.step(row);
  std::swap(state_, step.state);
  done_ = step.n;
}

template <int dim>
output::HistoryRow TimeLoop<dim>::record(const TakenStep &step) {
  // Of a pair of chosen steps both are taken before either is written.
  for (const auto &foundation : step.outcome.foundations)
    *model_.found_potentials[foundation.contact] = foundation.voltage;
  solve::Route &route = evolution_.route().route();
  return recorder_->step(step.n, step.outcome, step.loads, step.before, step.state, route,
                         [&] { return route.accuracy(step.right_side, step.state, step.outcome); });
}

template <int dim>
bool TimeLoop<dim>::is_at_end() const {
  return chosen_ ? chosen_->is_at_end() : given_->is_at_end(done_);
}

// Checkpoints stand behind whole pairs.
template <int dim>
void TimeLoop<dim>::march(Schedule &schedule) {
  while (!is_at_end()) {
    const int first = done_ + 1;
    if (chosen_)
      for (TakenStep &step : chosen_->next(done_))
        book(std::move(step));
    else
      book(given_->take(first));
    if (!is_at_end())
      pause(schedule.after(first, done_));
  }
}

template <int dim>
void TimeLoop<dim>::pause(const Schedule::Pause &pause) {
  if (pause.saves)
    save();
  if (pause.stopped_by != 0)
    throw Stopped(
        fmt::format("stopped by {} after step {}{}; the results of these steps and a "
                    "checkpoint are in {}",
                    signal_name(pause.stopped_by), done_, of_all(), folder_->directory().string()),
        pause.stopped_by);
}

// As far as the number of all steps is known.
template <int dim>
std::string TimeLoop<dim>::of_all() const {
  return chosen_
             ? fmt::format(" at t = {:.4g} of {:.4g} s", model_.time(done_), model_.asked.time.end)
             : fmt::format(" of {}", model_.steps.count());
}

template <int dim>
void TimeLoop<dim>::run() {
  begin();
  Schedule schedule(casefile::interval(model_.asked.output.checkpoint));
  const output::Summary done = take_steps(schedule);
  // From here on only the page may be missing, which `--resume` makes.
  parallel::on_first([&] { put_report(); });
  progress_.done();
  tell(done, schedule.received());
}

// A program's laws are asked on every rank, and may fail on one of them alone.
template <int dim>
void TimeLoop<dim>::march_together(Schedule &schedule) {
  try {
    march(schedule);
  } catch (const Error &error) {
    require_error_of_all(error);
    throw;
  }
}

// The error that ends the steps also says where those before it are.
template <int dim>
output::Summary TimeLoop<dim>::take_steps(Schedule &schedule) {
  try {
    march_together(schedule);
    return close_tables(schedule);
  } catch (const CaseError &error) {
    const std::string why = error.what() + what_is_left();
    keep_what_there_is(why);
    throw CaseError(why);
  } catch (const SolveError &error) {
    const std::string why = error.what() + what_is_left();
    keep_what_there_is(why);
    throw SolveError(why);
  } catch (const MachineError &error) {
    const std::string why =
        error.what() + what_is_left() +
        (saved_step_ > 0 ? fmt::format("; --resume goes on after step {}", saved_step_) : "");
    keep_what_there_is(why);
    throw MachineError(why);
  } catch (const Stopped &stopped) {
    keep_what_there_is(stopped.what());
    throw;
  } catch (const std::exception &error) {
    if (parallel::n_ranks() == 1)  // otherwise the others know nothing of it
      keep_what_there_is(error.what());
    throw;
  }
}

template <int dim>
std::string TimeLoop<dim>::what_is_left() const {
  if (done_ == 0)
    return "; no step has been computed";
  return fmt::format("; the results of {}{} are in {}",
                     done_ == 1 ? "step 1" : fmt::format("steps 1 to {}", done_), of_all(),
                     folder_->directory().string());
}

// From now on a signal lets the run be finished: it is nearly done.
template <int dim>
output::Summary TimeLoop<dim>::close_tables(Schedule &schedule) {
  if (parallel::is_first())
    schedule.answer(
        "tourmaline: all steps are done; the results are being finished (a second signal ends "
        "this at once)\n");
  recorder_->finish(state_);
  output::Summary done = summary();
  parallel::on_first([&] { folder_->put_summary(done); });
  return done;
}

template <int dim>
void TimeLoop<dim>::tell(const output::Summary &done, int signal) const {
  if (!parallel::is_first())
    return;
  for (const std::string &warning : done.warnings)
    std::cerr << "tourmaline: warning: " << warning << '\n';
  if (signal != 0)
    std::cerr << fmt::format("tourmaline: {} came when all steps were done; the run is complete\n",
                             signal_name(signal));
  if (!quiet_)
    std::cout << ending_text(dim, highlights_, done.extremes,
                             output::largest_extent(model_.body.bounds()))
              << places_text(folder_->directory()) << std::flush;
}

// Everything that later steps, or what is told of the run at its end, depend on.
template <int dim>
void TimeLoop<dim>::save() {
  output::Checkpoint checkpoint;
  if (parallel::is_first() || !model_.sharing().is_whole())
    checkpoint.numbers = saved_numbers();
  checkpoint.numbers.for_each_field(
      [&](std::vector<double> &field) { field = model_.sharing().on_first(std::move(field)); });
  parallel::on_first([&] {
    checkpoint.program = program_version();
    checkpoint.inputs = inputs_;
    checkpoint.ranks = parallel::n_ranks();
    checkpoint.step = done_;
    folder_->put_checkpoint(std::move(checkpoint));
  });
  saved_step_ = done_;
}

template <int dim>
output::SavedNumbers TimeLoop<dim>::saved_numbers() const {
  output::SavedNumbers numbers;
  evolution_.save(numbers);
  if (chosen_)
    chosen_->save(numbers);
  else
    given_->save(numbers);
  account_.save(numbers);
  adrift_.save(numbers);
  recorder_->save(numbers);
  highlights_.save(numbers);
  most_strained_.save(numbers);
  temperature_.save(numbers);
  return numbers;
}

template <int dim>
void TimeLoop<dim>::restore() {
  const output::SavedNumbers &numbers = checkpoint_->numbers;
  evolution_.restore(numbers);
  account_.restore(numbers);
  adrift_.restore(numbers);
  recorder_->restore(evolution_.state(), numbers);
  highlights_.restore(numbers);
  most_strained_.restore(numbers);
  temperature_.restore(numbers);
}

template <int dim>
void TimeLoop<dim>::put_report() {
  if (!model_.asked.output.report)
    return;
  progress_.stage("report");
  put_page_in(folder_->directory());
}

// The error that ended the steps is the one to tell of.
template <int dim>
void TimeLoop<dim>::keep_what_there_is(const std::string &why) {
  progress_.done();
  try {
    recorder_->finish(state_);
    parallel::on_first([&] {
      folder_->put_reason(why);
      put_report();
    });
  } catch (const std::exception &) {
  }
  progress_.done();
}

template <int dim>
output::Summary TimeLoop<dim>::summary() const {
  const int sizes = chosen_ ? chosen_->sizes() : model_.steps.sizes(done_);
  const solve::RouteReport report = evolution_.route().report(sizes);
  output::Summary summary;
  summary.warnings = warnings();  // which take their time
  summary.title = model_.asked.title;
  summary.friction_name = friction_name_;
  summary.version = program_version();
  summary.components = component_versions();
  summary.inputs = contents_;
  summary.sizes = {{"dimension", dim},
                   {"nodes", model_.sharing().n_all()},
                   {"cells", model_.body.n_cells()},
                   {"unknowns", report.unknowns},
                   {"electric_and_thermal_unknowns", report.electric_and_thermal_unknowns},
                   {"contact_nodes", model_.interface.size()},
                   {"factor_entries", report.factor_entries},
                   {"factor_flops", static_cast<std::int64_t>(report.factor_flops)},
                   {"steps", done_},
                   {"ranks", parallel::n_ranks()}};
  if (!model_.asked.time.intervals.empty() || chosen_ || given_->count() > 0)
    summary.sizes["step_sizes"] = sizes;
  if (given_ && given_->count() > 0)
    summary.sizes["halved_steps"] = given_->count();
  if (chosen_) {
    summary.sizes["rejected_steps"] = chosen_->rejected();
    summary.sizes["computed_steps"] = chosen_->computed();
  }
  account_.put(report, done_, summary);
  summary.seconds.mesh = model_.mesh_seconds;
  summary.seconds.assemble = model_.assemble_seconds;
  summary.seconds.output = recorder_->seconds();
  summary.extremes = recorder_->extremes(state_);
  summary.materials = materials_of(model_.asked);
  summary.contacts = contact_records(model_);
  return summary;
}

template <int dim>
std::vector<std::string> TimeLoop<dim>::warnings() const {
  std::vector<std::string> all = recorder_->warnings();
  const auto add = [&](const std::string &text) {
    if (!text.empty())
      all.push_back(text);
  };
  for (const std::string &warning : evolution_.route().warnings())
    add(warning);
  add(chosen_ ? chosen_->warning() : given_->warning());
  if (most_strained_.step() > 0)
    add(locking_warning(model_, most_strained_.state()));
  add(account_.jump_warning(model_.asked.time.is_dynamic()));
  add(adrift_.warning());
  for (const std::string &text : material_warnings(model_.asked))
    add(text);
  for (const std::string &text : casefile::snapping_warnings(model_.asked))
    add(text);
  for (const std::string &text : casefile::table_warnings(model_.asked))
    add(text);
  add(contact_edge_warning(model_.asked, model_.body.points(), model_.contact_edges));
  const std::vector<std::string> given = temperature_warnings(model_.asked);
  all.insert(all.end(), given.begin(), given.end());
  if (given.empty())
    add(temperature_.warning(model_.composition.reference_temperature()));
  std::vector<Moment> moments{{state_, done_, model_.time(done_)}};
  if (most_strained_.step() != done_)
    moments.insert(moments.begin(),
                   {most_strained_.state(), most_strained_.step(), most_strained_.time()});
  add(strain_warning(model_, moments));
  return all;
}

template class TimeLoop<2>;
template class TimeLoop<3>;

}  // namespace tourmaline::run
