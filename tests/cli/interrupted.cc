// Runs that are killed, stopped or refused, and go on with --resume.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>
#include <vector>

#include "program.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

// Its contact slips in different directions.
const std::string block = R"toml(
[mesh]
box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [4, 4, 4], cell = "tetrahedron" }
[material]
library = "BaTiO3-Liu2014"
pyroelectric = [0, 0, 1e-4]
[time]
end = 0.2
steps = 8
[[boundary]]
on = "right"
displacement = [0, 0, 0]
potential = "1e-3*t"
temperature = 0
[[boundary]]
on = "top"
traction = [0, "-3*t*(1+x*10)", "-50*t*y"]
[contact]
on = "left"
friction = { law = "tresca", bound = 0.05 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
)toml";

std::vector<std::string> words(const std::string &text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

// A process of the program, at work while the test goes on.
class Process {
 public:
  Process(const std::string &arguments, const fs::path &folder, const fs::path &said) {
    std::vector<std::string> all = words(arguments);
    all.insert(all.begin(), binary());
    std::vector<char *> argv;
    for (std::string &argument : all)
      argv.push_back(argument.data());
    argv.push_back(nullptr);
    id_ = fork();
    if (id_ == 0) {
      signal(SIGINT, SIG_DFL);  // which the background jobs of a script ignore
      const int out = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      dup2(out, STDOUT_FILENO);
      dup2(out, STDERR_FILENO);
      if (chdir(folder.c_str()) == 0)
        execv(argv[0], argv.data());
      _exit(127);
    }
  }
  ~Process() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      wait();
    }
  }
  Process(const Process &) = delete;
  Process &operator=(const Process &) = delete;

  pid_t id() const { return id_; }
  void send(int signal) const { kill(id_, signal); }
  bool is_at_work() const {
    return waitid(P_PID, id_, &info_, WEXITED | WNOHANG | WNOWAIT) == 0 && info_.si_pid == 0;
  }
  /// The exit status, or minus the signal that ended it.
  int wait() {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  /// Whether the file was there before the process ended.
  bool leaves(const fs::path &file) const {
    while (is_at_work()) {
      if (fs::exists(file))
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return fs::exists(file);
  }

 private:
  pid_t id_ = -1;
  mutable siginfo_t info_{};
};

nlohmann::json without_times(const fs::path &file) {
  nlohmann::json summary = nlohmann::json::parse(content_of(file));
  summary.erase("seconds");
  summary.erase("memory");
  return summary;
}

bool slips(const fs::path &contact_table) {
  return content_of(contact_table).find(",slip,") != std::string::npos;
}

class Interrupted : public Program {
 protected:
  Interrupted() { std::ofstream(here() / "block.toml") << block; }

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
  std::string page(const fs::path &run_folder, const fs::path &times_of) {
    const fs::path copy = folder_ / "page" / run_folder.filename();
    fs::create_directories(copy.parent_path());
    fs::copy(run_folder, copy);
    fs::copy_file(times_of / "summary.json", copy / "summary.json",
                  fs::copy_options::overwrite_existing);
    EXPECT_EQ(run("report '" + copy.string() + "'"), 0) << complained_;
    const std::string text = content_of(copy / "report.html");
    fs::remove_all(copy);
    return text;
  }

  /// All files have the same bytes, the summary but for times and memory.
  void expect_same_files(const fs::path &a, const fs::path &b) {
    ASSERT_EQ(files_below(a), files_below(b));
    for (const std::string &name : files_below(a))
      if (name != "summary.json" && name != "report.html") {
        EXPECT_TRUE(content_of(a / name) == content_of(b / name)) << name;
      }
    EXPECT_EQ(without_times(a / "summary.json"), without_times(b / "summary.json"));
  }

  /// And the pages, which show the summary.
  void expect_same_results(const fs::path &a, const fs::path &b) {
    expect_same_files(a, b);
    EXPECT_TRUE(page(a, a) == page(b, a));
    EXPECT_TRUE(page(b, b) == content_of(b / "report.html"));
  }

  /// A run that is killed behind a checkpoint and goes on leaves what one does that is not.
  void expect_to_go_on(const std::string &arguments, const std::string &often = "2steps") {
    const std::string all = "run " + arguments + " --set output.checkpoint=" + often + " -q -o ";
    ASSERT_EQ(run(all + "one/results"), 0) << complained_;
    ASSERT_TRUE(kill_behind_a_checkpoint(all, "other/results"));
    EXPECT_TRUE(slips(here() / "other/results/contact.csv.part"));
    ASSERT_EQ(run(all + "other/results --resume"), 0) << complained_;
    EXPECT_EQ(complained_, "");
    expect_same_results(here() / "one/results", here() / "other/results");
  }

  /// Leaves a killed run with its checkpoint in `results`. Its lock goes with whoever looks there.
  void interrupt_a_run() {
    ASSERT_TRUE(kill_behind_a_checkpoint(slow + " -q -o ", "results"));
    fs::remove(here() / "results/run.lock");
  }

  const std::string paper = std::string(TOURMALINE_SOURCE_DIR) +
                            "/cases/ouafik-2020/conductive.toml --set mesh.box.cells=[12,12]";
  // So many steps that no test is slower than they are.
  const std::string slow = "run " + paper +
                           " --set time.steps=100000 --set output.every=1000 "
                           "--set output.checkpoint=5steps";
};

TEST_F(Interrupted, KilledAtRandomMomentsItGoesOnToTheSameBytes) {
  const std::string all =
      "run " + paper + " --set time.steps=40 --set output.checkpoint=1steps -q -o ";
  Seconds whole(1e9);  // the least of some, as other processes are at work too
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto started = std::chrono::steady_clock::now();
    ASSERT_EQ(run(all + "one/results"), 0) << complained_;
    whole = std::min<Seconds>(whole, std::chrono::steady_clock::now() - started);
  }
  EXPECT_TRUE(slips(here() / "one/results/contact.csv"));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.3, 1.05);  // before it the libraries load
  int behind_checkpoint = 0;
  for (int kill = 0; kill < 30; ++kill) {
    const auto process = start(all + "other/results --resume");
    std::this_thread::sleep_for(share(random) * whole);
    process->send(SIGKILL);
    const bool ended = process->wait() == 0;
    if (ended) {
      expect_same_files(here() / "one/results", here() / "other/results");
      fs::remove_all(here() / "other");
    }
    const bool behind = fs::exists(here() / "other/results/checkpoint.bin");
    behind_checkpoint += behind;
    whole *= ended ? 0.8 : behind ? 1 : 1.2;  // how busy the machine is changes meanwhile
  }
  ASSERT_EQ(run(all + "other/results --resume"), 0) << complained_;
  expect_same_results(here() / "one/results", here() / "other/results");
  EXPECT_GE(behind_checkpoint, 5) << "too few of the moments were between the first and last step";
}

TEST_F(Interrupted, ThePapersCaseGoesOn) {
  expect_to_go_on(paper + " --set time.steps=400 --set output.every=70", "150steps");
}

TEST_F(Interrupted, TheMonolithicRouteGoesOn) {
  expect_to_go_on(paper + " --set solver.method=monolithic --set contact.friction.bound=0.02");
}

TEST_F(Interrupted, PiecewiseConstantMultipliersGoOn) {
  expect_to_go_on(paper +
                  " --set solver.method=monolithic --set solver.multiplier=piecewise-constant");
}

TEST_F(Interrupted, ABlockGoesOn) {
  expect_to_go_on("block.toml");
}

TEST_F(Interrupted, TheIterativeRouteGoesOn) {
  expect_to_go_on("block.toml --set solver.body=iterative");
}

TEST_F(Interrupted, ElectrodesInACircuitGoOn) {
  expect_to_go_on(std::string(TOURMALINE_SOURCE_DIR) +
                      "/cases/devices/friction-sensor-loaded.toml --set time.steps=400"
                      " --set output.every=100 --set electrode[0].capacitor=1e-9",
                  "150steps");
}

TEST_F(Interrupted, ARunWithCheckpointsLeavesTheBytesOfOneWithout) {
  for (const std::string often : {"never", "1steps"})
    ASSERT_EQ(run("run " + paper + " -q --set output.checkpoint=" + often + " -o " + often), 0);
  fs::copy_file(here() / "never/resolved.toml", here() / "1steps/resolved.toml",
                fs::copy_options::overwrite_existing);
  fs::remove(here() / "never/report.html");  // which names its folder
  fs::remove(here() / "1steps/report.html");
  ASSERT_EQ(files_below(here() / "never"), files_below(here() / "1steps"));
  for (const std::string &name : files_below(here() / "never"))
    if (name != "summary.json") {
      EXPECT_TRUE(content_of(here() / "never" / name) == content_of(here() / "1steps" / name))
          << name;
    }
}

class Signal : public Interrupted, public testing::WithParamInterface<int> {};

TEST_P(Signal, FinishesTheStepAndSaysHowToGoOn) {
  const auto process = start(slow + " -q -o results");
  ASSERT_TRUE(process->leaves(here() / "results/checkpoint.bin"));
  process->send(GetParam());
  EXPECT_EQ(process->wait(), 128 + GetParam());
  complained_ = content_of(folder_ / "stderr");
  EXPECT_THAT(complained_, AllOf(HasSubstr("stopped by"), HasSubstr("of 100000;"),
                                 HasSubstr("-o results --resume\n")));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
  for (const char *name :
       {"history.csv", "contact.csv", "nodes.csv", "report.html", "checkpoint.bin"})
    EXPECT_TRUE(fs::exists(here() / "results" / name)) << name;
  EXPECT_FALSE(fs::exists(here() / "results" / "run.lock"));
}

INSTANTIATE_TEST_SUITE_P(Both, Signal, testing::Values(SIGINT, SIGTERM));

TEST_F(Interrupted, AStoppedRunGoesOnToTheSameBytes) {
  const std::string all = "run " + paper +
                          " --set time.steps=200 --set output.every=50 "
                          "--set output.checkpoint=2steps -q -o ";
  ASSERT_EQ(run(all + "one/results"), 0) << complained_;
  const auto process = start(all + "other/results");
  ASSERT_TRUE(process->leaves(here() / "other/results/checkpoint.bin"));
  process->send(SIGTERM);
  ASSERT_EQ(process->wait(), 128 + SIGTERM);
  ASSERT_EQ(run(all + "other/results --resume"), 0) << complained_;
  expect_same_results(here() / "one/results", here() / "other/results");
}

TEST_F(Interrupted, AFailedRunSaysWhatItLeaves) {
  EXPECT_EQ(run("run " + paper +
                " --set time.steps=10 --set 'contact.friction.bound=\"if(t > 0.1, -1, 15)\"' -q -o "
                "results"),
            2);
  EXPECT_THAT(complained_, HasSubstr("; the results of steps 1 to 5 of 10 are in results\n"));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
}

TEST_F(Interrupted, AtItsEndItNamesExtremesContactBalancesAndPlaces) {
  ASSERT_EQ(run("run " + paper + " --set time.steps=4 -o results"), 0);
  EXPECT_EQ(complained_, "");
  EXPECT_THAT(said_, AllOf(testing::StartsWith("4 steps done, t = 0.2 s\n  displacement  at most "),
                           HasSubstr("\n  potential "), HasSubstr("\n  temperature "),
                           HasSubstr(" of 13 nodes stick, "), HasSubstr("\n  balances "),
                           HasSubstr("\n  results       results\n"),
                           testing::EndsWith("\n  report        results/report.html\n")));
  ASSERT_EQ(run("run " + paper + " --set time.steps=4 -q -o results"), 0);
  EXPECT_EQ(said_ + complained_, "");
}

// The step takes longer than the test.
TEST_F(Interrupted, TheSecondSignalEndsItAtOnce) {
  const auto process = start(slow +
                             " --set solver.method=monolithic --set mesh.box.cells=[200,200] "
                             "--set output.checkpoint=1steps --set output.every=1 -q -o results");
  ASSERT_TRUE(process->leaves(here() / "results/checkpoint.bin"));
  process->send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process->send(SIGINT);
  EXPECT_EQ(process->wait(), -SIGINT);
  EXPECT_TRUE(fs::exists(here() / "results/checkpoint.bin"));
}

TEST_F(Interrupted, WithoutACheckpointItStartsFromTheBeginningAndSaysSo) {
  ASSERT_EQ(run("run " + paper + " --set time.steps=2 -o results --resume"), 0);
  EXPECT_THAT(complained_, HasSubstr("no checkpoint in results; starting from the beginning"));
  EXPECT_TRUE(fs::exists(here() / "results/summary.json"));
}

TEST_F(Interrupted, ACompleteRunIsLeftAsItIs) {
  const std::string all = "run " + paper + " --set time.steps=2 -o results";
  ASSERT_EQ(run(all), 0);
  const std::string before = content_of(here() / "results/summary.json");
  EXPECT_EQ(run(all + " --resume"), 0);
  EXPECT_THAT(complained_, HasSubstr("is complete"));
  EXPECT_EQ(content_of(here() / "results/summary.json"), before);
  EXPECT_EQ(run(all + " --resume --set contact.friction.bound=3"), 2);
  EXPECT_THAT(complained_, HasSubstr("contact.friction.bound was"));
  EXPECT_EQ(content_of(here() / "results/summary.json"), before);
}

class InTheEnd : public Interrupted {
 protected:
  // Its page takes longer than the moment between the summary and a signal.
  const std::string all = "run " + paper +
                          " --set mesh.box.cells=[64,64] --set time.steps=40 --set "
                          "output.checkpoint=7steps -o results";

  // The exit status after a signal while the page is written.
  int status_after(int signal) {
    const auto process = start(all + " -q");
    EXPECT_TRUE(process->leaves(results() / "summary.json"));
    EXPECT_FALSE(fs::exists(results() / "report.html")) << "too fast to be interrupted";
    process->send(signal);
    const int status = process->wait();
    complained_ = content_of(folder_ / "stderr");
    return status;
  }
  fs::path results() const { return here() / "results"; }
};

TEST_F(InTheEnd, OneSignalLetsItFinishThePageAndSaysSo) {
  for (const int signal : {SIGTERM, SIGINT}) {
    EXPECT_EQ(status_after(signal), 0);
    EXPECT_THAT(complained_, AllOf(HasSubstr("all steps are done; the results are being finished"),
                                   HasSubstr("came when all steps were done")));
    EXPECT_TRUE(fs::exists(results() / "report.html"));
    EXPECT_EQ(run(all + " --resume"), 0);
    EXPECT_THAT(complained_, HasSubstr("is complete"));
    fs::remove_all(results());
  }
}

TEST_F(InTheEnd, OfAKilledRunOnlyThePageIsMadeAgain) {
  EXPECT_EQ(status_after(SIGKILL), -SIGKILL);
  const std::string summary = content_of(results() / "summary.json");
  const auto nodes = fs::last_write_time(results() / "nodes.csv");
  EXPECT_EQ(run(all + " --resume"), 0);
  EXPECT_THAT(complained_, HasSubstr("all steps of the run in results are done; making its page"));
  EXPECT_THAT(said_, HasSubstr("results/report.html"));
  EXPECT_TRUE(fs::exists(results() / "report.html"));
  EXPECT_FALSE(fs::exists(results() / "run.lock"));
  EXPECT_FALSE(fs::exists(results() / "checkpoint.bin"))
      << "also where the kill came before its end";
  EXPECT_EQ(content_of(results() / "summary.json"), summary);
  EXPECT_EQ(fs::last_write_time(results() / "nodes.csv"), nodes);
}

TEST_F(Interrupted, APageThatCannotBeWrittenIsMadeByResume) {
  // Only the page is larger than 200 or 400 KiB.
  const std::string all = "run " + paper + " --set time.steps=2 -q -o results";
  EXPECT_EQ(run(all, "ulimit -f 400;"), 4);
  EXPECT_THAT(complained_, AllOf(HasSubstr("report.html: File too large"),
                                 HasSubstr("all other results are in results, and --resume makes "
                                           "the page")));
  EXPECT_FALSE(fs::exists(here() / "results/report.html"));
  EXPECT_EQ(run(all + " --resume"), 0) << complained_;
  EXPECT_TRUE(fs::exists(here() / "results/report.html"));
}

TEST_F(Interrupted, WithoutAPageARunIsCompleteWithItsSummary) {
  const std::string all =
      "run " + paper + " --set time.steps=2 --set output.report=false -o results";
  ASSERT_EQ(run(all), 0);
  EXPECT_EQ(run(all + " --resume"), 0);
  EXPECT_THAT(complained_, HasSubstr("is complete"));
  EXPECT_FALSE(fs::exists(here() / "results/report.html"));
}

TEST_F(Interrupted, ACompleteRunOfFilesThatHaveChangedIsRefused) {
  const std::string defects = std::string(TOURMALINE_SOURCE_DIR) + "/tests/cli/";
  fs::copy_file(defects + "own_material.toml", here() / "case.toml");
  fs::copy_file(defects + "materials.toml", here() / "materials.toml");
  const std::string all = "run case.toml -o results";
  ASSERT_EQ(run(all), 0) << complained_;
  ASSERT_EQ(run(all + " --resume"), 0);
  const std::string before = content_of(here() / "results/nodes.csv");
  std::string text = content_of(here() / "materials.toml");
  std::ofstream(here() / "materials.toml") << text.replace(text.find("1e9"), 3, "2e9");
  EXPECT_EQ(run(all + " --resume"), 2);
  EXPECT_THAT(complained_,
              AllOf(HasSubstr("the content of"), HasSubstr("materials.toml has changed"),
                    HasSubstr("without --resume")));
  EXPECT_EQ(content_of(here() / "results/nodes.csv"), before);
  EXPECT_EQ(run(all), 0);
  EXPECT_NE(content_of(here() / "results/nodes.csv"), before);
}

TEST_F(Interrupted, WhatResumeHasReadNoOtherRunChanges) {
  interrupt_a_run();
  const auto process = start(slow + " -o results --resume");
  while (process->is_at_work() &&
         content_of(folder_ / "stderr").find("going on in") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process->send(SIGSTOP);
  EXPECT_TRUE(fs::exists(here() / "results/run.lock"));
  EXPECT_EQ(run("run " + paper + " --set time.steps=1 -q -o results"), 4);
  EXPECT_THAT(complained_,
              HasSubstr("another run (process " + std::to_string(process->id()) + ")"));
  process->send(SIGCONT);
  process->send(SIGKILL);
}

TEST_F(Interrupted, ThePageOfARunAtWorkIsMadeElsewhereOnly) {
  const auto process = start(slow + " -q -o results");
  ASSERT_TRUE(process->leaves(here() / "results/checkpoint.bin"));
  EXPECT_EQ(run("report results"), 4);
  EXPECT_THAT(complained_, HasSubstr("another run"));
  EXPECT_EQ(run("report results -o page.html"), 0) << complained_;
  EXPECT_TRUE(process->is_at_work());
}

TEST_F(Interrupted, ARefusedRunLeavesNoFolder) {
  for (const std::string resume : {"", " --resume"}) {
    EXPECT_EQ(
        run("run " + paper + " --set 'contact.friction.bound=\"15/(t-t)\"' -o a/b/c" + resume), 2);
    EXPECT_FALSE(fs::exists(here() / "a")) << complained_;
  }
}

TEST_F(Interrupted, AChangedCaseIsRefusedWithTheKeysThatDiffer) {
  interrupt_a_run();
  const auto before = files_below(here());
  EXPECT_EQ(run(slow + " --set contact.friction.bound=30 --set boundary[2].traction=[0,1]"
                       " -o results --resume"),
            2);
  EXPECT_THAT(complained_, AllOf(HasSubstr("contact.friction.bound was 15, is 30"),
                                 HasSubstr("boundary[2].traction was"), HasSubstr("results")));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
  EXPECT_EQ(files_below(here()), before);
}

TEST_F(Interrupted, AnotherIntervalOfCheckpointsIsNoOtherCase) {
  interrupt_a_run();
  const auto process = start(slow + " --set output.checkpoint=7steps -q -o results --resume");
  const fs::path checkpoint = here() / "results/checkpoint.bin";
  const auto before = fs::last_write_time(checkpoint);
  while (process->is_at_work() && fs::last_write_time(checkpoint) == before)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process->send(SIGTERM);
  EXPECT_EQ(process->wait(), 128 + SIGTERM) << content_of(folder_ / "stderr");
}

class Damaged : public Interrupted {
 protected:
  void expect_refusal(const std::string &reason) {
    const auto before = files_below(here());
    EXPECT_EQ(run(slow + " -o results --resume"), 4);
    EXPECT_THAT(complained_, AllOf(HasSubstr("results/checkpoint.bin"), HasSubstr(reason),
                                   HasSubstr("without --resume")));
    EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
    EXPECT_EQ(files_below(here()), before);
  }
  void put(const std::string &bytes) const {
    std::ofstream(here() / "results/checkpoint.bin", std::ios::binary) << bytes;
  }
};

TEST_F(Damaged, ACheckpointIsRefusedAndTheFilesStay) {
  interrupt_a_run();
  const std::string whole = content_of(here() / "results/checkpoint.bin");
  ASSERT_GT(whole.size(), 1000u);
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{40}}) {
    put(whole.substr(0, size));
    expect_refusal("is damaged");
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}}) {
    put(whole.substr(0, size));
    expect_refusal("is no checkpoint");
  }
  std::mt19937 random(2);
  for (int flip = 0; flip < 5; ++flip) {
    std::string bytes = whole;
    bytes[30 + random() % (bytes.size() - 30)] ^= static_cast<char>(1 << random() % 8);
    put(bytes);
    expect_refusal("checksum");
  }
  std::string newer = whole;
  newer[22] = 9;  // behind the magic line
  put(newer);
  expect_refusal("version 9 of the format");
}

TEST_F(Damaged, AMissingTableOrFieldFileIsNamed) {
  interrupt_a_run();
  const auto expect_named = [&](const std::string &name) {
    EXPECT_EQ(run(slow + " -o results --resume"), 4);
    EXPECT_THAT(complained_, HasSubstr(name));
    EXPECT_TRUE(fs::exists(here() / "results/checkpoint.bin"));
  };
  fs::rename(here() / "results/result_0000.vtu", here() / "away");
  expect_named("result_0000.vtu");
  fs::rename(here() / "away", here() / "results/result_0000.vtu");
  fs::resize_file(here() / "results/history.csv.part", 10);
  expect_named("history.csv.part is shorter");
}

TEST_F(Interrupted, ASecondRunInTheFolderIsRefusedByTheNumberOfTheFirst) {
  const auto first = start(slow + " -q -o results");
  ASSERT_TRUE(first->leaves(here() / "results/checkpoint.bin"));
  for (const std::string resume : {"", " --resume"}) {
    EXPECT_EQ(run(slow + " -q -o results" + resume), 4);
    EXPECT_THAT(complained_,
                HasSubstr("another run (process " + std::to_string(first->id()) + ")"));
  }
  EXPECT_TRUE(first->is_at_work());
  first->send(SIGKILL);
  first->wait();
  EXPECT_TRUE(fs::exists(here() / "results/run.lock"));
  EXPECT_EQ(run("run " + paper + " --set time.steps=1 -q -o results"), 0) << complained_;
  EXPECT_FALSE(fs::exists(here() / "results/run.lock"));
}

/// A file system of the test's own, where it may mount one.
class Mounted : public Interrupted {
 protected:
  void TearDown() override { umount((here() / "results").c_str()); }
  bool mounts(const char *options) const {
    fs::create_directory(here() / "results");
    return mount("none", (here() / "results").c_str(), "tmpfs", 0, options) == 0;
  }
  bool make_read_only() const {
    return mount("none", (here() / "results").c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "") == 0;
  }
};

TEST_F(Mounted, AFullDiskEndsTheRunAndWithRoomItGoesOn) {
  if (!mounts("size=4m"))
    GTEST_SKIP() << "only root may mount a small file system";
  const std::string all = "run " + paper +
                          " --set time.steps=60 --set output.every=60"
                          " --set output.checkpoint=5steps -q -o ";
  ASSERT_EQ(run(all + "one/results"), 0) << complained_;
  const auto used = fs::file_size(here() / "one/results/contact.csv") / 2 +
                    fs::file_size(here() / "one/results/history.csv") / 2;
  std::ofstream(here() / "results/ballast") << std::string((4 << 20) - used - 120000, 'x');
  EXPECT_EQ(run(all + "results"), 4);
  EXPECT_THAT(complained_, AllOf(HasSubstr("results/"), HasSubstr("No space left on device")));
  ASSERT_TRUE(fs::exists(here() / "results/checkpoint.bin"));
  fs::remove(here() / "results/ballast");
  ASSERT_EQ(run(all + "results --resume"), 0) << complained_;
  expect_same_results(here() / "one/results", here() / "results");
}

TEST_F(Mounted, AReadOnlyFolderIsRefusedAndKeepsItsCheckpoint) {
  if (!mounts("size=32m"))
    GTEST_SKIP() << "only root may mount a file system";
  interrupt_a_run();
  const auto before = files_below(here());
  ASSERT_TRUE(make_read_only());
  EXPECT_EQ(run(slow + " -o results --resume"), 4);
  EXPECT_THAT(complained_, AllOf(HasSubstr("results/"), HasSubstr("Read-only file system")));
  EXPECT_EQ(files_below(here()), before);
}

TEST_F(Interrupted, AFileSizeLimitEndsTheRunLikeAFullDisk) {
  // Of the shell's blocks of 512 or 1024 bytes.
  const std::string all = "run " + paper +
                          " --set time.steps=60 --set output.every=60"
                          " --set output.checkpoint=2steps -q -o results";
  EXPECT_EQ(run(all, "ulimit -f 60;"), 4);
  EXPECT_THAT(complained_, AllOf(HasSubstr("results/"), HasSubstr("File too large")));
  EXPECT_TRUE(fs::exists(here() / "results/checkpoint.bin"));
  EXPECT_EQ(run(all + " --resume"), 0) << complained_;
  EXPECT_FALSE(fs::exists(here() / "results/checkpoint.bin"));
}

}  // namespace
