// What a run leaves at its end, and what --resume makes of it.

#include "interrupted.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

class CompleteRun : public Interrupted {};

TEST_F(CompleteRun, AtItsEndItNamesExtremesContactBalancesAndPlaces) {
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

TEST_F(CompleteRun, ACompleteRunIsLeftAsItIs) {
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

TEST_F(CompleteRun, AFieldFileThatHasGoneIsNamedByResume) {
  const std::string all = "run " + paper + " --set time.steps=2 -q -o results --resume";
  ASSERT_EQ(run(all), 0);
  EXPECT_EQ(complained_, "");
  ASSERT_EQ(run(all), 0);
  EXPECT_EQ(complained_, "");
  fs::remove(here() / "results/result_0001.vtu");
  EXPECT_EQ(run(all), 0);
  EXPECT_EQ(complained_,
            "tourmaline: warning: result_0001.vtu of the complete run in results is missing; "
            "without --resume it is run again\n");
  fs::remove(here() / "results/report.html");
  EXPECT_EQ(run(all), 4);
  EXPECT_THAT(complained_, HasSubstr("result_0001.vtu of the complete run in results is missing"));
}

TEST_F(CompleteRun, AnotherPreconditionerThanAMultigridIsRefused) {
  EXPECT_EQ(run("run " + paper + " --set time.steps=2 --set solver.body=iterative -q -o results",
                "export PETSC_OPTIONS='-u_pc_type jacobi';"),
            4);
  EXPECT_THAT(complained_, HasSubstr("PETSC_OPTIONS give the displacements a preconditioner"));
}

TEST_F(CompleteRun, ADamagedSummaryIsNoProofThatARunIsComplete) {
  const std::string all = "run " + paper + " --set time.steps=2 -q -o results --resume";
  ASSERT_EQ(run(all), 0);
  for (const char *damaged : {"", "garbage"}) {
    std::ofstream(here() / "results/summary.json") << damaged;
    EXPECT_EQ(run(all), 4);
    EXPECT_THAT(complained_,
                AllOf(HasSubstr("results/summary.json is damaged"), HasSubstr("without --resume")));
    EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
  }
}

class InTheEnd : public Interrupted {
 protected:
  // Its page takes longer than the moment between the summary and a signal.
  const std::string all = "run " + paper +
                          " --set mesh.box.cells=[48,48] --set time.steps=10 --set "
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

TEST_F(CompleteRun, APageThatCannotBeWrittenIsMadeByResume) {
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

TEST_F(CompleteRun, WithoutAPageARunIsCompleteWithItsSummary) {
  const std::string all =
      "run " + paper + " --set time.steps=2 --set output.report=false -o results";
  ASSERT_EQ(run(all), 0);
  EXPECT_EQ(run(all + " --resume"), 0);
  EXPECT_THAT(complained_, HasSubstr("is complete"));
  EXPECT_FALSE(fs::exists(here() / "results/report.html"));
}

TEST_F(CompleteRun, ACompleteRunOfFilesThatHaveChangedIsRefused) {
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

}  // namespace
