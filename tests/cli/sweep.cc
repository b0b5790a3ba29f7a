// A study runs the cases that it names and puts together what they say.

#include <gmock/gmock.h>
#include <sys/mount.h>

#include <cmath>

#include "sweep.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(Sweep, ATablesRowHoldsWhatARunOfItsOwnSays) {
  ASSERT_EQ(run("sweep small.toml --vary contact.friction.bound=15,30 --vary time.steps=2,3 "
                "--columns slip,max_displacement,at_max_potential_y -o study"),
            0);
  EXPECT_EQ(complained_, "");
  EXPECT_EQ(said_, "4 cases: 0 done before, 0 failed\nstudy/sweep.csv\nstudy/sweep.svg\n");
  ASSERT_EQ(run("run small.toml --set contact.friction.bound=30 --set time.steps=2 -o alone -q"),
            0);
  const auto table = table_in(here() / "study/sweep.csv"),
             history = table_in(here() / "alone/history.csv");
  ASSERT_EQ(table.size(), 5u);
  EXPECT_EQ(table[0], (Cells{"member", "contact.friction.bound", "time.steps", "status", "slip",
                             "max_displacement", "at_max_potential_y"}));
  EXPECT_EQ(table[3][0], "bound=30_steps=2");
  EXPECT_EQ(table[3][3], "done");
  for (const char *output : {"slip", "max_displacement"})
    EXPECT_EQ(cell_under(output, table, 3), cell_under(output, history, 2));
  EXPECT_NE(cell_under("max_displacement", table, 3), cell_under("max_displacement", table, 1));
  EXPECT_EQ(content_of(here() / "study/bound=30_steps=2/nodes.csv"),
            content_of(here() / "alone/nodes.csv"));
  EXPECT_THAT(content_of(here() / "study/sweep.svg"), testing::StartsWith("<?xml"));
}

TEST_F(Sweep, ATableThatIsGivenAsAValueIsVariedAsOne) {
  ASSERT_EQ(run("sweep small.toml --set 'contact.friction={law=\"coulomb\", coefficient={static=1, "
                "kinetic=1, speed=1}}' --vary contact.normal=bilateral,unilateral "
                "--vary contact.friction.coefficient=0.1,0.3 -o study"),
            0)
      << complained_;
  const auto table = table_in(here() / "study/sweep.csv");
  ASSERT_EQ(table.size(), 5u);
  EXPECT_EQ(table[4][0], "normal=unilateral_coefficient=0.3");
  EXPECT_EQ(table[4][3], "done");
  const std::string resolved =
      content_of(here() / "study/normal=unilateral_coefficient=0.3/resolved.toml");
  EXPECT_THAT(resolved, HasSubstr("\nnormal = \"unilateral\"\n"));
  EXPECT_THAT(resolved, HasSubstr("\ncoefficient = 0.3\n"));
}

TEST_F(Sweep, TheFolderIsNamedAfterTheCase) {
  ASSERT_EQ(run("sweep small.toml --vary contact.friction.bound=15 --quiet"), 0);
  EXPECT_EQ(said_, "");
  EXPECT_TRUE(exists(here() / "results/small-sweep/bound=15/history.csv"));
  EXPECT_FALSE(exists(here() / "results/small-sweep/bound=15/error.txt"));
}

TEST_F(Sweep, WhatIsTakenOfAColumnIsWhatItsHistoryHolds) {
  ASSERT_EQ(run("sweep small.toml --vary contact.friction.bound=5,15 --columns "
                "slip,max:slip,min:friction_dissipation,mean:friction_dissipation,"
                "rms:friction_dissipation,friction_dissipation@0.5,friction_dissipation@0.625 "
                "-o study"),
            0)
      << complained_;
  const auto table = table_in(here() / "study/sweep.csv"),
             history = table_in(here() / "study/bound=5/history.csv");
  std::vector<double> loss, slip;
  for (std::size_t row = 1; row <= 4; ++row) {
    loss.push_back(std::stod(cell_under("friction_dissipation", history, row)));
    slip.push_back(std::stod(cell_under("slip", history, row)));
  }
  const auto value = [&](const char *name) { return std::stod(cell_under(name, table, 1)); };
  EXPECT_GT(loss[3], 0);
  EXPECT_EQ(value("slip"), slip[3]);
  EXPECT_EQ(value("max:slip"), *std::max_element(slip.begin(), slip.end()));
  EXPECT_EQ(value("min:friction_dissipation"), *std::min_element(loss.begin(), loss.end()));
  EXPECT_NEAR(value("mean:friction_dissipation"), (loss[0] + loss[1] + loss[2] + loss[3]) / 4,
              1e-14 * loss[3]);
  EXPECT_NEAR(
      value("rms:friction_dissipation"),
      std::sqrt((loss[0] * loss[0] + loss[1] * loss[1] + loss[2] * loss[2] + loss[3] * loss[3]) /
                4),
      1e-14 * loss[3]);
  EXPECT_EQ(value("friction_dissipation@0.5"), loss[1]);
  EXPECT_NEAR(value("friction_dissipation@0.625"), (loss[1] + loss[2]) / 2, 1e-14 * loss[3]);
}

TEST_F(Sweep, MembersThatFailDoNotStopTheOthers) {
  // One iteration is too few where the bound falls; the last one becomes negative.
  const std::string study =
      "sweep small.toml --vary \"contact.friction.bound=15,'15-10*t','15-40*t'\" --vary "
      "solver.max_iterations=1,100 -o study";
  EXPECT_EQ(run(study), 3) << "the greater of 2 and 3";
  EXPECT_THAT(said_, HasSubstr("6 cases: 0 done before, 3 failed\n"));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 3) << complained_;
  EXPECT_THAT(complained_, AllOf(HasSubstr("tourmaline: bound=15-10_t_max_iterations=1 failed: the "
                                           "contact iteration did not converge"),
                                 HasSubstr("tourmaline: bound=15-40_t_max_iterations=100 failed: "),
                                 HasSubstr("but must be >= 0 N/m^2")));
  const auto table = table_in(here() / "study/sweep.csv");
  std::vector<std::string> status;
  for (std::size_t row = 1; row < table.size(); ++row)
    status.push_back(cell_under("status", table, row));
  EXPECT_THAT(status, testing::ElementsAre("done", "done", "failed", "done", "failed", "failed"));
  EXPECT_EQ(cell_under("max_displacement", table, 3), "nan");
  EXPECT_NE(cell_under("max_displacement", table, 4), "nan");
  EXPECT_THAT(content_of(here() / "study/bound=15-10_t_max_iterations=1/error.txt"),
              HasSubstr("raise solver.max_iterations"));
  // What failed is tried again, what is done is kept.
  EXPECT_EQ(run(study), 3);
  EXPECT_THAT(said_, HasSubstr("6 cases: 3 done before, 3 failed\n"));
}

TEST_F(Sweep, AFolderThatCannotBeMadeIsTheMachinesFailure) {
  EXPECT_EQ(run("sweep small.toml --vary contact.friction.bound=5 -o small.toml/study"), 4);
  EXPECT_THAT(complained_, HasSubstr("cannot make the folder"));
}

TEST_F(Sweep, AMemberThatReachesALimitOfTheProcessSaysSo) {
#ifdef TOURMALINE_SANITIZED
  GTEST_SKIP() << "the sanitizer reserves terabytes of address space, and limits are not looked at";
#endif
  EXPECT_EQ(run("sweep small.toml --set time.steps=1000000 --set output.every=1000000 "
                "--vary contact.friction.bound=5 -q -o study",
                "ulimit -t 2;"),
            4);
  EXPECT_THAT(complained_, AllOf(HasSubstr("bound=5 failed: the limit of processor time"),
                                 HasSubstr("(ulimit -t)")));
}

TEST_F(Sweep, WhatAMemberSaidBeforeItWasDoneAfterAllIsForgotten) {
  const std::string study = "sweep small.toml --vary contact.friction.bound=15 -q -o study";
  ASSERT_EQ(run(study), 0);
  const auto words = here() / "study/bound=15/error.txt";
  std::ofstream(words) << "stopped";
  ASSERT_EQ(run(study), 0);
  EXPECT_FALSE(exists(words));
}

TEST_F(Sweep, ACaseOnADescriptorIsItsFile) {
  EXPECT_EQ(
      run("sweep /dev/fd/9 --vary contact.friction.bound=5,15 -q -o study", "exec 9< small.toml;"),
      0)
      << complained_;
  EXPECT_EQ(table_in(here() / "study/sweep.csv").size(), 3u);
}

/// With a study in a small file system of its own.
class FullSweep : public Sweep {
 protected:
  void TearDown() override { umount((here() / "disk").c_str()); }
};

TEST_F(FullSweep, ThatCannotWriteItsTableStillTellsWhatFailed) {
  std::filesystem::create_directory(here() / "disk");
  if (mount("none", (here() / "disk").c_str(), "tmpfs", 0, "size=16k") != 0)
    GTEST_SKIP() << "only root may mount a small file system";
  EXPECT_EQ(run("sweep small.toml --vary contact.friction.bound=5,15 --jobs 1 -o disk/study"), 4);
  for (const char *words :
       {"bound=5 failed: ", "bound=15 failed: ", "cannot write disk/study/sweep.csv"})
    EXPECT_THAT(complained_, HasSubstr(words));
  EXPECT_THAT(said_, HasSubstr("2 cases: 0 done before, 2 failed"));
}

}  // namespace
