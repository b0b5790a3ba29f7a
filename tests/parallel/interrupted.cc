// Runs on several ranks that are stopped or killed, and go on with --resume.

#include <chrono>
#include <csignal>
#include <future>

#include "../cases/slipping_block.h"
#include "../cases/thrown_block.h"
#include "ranks.h"

namespace tourmaline::verified {
namespace {

using output::content_of;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// However long the run takes to come there; false where it was done before. The first rank's number
// stands in the lock of the folder.
bool send_behind_a_checkpoint(int signal, const fs::path &folder, const std::future<Outcome> &run) {
  while (run.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready)
    if (fs::exists(folder / "checkpoint.bin")) {
      int rank = 0;
      std::ifstream(folder / "run.lock") >> rank;
      return rank > 0 && kill(rank, signal) == 0;
    }
  return false;
}

class Interrupted : public Ranks {
 protected:
  // Ends with the signal behind its first checkpoint, and goes on. On a busy machine the run may be
  // done before anybody looks.
  void interrupt(const std::string &arguments, int signal) {
    constexpr int attempts = 5;
    for (int i = 0; i < attempts && before_.status == 0; ++i) {
      fs::remove_all(folder_ / "other");
      before_ = interrupted(arguments, signal);
    }
    ASSERT_NE(before_.status, 0) << "too fast to be interrupted";
    const Outcome resumed = run_on(GetParam(), arguments + " --resume", folder_ / "other");
    ASSERT_EQ(resumed.status, 0) << resumed.said;
    const Outcome whole = run_on(GetParam(), arguments, folder_ / "one");
    ASSERT_EQ(whole.status, 0) << whole.said;
  }
  Outcome interrupted(const std::string &arguments, int signal) const {
    auto run = std::async(std::launch::async,
                          [&] { return run_on(GetParam(), arguments, folder_ / "other"); });
    send_behind_a_checkpoint(signal, folder_ / "other", run);
    return run.get();
  }
  // But for the page and the summary, which hold times.
  void expect_same_bytes() const {
    for (const auto &entry : fs::directory_iterator(folder_ / "one")) {
      const std::string name = entry.path().filename().string();
      if (name != "summary.json" && name != "report.html") {
        EXPECT_TRUE(content_of(entry.path()) == content_of(folder_ / "other" / name)) << name;
      }
    }
  }
  void expect_same_numbers() const {
    expect_equal_results(results_in(folder_ / "one"), results_in(folder_ / "other"));
  }

  Outcome before_{};
};

TEST_P(Interrupted, KilledItGoesOnToTheSameBytesWhereTheSolutionIsIterative) {
  interrupt(file_of(slipping_block) +
                " --set time.steps=12 --set output.every=5 --set solver.body=iterative "
                "--set output.checkpoint=2steps",
            SIGKILL);
  expect_same_bytes();
}

// Its nodes have other numbers on each rank, as the first ones by place, on the left, have not.
TEST_P(Interrupted, KilledItGoesOnToTheSameBytesWhereItsContactIsBelow) {
  interrupt(file_of(R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [24, 12], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 12 }
boundary = [ { on = "top", displacement = ["2e-7*t", "-5e-7*sin(4*t)"], potential = 0, temperature = 0 } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.3 } }
output = { every = 5, checkpoint = "2 steps" }
solver = { body = "iterative", linear_tolerance = 1e-13 }
)toml"),
            SIGKILL);
  expect_same_bytes();
}

// MUMPS on several ranks adds in the order in which messages arrive: no two runs have the same last
// bits.
TEST_P(Interrupted, KilledItGoesOnToTheSameNumbersWithAFactorisation) {
  interrupt(paper_ + "--set time.steps=20 --set output.every=10 --set output.checkpoint=2steps",
            SIGKILL);
  expect_same_numbers();
}

TEST_P(Interrupted, StoppedItSaysSoOnceAndGoesOn) {
  interrupt(
      paper_ + "--set solver.method=monolithic --set time.steps=20 --set output.checkpoint=2steps",
      SIGTERM);
  EXPECT_EQ(before_.status, 128 + SIGTERM) << before_.said;
  EXPECT_EQ(count(before_.said, "tourmaline: stopped by SIGTERM after step "), 1) << before_.said;
  EXPECT_EQ(count(before_.said, "mpirun -np " + std::to_string(GetParam())), 1) << before_.said;
  expect_same_numbers();
}

TEST_P(Interrupted, AnotherNumberOfRanksIsRefused) {
  const std::string arguments =
      paper_ + "--set time.steps=1000 --set output.fields=false --set output.checkpoint=2steps";
  ASSERT_EQ(interrupted(arguments, SIGTERM).status, 128 + SIGTERM);
  const Outcome alone = run_on(1, arguments + " --resume", folder_ / "other");
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.said, HasSubstr("mpirun -np " + std::to_string(GetParam())));
  EXPECT_TRUE(fs::exists(folder_ / "other" / "checkpoint.bin"));
}

TEST_P(Interrupted, ADynamicRunGoesOnToTheSameBytes) {
  interrupt(file_of(thrown_block(2)) +
                " --set time.steps=60 --set output.every=20 --set solver.body=iterative "
                "--set output.checkpoint=2steps",
            SIGKILL);
  expect_same_bytes();
}

INSTANTIATE_TEST_SUITE_P(Two, Interrupted, ::testing::Values(2));

}  // namespace
}  // namespace tourmaline::verified
