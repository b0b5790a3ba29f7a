#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <thread>

#include "program.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string small_case = R"(mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [4, 4] }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 4 }
output = { fields = false, report = false }
boundary = [
  { on = "right", displacement = [0, 0], potential = 0 },
  { on = "top", traction = [0, "-50*t"] },
]
[contact]
on = "left"
friction = { law = "tresca", bound = 15 }
)";

using Cells = std::vector<std::string>;

// Of tables without commas inside of cells.
std::vector<Cells> table_in(const std::filesystem::path &file) {
  std::vector<Cells> rows;
  std::istringstream lines(content_of(file));
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
      rows.back().push_back(cell);
  }
  return rows;
}

std::string cell_under(const std::string &name, const std::vector<Cells> &table, std::size_t row) {
  const auto found = std::find(table[0].begin(), table[0].end(), name);
  return table.at(row).at(static_cast<std::size_t>(found - table[0].begin()));
}

class Sweep : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::ofstream(here() / "small.toml") << small_case;
  }

  /// When each member's run ended.
  std::map<std::string, std::filesystem::file_time_type> ends(const std::string &folder) const {
    std::map<std::string, std::filesystem::file_time_type> times;
    for (const auto &entry : std::filesystem::directory_iterator(here() / folder))
      if (exists(entry.path() / "summary.json"))
        times[entry.path().filename()] = last_write_time(entry.path() / "summary.json");
    return times;
  }
};

TEST_F(Sweep, ATablesRowHoldsWhatARunOfItsOwnSays) {
  ASSERT_EQ(run("sweep small.toml --vary contact.friction.bound=15,30 --vary time.steps=2,3 "
                "--output slip,max_displacement,at_max_potential_y -o study"),
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

TEST_F(Sweep, WhatIsDoneIsNotRunAgain) {
  const std::string study = "sweep small.toml --vary contact.friction.bound=15,30,45 -o study";
  ASSERT_EQ(run(study), 0);
  const auto first = ends("study");
  const std::string table = content_of(here() / "study/sweep.csv");
  ASSERT_EQ(first.size(), 3u);
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("3 cases: 3 done before"));
  EXPECT_EQ(ends("study"), first);
  EXPECT_EQ(content_of(here() / "study/sweep.csv"), table);

  // A run that did not finish has no summary.
  remove(here() / "study/bound=30/summary.json");
  ASSERT_EQ(run(study + " --vary time.steps=4"), 0);
  EXPECT_THAT(said_, HasSubstr("3 cases: 0 done before")) << "other folders";
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("3 cases: 2 done before"));
  const auto second = ends("study");
  EXPECT_EQ(second.at("bound=15"), first.at("bound=15"));
  EXPECT_EQ(second.at("bound=45"), first.at("bound=45"));
  EXPECT_GT(second.at("bound=30"), first.at("bound=30"));
}

TEST_F(Sweep, AChangedCaseIsRunAgain) {
  const std::string study = "sweep small.toml --vary contact.friction.bound=15,30 -o study";
  ASSERT_EQ(run(study), 0);
  const auto first = ends("study");
  ASSERT_EQ(run(study + " --set time.end=2"), 0);
  EXPECT_THAT(said_, HasSubstr("2 cases: 0 done before"));
  for (const auto &[member, end] : ends("study"))
    EXPECT_GT(end, first.at(member));
}

TEST_F(Sweep, AChangedMeshFileIsNoticed) {
  const std::string square = R"(
    Point(1) = {0, 0, 0, 0.05}; Point(2) = {0.1, 0, 0, 0.05};
    Point(3) = {0.1, 0.1, 0, 0.05}; Point(4) = {0, 0.1, 0, 0.05};
    Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
    Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
    Physical Curve("bottom") = {1}; Physical Curve("right") = {2};
    Physical Curve("top") = {3}; Physical Curve("left") = {4}; Physical Surface("all") = {1};
)";
  std::ofstream(here() / "square.geo") << square;
  std::string text = small_case;
  text.replace(0, text.find('\n'), "mesh.file = \"square.geo\"");
  std::ofstream(here() / "small.toml") << text;
  const std::string study = "sweep small.toml --vary contact.friction.bound=15,30 -o study";
  ASSERT_EQ(run(study), 0) << complained_;
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("2 cases: 2 done before"));
  std::ofstream(here() / "square.geo") << square << "// a comment changes no mesh\n";
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("2 cases: 2 done before"));
  // However old the file is: the content counts.
  std::string wider = square;
  for (auto at = wider.find("0.1,"); at != std::string::npos; at = wider.find("0.1,", at))
    wider.replace(at, 4, "0.2,");
  std::ofstream(here() / "square.geo") << wider;
  last_write_time(here() / "square.geo",
                  std::filesystem::file_time_type::clock::now() - std::chrono::hours(1000));
  ASSERT_EQ(run(study), 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("2 cases: 0 done before"));
}

TEST_F(Sweep, AChangedIncludedFileOrFileOfMaterialsIsNoticed) {
  const std::filesystem::path here_are = std::string(TOURMALINE_SOURCE_DIR) + "/tests/cli";
  copy_file(here_are / "own_material.toml", here() / "own.toml");
  copy_file(here_are / "materials.toml", here() / "materials.toml");
  const std::string study = "sweep own.toml --vary contact.friction.bound=15,30 -o study";
  ASSERT_EQ(run(study), 0) << complained_;
  std::string text = content_of(here() / "materials.toml");
  std::ofstream(here() / "materials.toml") << text.replace(text.find("1e9"), 3, "2e9");
  last_write_time(here() / "materials.toml",
                  std::filesystem::file_time_type::clock::now() - std::chrono::hours(1000));
  ASSERT_EQ(run(study), 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("2 cases: 0 done before"));
}

TEST_F(Sweep, AMemberWithoutItsPageIsNotDone) {
  const std::string study =
      "sweep small.toml --vary contact.friction.bound=15,30 --set output.report=true -o study";
  ASSERT_EQ(run(study), 0);
  const auto first = ends("study");
  remove(here() / "study/bound=15/report.html");
  ASSERT_EQ(run(study), 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("2 cases: 1 done before"));
  EXPECT_TRUE(exists(here() / "study/bound=15/report.html"));
  EXPECT_EQ(ends("study"), first) << "no step was computed again";
}

TEST_F(Sweep, WhatIsTakenOfAColumnIsWhatItsHistoryHolds) {
  ASSERT_EQ(run("sweep small.toml --vary contact.friction.bound=5,15 --output "
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
  // The bound becomes negative in the second step; before, one iteration is too few where it falls.
  const std::string study =
      "sweep small.toml --vary \"contact.friction.bound=15,'15-40*t',1e6\" --vary "
      "solver.max_iterations=1,100 -o study";
  EXPECT_EQ(run(study), 3) << "the greater of 2 and 3";
  EXPECT_THAT(said_, HasSubstr("6 cases: 0 done before, 2 failed\n"));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 2) << complained_;
  EXPECT_THAT(complained_, AllOf(HasSubstr("tourmaline: bound=15-40_t_max_iterations=1 failed: the "
                                           "contact iteration did not converge"),
                                 HasSubstr("tourmaline: bound=15-40_t_max_iterations=100 failed: "),
                                 HasSubstr("but must be >= 0 N/m^2")));
  const auto table = table_in(here() / "study/sweep.csv");
  std::vector<std::string> status;
  for (std::size_t row = 1; row < table.size(); ++row)
    status.push_back(cell_under("status", table, row));
  EXPECT_THAT(status, testing::ElementsAre("done", "done", "failed", "failed", "done", "done"));
  EXPECT_EQ(cell_under("max_displacement", table, 3), "nan");
  EXPECT_NE(cell_under("max_displacement", table, 6), "nan");
  EXPECT_THAT(content_of(here() / "study/bound=15-40_t_max_iterations=1/error.txt"),
              HasSubstr("raise solver.max_iterations"));
  // What failed is tried again, what is done is kept.
  EXPECT_EQ(run(study), 3);
  EXPECT_THAT(said_, HasSubstr("6 cases: 4 done before, 2 failed\n"));
}

TEST_F(Sweep, AMemberWhoseTableWasCutIsRunAgain) {
  const std::string study =
      "sweep small.toml --vary contact.friction.bound=5,15 --output max:slip -q -o study";
  ASSERT_EQ(run(study), 0);
  const std::string table = content_of(here() / "study/sweep.csv");
  const std::filesystem::path history = here() / "study/bound=15/history.csv";
  const std::string whole = content_of(history);
  std::ofstream(history) << whole.substr(0, whole.find('\n', whole.find('\n') + 1) + 1);
  EXPECT_EQ(run(study), 0);
  EXPECT_EQ(content_of(history), whole);
  EXPECT_EQ(content_of(here() / "study/sweep.csv"), table);
}

TEST_F(Sweep, AMemberWhoseResultsAnotherRunReplacedIsRunAgain) {
  const std::string study =
      "sweep small.toml --vary contact.friction.bound=5,15 --output max:slip,load_y -o study";
  ASSERT_EQ(run(study), 0);
  const auto first = ends("study");
  const std::string table = content_of(here() / "study/sweep.csv"),
                    nodes = content_of(here() / "study/bound=15/nodes.csv");
  ASSERT_EQ(run("run small.toml --set contact.friction.bound=15 "
                "--set 'boundary[1].traction=[0,\"-70*t\"]' -q -o study/bound=15"),
            0);
  ASSERT_NE(content_of(here() / "study/bound=15/nodes.csv"), nodes);
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("2 cases: 1 done before"));
  EXPECT_EQ(content_of(here() / "study/bound=15/nodes.csv"), nodes);
  EXPECT_EQ(content_of(here() / "study/sweep.csv"), table);
  EXPECT_EQ(ends("study").at("bound=5"), first.at("bound=5"));
}

struct BadStudy {
  const char *claim, *arguments, *piece;
};

void PrintTo(const BadStudy &bad, std::ostream *out) {
  *out << bad.claim;
}

class BadSweep : public Sweep, public testing::WithParamInterface<BadStudy> {};

TEST_P(BadSweep, IsRefusedInOneParagraphBeforeAnythingRuns) {
  EXPECT_EQ(run(std::string("sweep small.toml -o study ") + GetParam().arguments), 2);
  EXPECT_THAT(complained_, AllOf(testing::StartsWith("tourmaline: "), HasSubstr(GetParam().piece)));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
  EXPECT_EQ(said_, "");
  EXPECT_EQ(files_below(here()), std::set<std::string>{"small.toml"});
}

const BadStudy bad_studies[] = {
    {"NothingVaried", "", "--vary is required"},
    {"NoValues", "--vary contact.friction.bound", "has no \"=\""},
    {"WrongSpacing", "--vary contact.friction.bound=lgo:1:2:3", "did you mean \"log\"?"},
    {"LastValueOutOfRange", "--vary contact.friction.bound=5,15,-45",
     "bound = -45: must be >= 0 N/m^2 (in the case bound=-45 of the study; nothing has been run)"},
    {"UnknownKey", "--vary contact.friction.buond=5", "did you mean \"bound\"?"},
    {"FractionForAnInteger", "--vary time.steps=lin:1:2:3", "must be an integer"},
    {"CombinationThatIsWrong",
     "--vary mesh.box.cell=triangle,hexahedron --vary contact.friction.bound=1,2",
     "(in the case cell=hexahedron_bound=1 of the study"},
    {"UnknownMaterial", "--vary material.library=BaTiO3-Liu2014,BaTiO3-Liu2015", "BaTiO3-Liu2015"},
    {"UnknownOutput", "--vary contact.friction.bound=5 --output slop", "did you mean \"slip\"?"},
    {"UnknownOutputIsAnsweredWithTheList", "--vary contact.friction.bound=5 --output max:slop",
     "did you mean \"max:slip\"?; allowed: step, time, newton_iterations, "},
    {"UnknownReduction", "--vary contact.friction.bound=5 --output maks:slip",
     "did you mean \"max\"?"},
    {"TimeBehindTheEnd", "--vary contact.friction.bound=5 --output slip@2",
     "above 0 and at most 1, the end of the runs"},
    {"OneNumberInTwoForms", "--vary contact.friction.bound=15,1.5e1",
     "gives 15 twice, the second time as 1.5e1"},
    {"WrongSet", "--vary contact.friction.bound=5 --set time.steps=0", "steps = 0: must be >= 1"},
    {"NoJobs", "--vary contact.friction.bound=5 --jobs 0", "--jobs"},
};
INSTANTIATE_TEST_SUITE_P(Studies, BadSweep, testing::ValuesIn(bad_studies),
                         [](const auto &bad) { return std::string(bad.param.claim); });

TEST_F(Sweep, AFolderThatCannotBeMadeIsTheMachinesFailure) {
  EXPECT_EQ(run("sweep small.toml --vary contact.friction.bound=5 -o small.toml/study"), 4);
  EXPECT_THAT(complained_, HasSubstr("cannot make the folder"));
}

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
      "sweep small.toml --vary contact.friction.bound=5 --set time.steps=3000 "
      "--set output.fields=true --set output.every=1500 --set 'output.checkpoint=\"5 steps\"' -o "
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
