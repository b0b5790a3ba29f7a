#include "sweep/processes.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <iostream>

#include "../output/temporary_folder.h"
#include "tourmaline/error.h"

namespace tourmaline::sweep {
namespace {

using namespace std::chrono_literals;

Processes::Work shell(const std::string &commands) {
  return [commands] { return ::execl("/bin/sh", "/bin/sh", "-c", commands.c_str(), nullptr); };
}

class RunningProcesses : public testing::Test {
 protected:
  void start(std::size_t number, const std::string &commands) {
    processes.start(number, shell(commands), log());
  }
  std::filesystem::path log() const { return folder / "log"; }

  /// Waits without giving up before a busy machine would.
  Processes::End next_end() {
    for (int i = 0; i < 600; ++i)
      if (const auto end = processes.wait(100ms))
        return *end;
    throw std::runtime_error("nothing has ended within a minute");
  }

  output::TemporaryFolder folder;
  Processes processes;
};

TEST_F(RunningProcesses, EachEndIsToldWithItsNumberAndStatus) {
  start(7, "exit 3");
  EXPECT_EQ(processes.running(), 1u);
  const Processes::End end = next_end();
  EXPECT_EQ(end.number, 7u);
  EXPECT_EQ(end.status, 3);
  EXPECT_EQ(processes.running(), 0u);
}

TEST_F(RunningProcesses, OneThatASignalKilledHasTheStatusOfTheShell) {
  start(0, "kill -9 $$");
  EXPECT_EQ(next_end().status, 128 + SIGKILL);
}

TEST_F(RunningProcesses, NothingOfThisProcessIsOpenOrWrittenTwice) {
  std::cout << "not yet written\n";
  const int file = ::open("/dev/null", O_RDONLY);
  processes.start(
      0, [file] { return ::fcntl(file, F_GETFD) == -1 && errno == EBADF ? 5 : 6; }, log());
  EXPECT_EQ(next_end().status, 5);
  EXPECT_THAT(output::content_of(log()), testing::Not(testing::HasSubstr("not yet written")));
  ::close(file);
}

TEST_F(RunningProcesses, TheyHearSignalsAsThisProcessDidBefore) {
  processes.start(
      0,
      [] {
        ::raise(SIGTERM);
        return 0;
      },
      log());
  EXPECT_EQ(next_end().status, 128 + SIGTERM);
}

TEST_F(RunningProcesses, WhatTheySayIsInTheLog) {
  start(0, "echo out; echo wrong >&2");
  next_end();
  EXPECT_EQ(output::content_of(log()), "out\nwrong\n");
}

TEST_F(RunningProcesses, ALogThatCannotBeWrittenIsTheMachinesFailure) {
  EXPECT_THROW(processes.start(
                   0, [] { return 0; }, folder / "no/such/folder/log"),
               MachineError);
}

TEST_F(RunningProcesses, TheyRunSideBySide) {
  // Each waits for the file that the other one makes.
  const std::string place = folder.path().string();
  start(0, "touch " + place + "/a; while [ ! -e " + place + "/b ]; do sleep 0.02; done");
  start(1, "touch " + place + "/b; while [ ! -e " + place + "/a ]; do sleep 0.02; done");
  EXPECT_EQ(next_end().status, 0);
  EXPECT_EQ(next_end().status, 0);
}

TEST_F(RunningProcesses, WaitingEndsAfterTheGivenTime) {
  start(0, "sleep 60");
  EXPECT_FALSE(processes.wait(10ms));
  processes.send(SIGKILL);
  EXPECT_EQ(next_end().status, 128 + SIGKILL);
}

TEST_F(RunningProcesses, SignalsToThisProcessOnlyLeaveANote) {
  EXPECT_EQ(processes.take_signal(), 0);
  raise(SIGTERM);
  EXPECT_EQ(processes.take_signal(), SIGTERM);
  EXPECT_EQ(processes.take_signal(), 0);
}

TEST(Processes, ThoseThatStillRunAreKilledAtTheEnd) {
  const output::TemporaryFolder folder;
  const std::string file = (folder / "pid").string();
  {
    Processes processes;
    processes.start(
        0, shell("echo $$ > " + file + ".part; mv " + file + ".part " + file + "; sleep 60"),
        folder / "log");
    for (int i = 0; i < 600 && !std::filesystem::exists(file); ++i)
      processes.wait(100ms);
  }
  EXPECT_EQ(::kill(std::stoi(output::content_of(file)), 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

}  // namespace
}  // namespace tourmaline::sweep
