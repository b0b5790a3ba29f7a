// A process that may take less memory than it needs ends with a message, whatever its limit.

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "../output/temporary_folder.h"

namespace tourmaline::output {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

struct Ended {
  int status;
  std::string errors;
};

// 124 when it did not end within a minute.
Ended run_within(int megabytes, const std::string &overrides) {
  const TemporaryFolder folder;
  const auto errors = folder.path() / "stderr";
  const std::string command =
      "ulimit -v " + std::to_string(1024 * megabytes) + "; timeout 60 " + TOURMALINE_BINARY +
      " run " + TOURMALINE_SOURCE_DIR + "/cases/ouafik-2020/conductive.toml -q -o " +
      (folder.path() / "out").string() + " " + overrides + " 2> " + errors.string();
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), content_of(errors)};
}

class MemoryLimit : public ::testing::Test {
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
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

}  // namespace
}  // namespace tourmaline::output
