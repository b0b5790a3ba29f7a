// A process that may take less than it needs of what the system shares out ends with a message,
// whatever its limit.

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <string>
#include <vector>

#include "../output/temporary_folder.h"

namespace tourmaline::output {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

struct Ended {
  int status;
  std::string errors;
};

// 124 when it did not end within a minute. What it says goes through a pipe, as the limits hold for
// files, and is joined before the limit holds for the shell.
Ended run_under(const std::string &limit, const std::string &overrides) {
  const TemporaryFolder folder;
  const auto errors = folder.path() / "stderr", status = folder.path() / "status";
  const std::string command =
      "{ ( " + limit + "; exec timeout 60 " + TOURMALINE_BINARY + " run " + TOURMALINE_SOURCE_DIR +
      "/cases/ouafik-2020/conductive.toml -q -o " + (folder.path() / "out").string() + " " +
      overrides + " ) 2>&1; echo $? > " + status.string() + "; } | cat > " + errors.string();
  [[maybe_unused]] const int ended = std::system(command.c_str());
  return {std::stoi(content_of(status)), content_of(errors)};
}

Ended run_within(int megabytes, const std::string &overrides) {
  return run_under("ulimit -v " + std::to_string(1024 * megabytes), overrides);
}

class MemoryLimit : public ::testing::Test {
  void SetUp() override {
#ifdef TOURMALINE_SANITIZED
    GTEST_SKIP() << "the sanitizer reserves terabytes of address space";
#endif
  }
};

TEST_F(MemoryLimit, OfAddressSpaceIsComparedWithTheEstimate) {
  const Ended run = run_within(4000, "--set mesh.box.cells=[1024,1024]");
  EXPECT_EQ(run.status, 4);
  EXPECT_THAT(run.errors, HasSubstr("this mesh needs about"));
  EXPECT_THAT(run.errors, HasSubstr("ulimit -v"));
}

TEST_F(MemoryLimit, HoweverTightNeverLeavesTheProgramHanging) {
  bool succeeded = false;
  for (int megabytes = 250; megabytes < 8000 && !succeeded; megabytes += megabytes / 5) {
    SCOPED_TRACE(megabytes);
    const Ended run = run_within(megabytes, "--set mesh.box.cells=[64,64] --set time.steps=1");
    succeeded = run.status == 0;
    if (!succeeded && run.errors.find("loading shared libraries") == std::string::npos) {
      EXPECT_EQ(run.status, 4);
      EXPECT_THAT(run.errors, AnyOf(HasSubstr("not enough memory"), HasSubstr("ulimit -v")));
    }
  }
  EXPECT_TRUE(succeeded);
}

// What OpenBLAS does not survive lies between what the system loads and what the program asks for.
TEST_F(MemoryLimit, BelowWhatTheLibrariesNeedItEndsAtOnce) {
  for (int megabytes = 450; megabytes < 1000; megabytes += 50) {
    const Ended run = run_within(megabytes, "--set mesh.box.cells=[8,8] --set time.steps=1");
    if (run.status != 0 && run.errors.find("loading shared libraries") == std::string::npos) {
      EXPECT_EQ(run.status, 4) << megabytes;
      EXPECT_THAT(run.errors, testing::StartsWith("tourmaline: not enough memory to start"));
      EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
    }
  }
}

// OpenBLAS would ask for its buffers for ever.
TEST_F(MemoryLimit, HoweverTightNeverLeavesThreadsHanging) {
  int failed = 0;
  for (const int megabytes : {1500, 3000, 6000, 12000}) {
    SCOPED_TRACE(megabytes);
    const Ended run = run_within(
        megabytes, "--set mesh.box.cells=[8,8] --set time.steps=1 --set solver.threads=24");
    if (run.status == 0)
      continue;
    ++failed;
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.errors, HasSubstr("solver.threads"));
    EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
  }
  EXPECT_GT(failed, 0);
}

struct Limit {
  char option;  // of ulimit
  const char *name;
  std::vector<int> values;
};

void PrintTo(const Limit &limit, std::ostream *out) {
  *out << "ulimit -" << limit.option;
}

class ProcessLimit : public MemoryLimit, public ::testing::WithParamInterface<Limit> {};

TEST_P(ProcessLimit, EndsItInOneSentenceOrNotAtAll) {
  const Limit &limit = GetParam();
  int failed = 0;
  for (const int value : limit.values) {
    SCOPED_TRACE(value);
    const Ended run =
        run_under(std::string("ulimit -") + limit.option + " " + std::to_string(value),
                  "--set mesh.box.cells=[24,24] --set output.report=false --set time.steps=" +
                      std::string(limit.option == 't' ? "100000 --set output.every=100000" : "2"));
    if (run.status == 0 && limit.option != 't')
      continue;
    ++failed;
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.errors, testing::StartsWith("tourmaline: "));
    EXPECT_THAT(run.errors, HasSubstr(limit.name));
    EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
  }
  EXPECT_GT(failed, 0);
}

INSTANTIATE_TEST_SUITE_P(Limits, ProcessLimit,
                         ::testing::Values(Limit{'n', "(ulimit -n)", {5, 8, 10, 12, 16, 24, 40}},
                                           Limit{'f', "(ulimit -f)", {0, 1, 8, 100}},
                                           Limit{'s', "(ulimit -s)", {64, 256, 1000, 1100}},
                                           // 1 s a busy machine may take to load the libraries.
                                           Limit{'t', "(ulimit -t)", {2, 3}}),
                         [](const auto &of) { return std::string(1, of.param.option); });

}  // namespace
}  // namespace tourmaline::output
