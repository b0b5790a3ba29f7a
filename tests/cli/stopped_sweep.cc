// A study that a signal ends, or whose runs are ended, and what is left of it.

#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <functional>
#include <iterator>
#include <thread>

#include "sweep.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Empty of a process that has ended meanwhile, and of what is no process.
std::string command_of(const std::filesystem::path &process) {
  std::ifstream in(process / "cmdline", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The processes whose command names that folder.
std::size_t processes_in(const std::filesystem::path &folder) {
  std::size_t n = 0;
  for (const auto &entry : std::filesystem::directory_iterator("/proc")) {
    const std::string command = command_of(entry.path());
    n += command.find(folder.string()) != std::string::npos;
  }
  return n;
}

bool happens(const std::function<bool()> &event) {
  for (int i = 0; i < 1200; ++i) {
    if (event())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

class StoppedSweep : public Sweep {
 protected:
  std::filesystem::path study() const { return here() / "study"; }

  /// Sends the signal once one member is done and another, which would take hours, runs.
  int status_after(int signal) {
    std::thread sender([&] {
      EXPECT_TRUE(happens([&] {
        return exists(study() / "steps=2/summary.json") &&
               exists(study() / "steps=200000000/resolved.toml");
      }));
      ::kill(std::stoi(content_of(folder_ / "pid")), signal);
    });
    const int status =
        run("sweep small.toml --vary time.steps=2,200000000,100000000 --jobs 1 -o '" +
                study().string() + "'",
            "echo $$ > ../pid; exec");
    sender.join();
    return status;
  }
};

TEST_F(StoppedSweep, EndsItsRunsAndKeepsWhatIsDone) {
  EXPECT_EQ(status_after(SIGTERM), 128 + SIGTERM);
  EXPECT_THAT(complained_, AllOf(HasSubstr("stopped; 2 of 3 cases have not run to their end"),
                                 Not(HasSubstr("failed"))));
  EXPECT_EQ(processes_in(study()), 0u);
  const auto table = table_in(study() / "sweep.csv");
  EXPECT_EQ(cell_under("status", table, 1), "done");
  EXPECT_EQ(cell_under("status", table, 2), "stopped");
  EXPECT_EQ(cell_under("status", table, 3), "stopped");
  EXPECT_FALSE(exists(study() / "steps=100000000/resolved.toml")) << "nothing starts any more";
}

TEST_F(StoppedSweep, AStoppedRunGoesOnWhereItWas) {
  const auto member = study() / "bound=5";
  const std::string all =
      "sweep small.toml --vary contact.friction.bound=5 --set time.steps=1500 "
      "--set output.fields=true --set output.every=700 --set 'output.checkpoint=\"5 steps\"' -o "
      "'" +
      study().string() + "'";
  std::thread sender([&] {
    EXPECT_TRUE(happens([&] { return exists(member / "checkpoint.bin"); }));
    ::kill(std::stoi(content_of(folder_ / "pid")), SIGTERM);
  });
  EXPECT_EQ(run(all, "echo $$ > ../pid; exec"), 128 + SIGTERM);
  sender.join();
  ASSERT_TRUE(exists(member / "checkpoint.bin"));
  const auto begun = last_write_time(member / "result_0000.vtu");
  EXPECT_EQ(run(all), 0) << complained_;
  EXPECT_EQ(last_write_time(member / "result_0000.vtu"), begun) << "it started again";
  EXPECT_EQ(cell_under("status", table_in(study() / "sweep.csv"), 1), "done");
}

// Interrupts a study of one member, with these files, behind a checkpoint.
class InterruptedSweep : public StoppedSweep {
 protected:
  void interrupt() {
    std::ofstream(here() / "square.msh")
        << content_of(std::string(TOURMALINE_SOURCE_DIR) + "/tests/cli/square.msh");
    std::string text = small_case;
    text.replace(0, text.find('\n'), "mesh.file = \"square.msh\"");
    std::ofstream(here() / "small.toml") << text;
    std::thread sender([&] {
      EXPECT_TRUE(happens([&] { return exists(member() / "checkpoint.bin"); }));
      ::kill(std::stoi(content_of(folder_ / "pid")), SIGTERM);
    });
    EXPECT_EQ(run(all(), "echo $$ > ../pid; exec"), 128 + SIGTERM) << complained_;
    sender.join();
  }
  void expect_new_start(const std::string &reason) {
    EXPECT_EQ(run(all()), 0) << complained_;
    EXPECT_THAT(complained_, AllOf(HasSubstr("bound=5 starts from the beginning, as its "
                                             "interrupted run cannot go on: "),
                                   HasSubstr(reason), Not(HasSubstr("--resume"))));
    EXPECT_THAT(said_, HasSubstr("1 cases: 0 done before, 0 failed"));
  }
  std::filesystem::path member() const { return study() / "bound=5"; }
  std::string all() const {
    return "sweep small.toml --vary contact.friction.bound=5 --set time.steps=3000 "
           "--set 'output.checkpoint=\"5 steps\"' -o '" +
           study().string() + "'";
  }
};

TEST_F(InterruptedSweep, StartsAnewWhereItsMeshHasChanged) {
  interrupt();
  std::string mesh = content_of(here() / "square.msh");
  const auto at = mesh.find("0.5 0.5 0");
  ASSERT_NE(at, std::string::npos);
  std::ofstream(here() / "square.msh") << mesh.replace(at, 9, "0.5 0.6 0");
  expect_new_start("the content of");
}

TEST_F(InterruptedSweep, StartsAnewWhereItsCheckpointIsDamaged) {
  interrupt();
  std::ofstream(member() / "checkpoint.bin", std::ios::binary | std::ios::in | std::ios::out)
      .seekp(100)
      .write("damaged", 7);
  expect_new_start("is damaged");
}

TEST_F(InterruptedSweep, StartsAnewWhereATableIsMissing) {
  interrupt();
  remove(member() / "history.csv");
  expect_new_start("history.csv, on which the checkpoint counts, is missing");
}

TEST_F(StoppedSweep, ASecondStudyInTheFolderIsRefused) {
  std::string second;
  int status = -1;
  std::thread other([&] {
    EXPECT_TRUE(happens([&] { return exists(study() / "steps=200000000/resolved.toml"); }));
    const std::string command = "cd '" + here().string() + "' && '" + binary() +
                                "' sweep small.toml --vary time.steps=2,3 -o '" + study().string() +
                                "' > ../second 2>&1";
    const int end = std::system(command.c_str());
    status = WIFEXITED(end) ? WEXITSTATUS(end) : -1;
    second = content_of(folder_ / "second");
    ::kill(std::stoi(content_of(folder_ / "pid")), SIGTERM);
  });
  run("sweep small.toml --vary time.steps=200000000 --jobs 1 -o '" + study().string() + "'",
      "echo $$ > ../pid; exec");
  other.join();
  EXPECT_EQ(status, 4);
  EXPECT_THAT(second, AllOf(HasSubstr("another run (process "), HasSubstr("study;")));
  EXPECT_FALSE(exists(study() / "steps=2"));
}

TEST_F(StoppedSweep, ALogThatSomebodyRemovesCostsNoCase) {
  std::thread remover([&] {
    EXPECT_TRUE(happens([&] { return exists(study() / "steps=200000000/resolved.toml"); }));
    remove(study() / "steps=200000000/error.txt");
    ::kill(std::stoi(content_of(study() / "steps=200000000/run.lock")), SIGKILL);
  });
  EXPECT_EQ(
      run("sweep small.toml --vary time.steps=200000000,2 --jobs 1 -o '" + study().string() + "'"),
      4);
  remover.join();
  EXPECT_THAT(complained_, HasSubstr("steps=200000000 failed: was killed by the signal 9"));
  EXPECT_THAT(said_, HasSubstr("2 cases: 0 done before, 1 failed"));
}

TEST_F(StoppedSweep, RunsEndWithItWhateverEndsIt) {
  status_after(SIGKILL);
  EXPECT_TRUE(happens([&] { return processes_in(study()) == 0; }));
}

}  // namespace
