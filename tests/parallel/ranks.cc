// The same case on one rank and on several: the same numbers, and one message where it fails.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

struct Outcome {
  int status;
  std::string said;
};

std::string contents(const fs::path &file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Runs the program as a user would; more ranks than cores are allowed.
Outcome run(int ranks, const std::string &arguments, const fs::path &folder) {
  const fs::path said = folder.string() + ".stderr";
  const std::string launcher =
      ranks == 1 ? "" : "mpirun --oversubscribe --bind-to none -np " + std::to_string(ranks) + " ";
  const int status = std::system((launcher + TOURMALINE_BINARY + " run " + arguments + " -q -o '" +
                                  folder.string() + "' > /dev/null 2> '" + said.string() + "'")
                                     .c_str());
  return {WEXITSTATUS(status), contents(said)};
}

using Table = std::map<std::string, std::vector<std::string>>;

Table table(const fs::path &file) {
  std::ifstream in(file);
  std::string line, entry;
  std::vector<std::string> names;
  Table columns;
  for (bool header = true; std::getline(in, line); header = false) {
    std::istringstream entries(line);
    for (std::size_t i = 0; std::getline(entries, entry, ','); ++i)
      if (header)
        names.push_back(entry);
      else
        columns[names[i]].push_back(entry);
  }
  return columns;
}

// Largest difference over the largest size of a column.
double difference(const std::vector<std::string> &one, const std::vector<std::string> &several) {
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double a = std::stod(one[i]), b = std::stod(several[i]);
    worst = std::max(worst, std::abs(a - b));
    size = std::max(size, std::abs(a));
  }
  return size > 0 ? worst / size : worst;
}

void expect_equal_tables(const fs::path &one, const fs::path &several) {
  const Table expected = table(one), found = table(several);
  ASSERT_FALSE(expected.empty()) << one;
  for (const auto &[name, values] : expected) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(found.count(name));
    ASSERT_EQ(found.at(name).size(), values.size());
    if (name == "status")
      EXPECT_EQ(found.at(name), values);
    else
      EXPECT_LE(difference(values, found.at(name)), 1e-9);
  }
}

// A block of tetrahedra whose contact slips in different directions.
const char *const block = R"toml(
[mesh]
box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [5, 5, 5], cell = "tetrahedron" }
[material]
library = "BaTiO3-Liu2014"
pyroelectric = [0, 0, 1e-4]
[time]
end = 0.2
steps = 4
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

class Ranks : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string block_case() const {
    std::ofstream(folder_ / "block.toml") << block;
    return (folder_ / "block.toml").string();
  }

  void expect_same(const std::string &arguments) {
    const Outcome one = run(1, arguments, folder_ / "one");
    ASSERT_EQ(one.status, 0) << one.said;
    const Outcome several = run(GetParam(), arguments, folder_ / "several");
    ASSERT_EQ(several.status, 0) << several.said;
    for (const char *name : {"nodes.csv", "contact.csv"})
      expect_equal_tables(folder_ / "one" / name, folder_ / "several" / name);
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("tourmaline_ranks_" + std::to_string(getpid()));
  const std::string paper_ = std::string(TOURMALINE_SOURCE_DIR) +
                             "/cases/ouafik-2020/conductive.toml --set mesh.box.cells=[16,16] ";
};

TEST_P(Ranks, ThePaperSExampleIsTheSame) {
  expect_same(paper_);
}

TEST_P(Ranks, TheMonolithicRouteIsTheSame) {
  expect_same(paper_ + "--set 'solver.method=\"monolithic\"' --set time.steps=4");
}

TEST_P(Ranks, QuadraticElementsAreTheSame) {
  expect_same(paper_ + "--set mesh.degree=2 --set 'mesh.box.cell=\"quadrilateral\"'");
}

TEST_P(Ranks, ABlockOfTetrahedraIsTheSame) {
  expect_same(block_case());
}

TEST_P(Ranks, ABlockOfHexahedraIsTheSame) {
  expect_same(block_case() + " --set 'mesh.box.cell=\"hexahedron\"'");
}

TEST_P(Ranks, LoadsThatDependOnPlaceAndTimeAreTheSame) {
  expect_same(block_case() +
              " --set 'load.force=[\"1e3*x*t\",\"1e3*y*t*t\",0]' --set 'load.heat=\"1e2*z*t\"'"
              " --set 'contact.heat.coefficient=\"1+10*y\"'");
}

TEST_P(Ranks, EveryRankLeavesItsCellsAndOneFileJoinsThem) {
  ASSERT_EQ(run(GetParam(), paper_ + "--set time.steps=1", folder_ / "several").status, 0);
  const std::string joined = contents(folder_ / "several" / "result_0001.pvtu");
  for (int rank = 0; rank < GetParam(); ++rank) {
    const std::string piece = "result_0001_" + std::to_string(rank) + ".vtu";
    EXPECT_THAT(joined, HasSubstr("Source=\"" + piece + "\""));
    EXPECT_TRUE(fs::exists(folder_ / "several" / piece));
  }
  EXPECT_THAT(contents(folder_ / "several" / "result.pvd"), HasSubstr("result_0001.pvtu"));
}

int count(const std::string &text, const std::string &piece) {
  int found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1))
    ++found;
  return found;
}

TEST_P(Ranks, AWrongCaseIsToldOnce) {
  const Outcome outcome = run(GetParam(), paper_ + "--set time.stps=3", folder_ / "several");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(count(outcome.said, "tourmaline: "), 1) << outcome.said;
}

TEST_P(Ranks, WhatOnlyOneRankSeesEndsAllWithOneMessage) {
  const Outcome outcome =
      run(GetParam(), paper_ + "--set 'contact.heat.coefficient=\"if(y<0.01,-1,1)\"'",
          folder_ / "several");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(count(outcome.said, "tourmaline: "), 1) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("negative"));
}

TEST_P(Ranks, AFailedSolveIsToldOnce) {
  const Outcome outcome =
      run(GetParam(), paper_ + "--set solver.tolerance=1e-30 --set solver.max_iterations=3",
          folder_ / "several");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(count(outcome.said, "tourmaline: "), 1) << outcome.said;
}

// The first rank's number stands in the lock of the folder.
bool send_behind_a_checkpoint(int signal, const fs::path &folder) {
  for (int tries = 0; tries < 20000; ++tries) {
    if (fs::exists(folder / "checkpoint.bin"))
      return kill(std::stoi(contents(folder / "run.lock")), signal) == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

class Interrupted : public Ranks {
 protected:
  // Ends with the signal behind its first checkpoint, and goes on.
  void interrupt(const std::string &arguments, int signal) {
    auto interrupted = std::async(std::launch::async,
                                  [&] { return run(GetParam(), arguments, folder_ / "other"); });
    ASSERT_TRUE(send_behind_a_checkpoint(signal, folder_ / "other"));
    before_ = interrupted.get();
    ASSERT_NE(before_.status, 0) << "too fast to be interrupted";
    const Outcome resumed = run(GetParam(), arguments + " --resume", folder_ / "other");
    ASSERT_EQ(resumed.status, 0) << resumed.said;
    const Outcome whole = run(GetParam(), arguments, folder_ / "one");
    ASSERT_EQ(whole.status, 0) << whole.said;
  }
  // But for the page and the summary, which hold times.
  void expect_same_bytes() const {
    for (const auto &entry : fs::directory_iterator(folder_ / "one")) {
      const std::string name = entry.path().filename().string();
      if (name != "summary.json" && name != "report.html") {
        EXPECT_TRUE(contents(entry.path()) == contents(folder_ / "other" / name)) << name;
      }
    }
  }
  void expect_same_numbers() const {
    for (const char *name : {"nodes.csv", "contact.csv"})
      expect_equal_tables(folder_ / "one" / name, folder_ / "other" / name);
  }

  Outcome before_{};
};

TEST_P(Interrupted, KilledItGoesOnToTheSameBytesWhereTheSolutionIsIterative) {
  interrupt(block_case() +
                " --set time.steps=12 --set output.every=5 --set solver.body=iterative "
                "--set output.checkpoint=2steps",
            SIGKILL);
  expect_same_bytes();
}

// MUMPS on several ranks adds in the order in which messages arrive: no two runs have the same last
// bits.
TEST_P(Interrupted, KilledItGoesOnToTheSameNumbersWithAFactorisation) {
  interrupt(paper_ + "--set time.steps=40 --set output.every=10 --set output.checkpoint=2steps",
            SIGKILL);
  expect_same_numbers();
}

TEST_P(Interrupted, StoppedItSaysSoOnceAndGoesOn) {
  interrupt(paper_ + "--set solver.method=monolithic --set output.checkpoint=2steps", SIGTERM);
  EXPECT_EQ(before_.status, 128 + SIGTERM) << before_.said;
  EXPECT_EQ(count(before_.said, "tourmaline: stopped by SIGTERM after step "), 1) << before_.said;
  EXPECT_EQ(count(before_.said, "mpirun -np " + std::to_string(GetParam())), 1) << before_.said;
  expect_same_numbers();
}

TEST_P(Interrupted, AnotherNumberOfRanksIsRefused) {
  const std::string arguments =
      paper_ + "--set time.steps=1000 --set output.fields=false --set output.checkpoint=2steps";
  auto stopped =
      std::async(std::launch::async, [&] { return run(GetParam(), arguments, folder_ / "other"); });
  ASSERT_TRUE(send_behind_a_checkpoint(SIGTERM, folder_ / "other"));
  ASSERT_EQ(stopped.get().status, 128 + SIGTERM);
  const Outcome alone = run(1, arguments + " --resume", folder_ / "other");
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.said, HasSubstr("mpirun -np " + std::to_string(GetParam())));
  EXPECT_TRUE(fs::exists(folder_ / "other" / "checkpoint.bin"));
}

INSTANTIATE_TEST_SUITE_P(Two, Interrupted, testing::Values(2));

INSTANTIATE_TEST_SUITE_P(Two, Ranks, testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Four, Ranks, testing::Values(4));

}  // namespace
