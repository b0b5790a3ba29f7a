// Programs of somebody else's on the library: processes of their own, as MPI lasts as long as one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "../cases/read_table.h"
#include "../output/temporary_folder.h"

namespace tourmaline::verified {
namespace {

using output::content_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Outcome {
  int status;
  std::string said;
};

class OwnProgram : public ::testing::Test {
 protected:
  // One that waits for ever has status 124.
  Outcome start(const std::string &command) const {
    const auto said = folder_ / "said";
    const int status =
        std::system(("timeout 300 " + command + " > /dev/null 2> '" + said.string() + "'").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), content_of(said)};
  }
  static std::string launcher(int ranks) {
    return ranks == 1 ? ""
                      : "mpirun --oversubscribe --bind-to none -np " + std::to_string(ranks) + " ";
  }
  Outcome run(const std::string &into, const std::string &options, int ranks = 1) const {
    return start(launcher(ranks) + OWN_PROGRAM + case_and_size(into) + options);
  }
  std::string case_and_size(const std::string &into) const {
    return std::string(" '") + TOURMALINE_SOURCE_DIR + "/cases/block-3d/twisted.toml' '" +
           (folder_ / into).string() +
           "' mesh.box.cells=[3,3,3] time.steps=4 output.fields=false output.report=false ";
  }
  std::string contact(const std::string &of) const {
    return content_of(folder_ / of / "contact.csv");
  }

  output::TemporaryFolder folder_;
};

TEST_F(OwnProgram, RunsACaseTwiceToTheSameBytes) {
  for (const char *route : {"solver.body=direct", "solver.body=iterative"}) {
    const Outcome outcome = run("one", std::string("twice ") + route);
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_EQ(contact("one"), contact("one/again"));
  }
}

TEST_F(OwnProgram, ItsLawGoesOnAfterAnInterruptionToTheSameBytes) {
  for (const std::string route :
       {"solver.body=direct", "solver.body=iterative", "solver.method=monolithic"}) {
    SCOPED_TRACE(route);
    const std::string options = "'output.checkpoint=\"2 steps\"' bound=15 " + route;
    ASSERT_EQ(run("whole", options).status, 0);
    ASSERT_NE(run("killed", options + " fault=kill from=0.12").status, 0);
    ASSERT_TRUE(std::filesystem::exists(folder_ / "killed" / "checkpoint.bin"));
    const Outcome other = run("killed", options + " resume bound=3");
    EXPECT_EQ(other.status, 2);
    EXPECT_THAT(other.said,
                HasSubstr("the friction law was \"borrowed, 15 N/m^2\" of a program, is "
                          "\"borrowed, 3 N/m^2\" of a program"));
    const Outcome stock = run("killed", "'output.checkpoint=\"2 steps\"' resume " + route);
    EXPECT_EQ(stock.status, 2);
    EXPECT_THAT(stock.said, HasSubstr("the friction law was \"borrowed, 15 N/m^2\" of a program, "
                                      "is that of the case"));
    const Outcome same = run("killed", options + " resume");
    EXPECT_EQ(same.status, 0) << same.said;
    EXPECT_EQ(contact("killed"), contact("whole"));
    EXPECT_EQ(run("killed", options + " resume bound=3").status, 2) << "a complete run";
    std::filesystem::remove_all(folder_ / "killed");
  }
}

TEST_F(OwnProgram, ResultsNameItsLaw) {
  ASSERT_EQ(run("one", "bound=15").status, 0);
  EXPECT_THAT(content_of(folder_ / "one" / "resolved.toml"),
              HasSubstr("friction laws of a program: borrowed, 15 N/m^2\n"));
  EXPECT_THAT(content_of(folder_ / "one" / "summary.json"),
              HasSubstr("\"friction_law\": \"borrowed, 15 N/m^2\""));
}

// On contact that opens the case's laws have one.
TEST_F(OwnProgram, ItsLawHasNoColumnOfBounds) {
  const Outcome outcome = run("one", "contact.normal=unilateral bound=15");
  EXPECT_EQ(outcome.status, 0) << outcome.said;
  EXPECT_THAT(contact("one"),
              AllOf(HasSubstr("normal_traction"), Not(HasSubstr("friction_bound"))));
}

TEST_F(OwnProgram, OnSeveralRanksItsLawGivesTheSame) {
  for (const std::string route :
       {"solver.body=direct", "solver.body=iterative", "solver.method=monolithic"}) {
    SCOPED_TRACE(route);
    ASSERT_EQ(run("one", "bound=15 " + route).status, 0);
    const Outcome outcome = run("two", "bound=15 " + route, 2);
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    const Table one = read_table(folder_ / "one" / "contact.csv"),
                two = read_table(folder_ / "two" / "contact.csv");
    EXPECT_EQ(one.columns.at("status"), two.columns.at("status"));
    for (const char *column :
         {"slip_y", "slip_z", "tangential_traction_y", "tangential_traction_z"})
      EXPECT_LE(difference(two, one, column, largest(one, column)), 1e-7) << column;
  }
}

class Fault : public OwnProgram,
              public ::testing::WithParamInterface<std::pair<const char *, const char *>> {};

TEST_P(Fault, OfALawIsNamedWithLawAndPlaceOnEveryRoute) {
  const auto [fault, text] = GetParam();
  for (const std::string route :
       {"solver.body=direct", "solver.body=iterative", "solver.method=monolithic"}) {
    SCOPED_TRACE(route);
    const Outcome outcome = run("one", "bound=15 " + route + " fault=" + fault);
    EXPECT_EQ(outcome.status, 2) << outcome.said;
    EXPECT_THAT(outcome.said,
                AllOf(HasSubstr("the friction law \"borrowed, 15 N/m^2\" at ("), HasSubstr(text)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Fault,
    ::testing::Values(std::pair("size", "has 1 components, and must have 2"),
                      std::pair("nan", "holds a value that is no finite number"),
                      std::pair("status", "is stick, but traction of the same is"),
                      std::pair("throw", "traction threw an exception: out of tables"),
                      std::pair("throw-number", "none of the standard library's"),
                      std::pair("empty", "its OwnLaw is empty"),
                      std::pair("endless", "the bound of Tresca's law is inf N/m^2")),
    [](const auto &p) {
      std::string name = p.param.first;
      std::erase(name, '-');
      return name;
    });

TEST_F(OwnProgram, AnErrorOfOneRankAloneEndsAll) {
  for (const std::string route : {"solver.body=iterative", "solver.method=monolithic"}) {
    SCOPED_TRACE(route);
    const Outcome outcome = run("one", "bound=15 fault=throw rank=1 " + route, 2);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.said, AllOf(HasSubstr("on rank 1 of 2"), HasSubstr("out of tables")));
  }
}

TEST_F(OwnProgram, AnErrorOfAllRanksIsNotThatOfOneAlone) {
  const Outcome outcome = run("one", "bound=15 fault=throw solver.method=monolithic", 2);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.said, AllOf(HasSubstr("out of tables"), Not(HasSubstr("on rank"))));
}

}  // namespace
}  // namespace tourmaline::verified
