#pragma once

#include <gmock/gmock.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "../cases/slipping_block.h"
#include "process.h"

/// Runs that are killed, stopped or refused, and go on with --resume.
class Interrupted : public Program {
 protected:
  Interrupted() { std::ofstream(here() / "block.toml") << tourmaline::verified::slipping_block; }

  /// Summary of a run but for what every run has of its own.
  static nlohmann::json without_times(const std::filesystem::path &file) {
    nlohmann::json summary = nlohmann::json::parse(content_of(file));
    summary.erase("seconds");
    summary.erase("memory");
    return summary;
  }

  static bool slips(const std::filesystem::path &contact_table) {
    return content_of(contact_table).find(",slip,") != std::string::npos;
  }

  std::unique_ptr<Process> start(const std::string &arguments) const {
    return std::make_unique<Process>(arguments, here(), folder_ / "stderr");
  }

  /// Kills the run once its first checkpoint is there; false if it was too fast for that.
  bool kill_behind_a_checkpoint(const std::string &all, const std::string &folder) const {
    const auto process = start(all + folder);
    const bool saved = process->leaves(here() / folder / "checkpoint.bin");
    process->send(SIGKILL);
    return saved && process->wait() == -SIGKILL;
  }

  /// The page of a run, made with the times of another.
  std::string page(const std::filesystem::path &run_folder, const std::filesystem::path &times_of) {
    const std::filesystem::path copy = folder_ / "page" / run_folder.filename();
    std::filesystem::create_directories(copy.parent_path());
    std::filesystem::copy(run_folder, copy);
    std::filesystem::copy_file(times_of / "summary.json", copy / "summary.json",
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_EQ(run("report '" + copy.string() + "'"), 0) << complained_;
    const std::string text = content_of(copy / "report.html");
    std::filesystem::remove_all(copy);
    return text;
  }

  /// All files have the same bytes, the summary but for times and memory.
  void expect_same_files(const std::filesystem::path &a, const std::filesystem::path &b) {
    ASSERT_EQ(files_below(a), files_below(b));
    for (const std::string &name : files_below(a))
      if (name != "summary.json" && name != "report.html") {
        EXPECT_TRUE(content_of(a / name) == content_of(b / name)) << name;
      }
    EXPECT_EQ(without_times(a / "summary.json"), without_times(b / "summary.json"));
  }

  /// And the pages, which show the summary.
  void expect_same_results(const std::filesystem::path &a, const std::filesystem::path &b) {
    expect_same_files(a, b);
    EXPECT_TRUE(page(a, a) == page(b, a));
    EXPECT_TRUE(page(b, b) == content_of(b / "report.html"));
  }

  /// A run that is killed behind a checkpoint and goes on leaves what one does that is not.
  void expect_to_go_on(const std::string &arguments, const std::string &often = "2steps") {
    const std::string all = "run " + arguments + " --set output.checkpoint=" + often + " -q -o ";
    ASSERT_EQ(run(all + "one/results"), 0) << complained_;
    warnings_ = complained_;
    ASSERT_TRUE(kill_behind_a_checkpoint(all, "other/results"));
    EXPECT_TRUE(slips(here() / "other/results/contact.csv.part"));
    ASSERT_EQ(run(all + "other/results --resume"), 0) << complained_;
    EXPECT_EQ(complained_, warnings_);
    expect_same_files(here() / "one/results", here() / "other/results");
  }

  std::string warnings_;  ///< of the run of `expect_to_go_on`

  /// Leaves a killed run with its checkpoint in `results`. Its lock goes with whoever looks there.
  void interrupt_a_run() {
    ASSERT_TRUE(kill_behind_a_checkpoint(slow + " -q -o ", "results"));
    std::filesystem::remove(here() / "results/run.lock");
  }

  const std::string paper = std::string(TOURMALINE_SOURCE_DIR) +
                            "/cases/ouafik-2020/conductive.toml --set mesh.box.cells=[12,12]";
  // So many steps that no test is slower than they are.
  const std::string slow = "run " + paper +
                           " --set time.steps=100000 --set output.every=1000 "
                           "--set output.checkpoint=5steps";
};
