#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "output/folder_lock.h"
#include "output/progress.h"
#include "output/result_folder.h"
#include "output/summary.h"
#include "run/account.h"
#include "run/adrift.h"
#include "run/ending.h"
#include "run/evolution.h"
#include "run/halved_steps.h"
#include "run/most_strained.h"
#include "run/recorder.h"
#include "run/schedule.h"
#include "run/step_doubling.h"
#include "run/temperatures.h"
#include "solve/model.h"
#include "tourmaline/case/case.h"
#include "tourmaline/run/simulation.h"

namespace tourmaline::run {

/// The steps of a run and all that is written while they are taken.
template <int dim>
class TimeLoop {
 public:
  /// Builds the body and opens the folder; starts behind the checkpoint, if there is one. Throws
  /// CaseError, SolveError, MachineError.
  TimeLoop(const casefile::Case &asked, const std::filesystem::path &directory,
           const RunOptions &options, std::optional<output::Checkpoint> checkpoint,
           std::unique_ptr<output::FolderLock> lock);
  /// Takes all steps and finishes the results. Throws the same and Stopped; what was written before
  /// stays.
  void run();

 private:
  void open_folder(const std::filesystem::path &directory,
                   std::unique_ptr<output::FolderLock> lock);
  void begin();
  void march(Schedule &schedule);
  void march_together(Schedule &schedule);
  output::Summary take_steps(Schedule &schedule);
  bool is_at_end() const;
  void book(TakenStep step);
  output::HistoryRow record(const TakenStep &step);
  void pause(const Schedule::Pause &pause);
  void save();
  output::SavedNumbers saved_numbers() const;
  void restore();
  output::Summary close_tables(Schedule &schedule);
  void put_report();
  void keep_what_there_is(const std::string &why);
  std::string what_is_left() const;
  std::string of_all() const;
  void tell(const output::Summary &done, int signal) const;
  output::Summary summary() const;
  std::vector<std::string> warnings() const;

  Account account_;
  std::optional<output::Checkpoint> checkpoint_;  // to start from
  std::string inputs_;                            // of the run, for later checkpoints
  std::map<std::string, std::string> contents_;   // of the files it reads: digests
  std::string friction_name_;                     // of a program's laws; empty: the case's
  bool quiet_;
  output::Progress progress_;
  bool iterative_;  // decided once: what is available changes with what is taken
  solve::Model<dim> model_;
  Evolution<dim> evolution_;
  std::optional<StepDoubling<dim>> chosen_;  // steps, where the program chooses them
  std::optional<HalvedSteps<dim>> given_;    // where the case does
  std::optional<output::ResultFolder> folder_;
  std::optional<Recorder<dim>> recorder_;
  std::vector<double> state_;  // of the last step that is written
  int done_ = 0;               // steps
  int saved_step_ = 0;         // of the checkpoint that is there; 0: none
  Highlights highlights_;
  MostStrained most_strained_;
  Adrift<dim> adrift_;
  TemperaturePeak temperature_;
};

/// Makes report.html, where all other results are. Throws MachineError.
void put_page_in(const std::filesystem::path &directory);

}  // namespace tourmaline::run
