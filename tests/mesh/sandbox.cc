#include "../../src/mesh/sandbox.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <thread>

#include "../../src/mesh/child_process.h"
#include "../output/temporary_folder.h"
#include "tourmaline/error.h"

namespace tourmaline::mesh {
namespace {

using testing::HasSubstr;

std::string name_of(Ending ending) {
  const char *names[] = {"crashed",   "out of time", "out of memory",
                         "forbidden", "silent",      "waiting"};
  return names[static_cast<int>(ending)];
}

/// What `work` returns in a child, or how the child ended.
std::string in_child(const std::function<std::string()> &work, const Limits &limits = {}) {
  try {
    return in_child_process(work, limits, name_of);
  } catch (const CaseError &error) {
    return error.what();
  }
}

double seconds_of(const std::function<void()> &work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Sandbox : public testing::Test {
 protected:
  Sandbox() {
    std::filesystem::create_directory(inside());
    std::ofstream(inside() / "near") << "text";
    std::ofstream(folder_ / "far") << "text";
    std::filesystem::create_symlink(folder_ / "far", inside() / "link");
  }
  std::filesystem::path inside() const { return folder_ / "inside"; }
  /// "yes" if `attempt` can be done behind these walls.
  std::string can(const std::function<bool()> &attempt, Walls walls = {true, false, true}) const {
    return in_child([&]() -> std::string {
      const Walls stand = confine({inside()}, walls);
      if (stand.landlock != walls.landlock || stand.namespaces != walls.namespaces ||
          stand.seccomp != walls.seccomp)
        return "a wall is missing";
      return attempt() ? "yes" : "no";
    });
  }
  static bool opens(const std::filesystem::path &file, int flags) {
    return open(file.c_str(), flags, 0600) >= 0;
  }

  output::TemporaryFolder folder_;
};

constexpr Walls both{true, false, true}, files{true, false, false}, hidden{false, true, true},
    calls{false, false, true}, none{false, false, false};

TEST_F(Sandbox, WhatLiesInTheFolderCanBeReadAndNothingElse) {
  for (const Walls walls : {both, files, hidden}) {
    EXPECT_EQ(can([&] { return opens(inside() / "near", O_RDONLY); }, walls), "yes");
    EXPECT_EQ(can([&] { return opens(inside(), O_RDONLY | O_DIRECTORY); }, walls), "yes");
    for (const std::filesystem::path &file :
         {folder_ / "far", inside() / "link", inside() / ".." / "far",
          std::filesystem::path("/etc/passwd")})
      EXPECT_EQ(can([&] { return opens(file, O_RDONLY); }, walls), "no") << file;
  }
  EXPECT_EQ(can([&] { return opens(folder_ / "far", O_RDONLY); }, none), "yes");
}

TEST_F(Sandbox, NothingCanBeWrittenByEitherWall) {
  for (const Walls walls : {both, files, hidden, calls}) {
    EXPECT_EQ(can([&] { return opens(inside() / "new", O_WRONLY | O_CREAT); }, walls), "no");
    EXPECT_EQ(can([&] { return opens(inside() / "near", O_RDWR); }, walls), "no");
    EXPECT_EQ(can([&] { return opens(inside() / "near", O_WRONLY | O_TRUNC); }, walls), "no");
    EXPECT_EQ(can([&] { return unlink((inside() / "near").c_str()) == 0; }, walls), "no");
    EXPECT_EQ(can([&] { return mkdir((inside() / "new").c_str(), 0700) == 0; }, walls), "no");
    EXPECT_EQ(can([&] { return symlink("near", (inside() / "new").c_str()) == 0; }, walls), "no");
    EXPECT_EQ(
        can([&] { return rename((inside() / "near").c_str(), (inside() / "new").c_str()) == 0; },
            walls),
        "no");
    EXPECT_EQ(can([] { return opens("new", O_WRONLY | O_CREAT); }, walls), "no");
  }
  EXPECT_EQ(can([&] { return chmod((inside() / "near").c_str(), 0777) == 0; }, calls), "no");
  EXPECT_EQ(output::content_of(inside() / "near"), "text");
}

TEST_F(Sandbox, NoProgramIsStartedAndNoProcess) {
  for (const Walls walls : {both, hidden, calls}) {
    EXPECT_EQ(can([] { return system("true") == 0; }, walls), "forbidden");
    EXPECT_EQ(can([] { return fork() >= 0; }, walls), "forbidden");
    EXPECT_EQ(can([] { return popen("true", "r") != nullptr; }, walls), "no");
    EXPECT_EQ(can([] { return execl("/bin/true", "true", nullptr) == 0; }, walls), "forbidden");
  }
  EXPECT_EQ(can(
                [] {  // Landlock alone lets no file be run either
                  return execl("/bin/true", "true", nullptr) == 0;
                },
                files),
            "no");
  EXPECT_EQ(can([] {
              bool ran = false;
              std::thread([&] { ran = true; }).join();
              return ran;
            }),
            "yes");
}

TEST_F(Sandbox, NoSocketIsOpened) {
  for (const Walls walls : {both, hidden, calls})
    for (const int family : {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK})
      EXPECT_EQ(can([&] { return socket(family, SOCK_DGRAM, 0) >= 0; }, walls), "no") << family;
  EXPECT_EQ(can([] { return socket(AF_UNIX, SOCK_DGRAM, 0) >= 0; }, none), "yes");
}

TEST_F(Sandbox, NobodyElseIsTouched) {
  const auto parent = getpid();
  EXPECT_EQ(can([&] { return kill(parent, 0) == 0; }), "no");
  EXPECT_EQ(can([] { return kill(getpid(), 0) == 0; }), "yes");
  EXPECT_EQ(can([] {
              return mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1,
                          0) != MAP_FAILED;
            }),
            "no");
}

TEST_F(Sandbox, TheChildHasNoOpenFilesOfItsParent) {
  const int first = open((folder_ / "far").c_str(), O_RDONLY), file = fcntl(first, F_DUPFD, 20);
  ASSERT_GE(file, 20);
  EXPECT_EQ(can([&] { return fcntl(file, F_GETFD) >= 0; }, none), "no");
  close(file);
  close(first);
}

TEST(ChildProcess, OneThatDoesNotEndIsEndedByTheLimitsOfTime) {
  const auto forever = [] {
    while (getppid() != 0)
      ;
    return std::string();
  };
  EXPECT_EQ(in_child(forever, {.processor_seconds = 1}), "out of time");
  EXPECT_EQ(in_child(
                [] {
                  pause();
                  return std::string();
                },
                {.seconds = 0.5}),
            "out of time");
}

#if !defined(TOURMALINE_SANITIZED)
TEST(ChildProcess, MemoryHasALimit) {
  const auto greedy = [] { return std::string(200 << 20, 'a').substr(0, 1); };
  EXPECT_EQ(in_child(greedy, {.bytes = 100 << 20}), "out of memory");
  EXPECT_EQ(in_child(greedy, {.bytes = 1 << 30}), "a");
}
#endif

TEST(ChildProcess, EndingsAreToldApart) {
  EXPECT_EQ(in_child([] {
              abort();
              return std::string();
            }),
            "crashed");
  EXPECT_EQ(in_child([] {
              raise(SIGKILL);
              return std::string();
            }),
            "out of memory");
  EXPECT_EQ(in_child([] {
              _exit(0);
              return std::string();
            }),
            "silent");
  EXPECT_EQ(in_child([] {
              _exit(1);
              return std::string();
            }),
            "crashed");
  EXPECT_EQ(in_child([]() -> std::string { throw CaseError("wrong"); }), "wrong");
}

// In the child it would come out of `in_child`, into what its parent goes on with.
TEST(ChildProcess, NoExceptionComesOutOfTheChild) {
  std::string ending;
  try {
    ending = in_child([]() -> std::string { throw std::runtime_error("that nobody expects"); });
  } catch (const std::runtime_error &) {
    _exit(0);
  }
  EXPECT_EQ(ending, "crashed");
}

TEST(ChildProcess, GrandchildrenThatHoldThePipeAreNotWaitedFor) {
  EXPECT_LT(seconds_of([] {
              EXPECT_EQ(in_child([] {
                          if (fork() == 0) {
                            sleep(5);
                            _exit(0);
                          }
                          return std::string("done");
                        }),
                        "done");
            }),
            4);
}

// A process between this one and the child is killed.
TEST(ChildProcess, ItEndsWithItsParent) {
  const pid_t between = fork();
  if (between == 0) {
    in_child([&] {
      pause();
      return std::string();
    });
    _exit(0);
  }
  const std::string children =
      "/proc/" + std::to_string(between) + "/task/" + std::to_string(between) + "/children";
  pid_t child = 0;
  for (int i = 0; i < 600 && child == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    std::ifstream(children) >> child;
  }
  ASSERT_GT(child, 0);
  kill(between, SIGKILL);
  waitpid(between, nullptr, 0);
  const auto lives = [&] {
    std::ifstream status("/proc/" + std::to_string(child) + "/stat");
    std::string id, name, state;
    return bool(status >> id >> name >> state) && state != "Z" && state != "X";
  };
  for (int i = 0; i < 600 && lives(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_FALSE(lives());
}

}  // namespace
}  // namespace tourmaline::mesh
