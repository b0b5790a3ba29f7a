#include "output/result_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <stdexcept>

#include "output/csv.h"
#include "small_body.h"
#include "temporary_folder.h"
#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;
using Names = std::set<std::string>;

const ContactRow contact_row{};
const std::span<const ContactRow> one_row(&contact_row, 1);

HistoryRow history_row(int step) {
  return {step, 0.1 * step, 1, 0, 1, 0, 0, {{"energy", 2}}};
}

Checkpoint behind(int step) {
  Checkpoint checkpoint;
  checkpoint.step = step;
  return checkpoint;
}

class Results : public testing::Test {
 protected:
  void run_two_steps(ResultFolder &results) {
    results.put_case("title = \"a\"\n");
    for (int step = 1; step <= 2; ++step) {
      results.put_fields(step, 0.1 * step, grid, points, cells);
      results.list_fields(step, 0.1 * step);
      results.put_contact(step, 0.1 * step, one_row);
      results.put_contact_fields(step, 0.1 * step, {}, one_row);
      results.put_history(history_row(step));
    }
    results.put_nodes(grid.points, points);
    results.put_summary({});
  }

  TemporaryFolder folder;
  std::filesystem::path directory = folder / "a/b";
  Grid grid = square(2);
  PointFields points = point_fields(grid.points.size());
  CellFields cells = cell_fields(grid.n_cells());
};

TEST_F(Results, ARunLeavesTheFilesOfTheContract) {
  {
    ResultFolder results(directory, 2);
    run_two_steps(results);
    results.finish();
  }
  EXPECT_EQ(names_in(directory),
            (Names{"resolved.toml", "result_0001.vtu", "result_0002.vtu", "result.pvd",
                   "contact_0001.vtu", "contact_0002.vtu", "contact.pvd", "nodes.csv",
                   "contact.csv", "history.csv", "summary.json"}));
  EXPECT_EQ(content_of(directory / "resolved.toml"), "title = \"a\"\n");
}

// Lines are written some ten thousand at a time.
TEST_F(Results, TheTableOfManyNodesHasEachOnce) {
  for (const std::size_t n : {9999, 10000, 10001, 20001}) {
    const std::vector<Vector3> places(n, Vector3{0.5, 0.25, 0});
    const PointFields fields = point_fields(n);
    ResultFolder results(directory, 2);
    results.put_nodes(places, fields);
    EXPECT_EQ(content_of(directory / "nodes.csv"),
              nodes_header(2) + nodes_lines(2, places, fields, 0, n))
        << n;
  }
}

TEST_F(Results, WithoutAContactBoundaryThereIsNoContactTable) {
  {
    ResultFolder results(directory, 2);
    results.put_history(history_row(1));
    results.finish();
  }
  EXPECT_EQ(names_in(directory), Names{"history.csv"});
}

TEST_F(Results, TheCollectionIsValidAfterEveryFieldFile) {
  ResultFolder results(directory, 2);
  for (int step : {1, 2}) {
    results.put_fields(step, 0.1 * step, grid, points, cells);
    results.list_fields(step, 0.1 * step);
    const std::string pvd = content_of(directory / "result.pvd");
    EXPECT_THAT(pvd, HasSubstr(step == 1 ? "result_0001.vtu" : "result_0002.vtu"));
    EXPECT_TRUE(pvd.ends_with("</VTKFile>\n"));
  }
  EXPECT_THAT(content_of(directory / "result.pvd"), HasSubstr("result_0001.vtu"));
}

TEST_F(Results, AFailedSolveKeepsTheStepsThatWereComputed) {
  ResultFolder results(directory, 2);
  results.put_history(history_row(1));
  results.put_history(history_row(2));
  EXPECT_EQ(names_in(directory), (Names{"history.csv.part", "run.lock"}));
  results.finish();
  results.finish();
  EXPECT_EQ(content_of(directory / "history.csv"),
            "step,time,newton_iterations,residual,stick,slip,open,energy\n"
            "1,0.10000000000000001,1,0,1,0,0,2\n"
            "2,0.20000000000000001,1,0,1,0,0,2\n");
}

TEST_F(Results, TheSameRunLeavesTheSameBytes) {
  const Names names{"result_0001.vtu", "result.pvd",       "nodes.csv",  "contact.csv",
                    "history.csv",     "contact_0001.vtu", "contact.pvd"};
  for (const char *name : {"first", "second"}) {
    ResultFolder results(folder / name, 2);
    run_two_steps(results);
    results.finish();
  }
  for (const std::string &name : names)
    EXPECT_EQ(content_of(folder / "first" / name), content_of(folder / "second" / name)) << name;
}

TEST_F(Results, AnEarlierRunsFilesAreRemovedAndNoOthers) {
  const Names ours{
      "result_0001.vtu", "result_12345.vtu",   "result.pvd",           "nodes.csv",
      "contact.csv",     "history.csv",        "summary.json",         "resolved.toml",
      "report.html",     "history.csv.part",   "result_0007.vtu.part", "checkpoint.bin",
      "contact.pvd",     "contact_0001.vtu",   "contact_12345.vtu",    "contact.pvd.part",
      "probe-tip.csv",   "probe-a.b.csv.part", "unfinished.txt"};
  const Names others{"result_mine.vtu",    "result_01.vtu",    "notes.csv", "old_nodes.csv",
                     "thesis.tex.part",    "result.pvd.bak",   "Nodes.csv", "contact_1.vtu",
                     "contact_0001_0.vtu", "contact_mine.vtu", "probe.csv", "probe-tip.txt"};
  std::filesystem::create_directories(directory / "history.csv.d");
  for (const Names &names : {ours, others})
    for (const std::string &name : names)
      std::ofstream(directory / name) << "x";
  const ResultFolder results(directory, 2);
  Names left = others;
  left.insert("run.lock");
  left.insert("history.csv.d");
  EXPECT_EQ(names_in(directory), left);
}

TEST_F(Results, BehindACheckpointTheFilesAreThoseOfItsMoment) {
  Checkpoint checkpoint;
  checkpoint.step = 2;
  {
    ResultFolder results(directory, 2);
    run_two_steps(results);
    results.put_checkpoint(checkpoint);
    for (const char *name : {"result_0003.vtu", "result_0004.vtu.part", "report.html"})
      std::ofstream(directory / name) << "later";
    results.put_contact_fields(3, 0.3, {}, one_row);
    results.put_contact(3, 0.3, one_row);
    results.put_history(history_row(3));
    results.finish();  // as after an ordered end
  }
  ResultFolder results(directory, 2, {}, read_checkpoint(directory / "checkpoint.bin"));
  EXPECT_EQ(names_in(directory),
            (Names{"resolved.toml", "result_0001.vtu", "result_0002.vtu", "result.pvd",
                   "contact_0001.vtu", "contact_0002.vtu", "contact.pvd", "contact.csv.part",
                   "history.csv.part", "checkpoint.bin", "run.lock"}));
  for (const char *series : {"result.pvd", "contact.pvd"})
    EXPECT_THAT(content_of(directory / series),
                AllOf(HasSubstr("_0001.vtu"), HasSubstr("_0002.vtu"), Not(HasSubstr("_0003"))))
        << series;
  results.put_contact_fields(3, 0.3, {}, one_row);
  EXPECT_THAT(content_of(directory / "contact.pvd"),
              AllOf(HasSubstr("contact_0002.vtu"), HasSubstr("contact_0003.vtu")));
  results.put_history(history_row(3));
  results.finish();
  EXPECT_EQ(content_of(directory / "history.csv"),
            "step,time,newton_iterations,residual,stick,slip,open,energy\n"
            "1,0.10000000000000001,1,0,1,0,0,2\n"
            "2,0.20000000000000001,1,0,1,0,0,2\n"
            "3,0.30000000000000004,1,0,1,0,0,2\n");
}

TEST_F(Results, BehindACheckpointBeforeTheFirstFilesOfTheContactThereIsNoSeriesOfThem) {
  {
    ResultFolder results(directory, 2);
    results.put_history(history_row(1));
    results.put_checkpoint({});
    results.put_contact_fields(2, 0.2, {}, one_row);
  }
  const ResultFolder results(directory, 2, {}, read_checkpoint(directory / "checkpoint.bin"));
  EXPECT_EQ(names_in(directory), (Names{"history.csv.part", "checkpoint.bin", "run.lock"}));
}

TEST_F(Results, AFileOfTheContactOnWhichACheckpointCountsIsMissed) {
  {
    ResultFolder results(directory, 2);
    run_two_steps(results);
    Checkpoint checkpoint;
    checkpoint.step = 2;
    results.put_checkpoint(checkpoint);
    results.finish();
  }
  const FolderPosition position = read_checkpoint(directory / "checkpoint.bin").position;
  std::ofstream(directory / "contact_0002.vtu", std::ios::app) << "x";
  EXPECT_THROW(require_position(directory, position), MachineError);
  std::filesystem::remove(directory / "contact_0002.vtu");
  EXPECT_THAT([&] { require_position(directory, position); },
              ThrowsMessage<MachineError>(HasSubstr("contact_0002.vtu")));
}

TEST_F(Results, BehindACheckpointProbesGoOnAsWell) {
  const auto rows = [](const char *name, double value) {
    return ProbeRows{name, {"u_x"}, {{value}, {value + 1}}};
  };
  Checkpoint checkpoint;
  {
    ResultFolder results(directory, 2);
    results.put_probe(1, 0.1, rows("tip", 3));
    results.put_checkpoint(behind(1));
    results.put_probe(2, 0.2, rows("tip", 7));
    results.put_probe(2, 0.2, rows("later", 7));
    checkpoint = read_checkpoint(directory / "checkpoint.bin");
  }
  {
    ResultFolder results(directory, 2, {}, checkpoint);
    results.put_probe(2, 0.2, rows("tip", 5));
    results.finish();
  }
  EXPECT_EQ(content_of(directory / "probe-tip.csv"),
            "step,time,u_x\n1,0.10000000000000001,3\n1,0.10000000000000001,4\n"
            "2,0.20000000000000001,5\n2,0.20000000000000001,6\n");
  EXPECT_EQ(file_sizes(directory).at("probe-tip.csv"),
            std::filesystem::file_size(directory / "probe-tip.csv"));
  std::ofstream(directory / "probe-tip.csv") << "step,time,u_x\n1,0.1,3\n";
  EXPECT_THAT([&] { require_position(directory, checkpoint.position); },
              ThrowsMessage<MachineError>(HasSubstr("probe-tip.csv")));
}

TEST_F(Results, TheSummaryHasTheBytesOfBothSeriesApart) {
  {
    ResultFolder results(directory, 2);
    run_two_steps(results);
    results.finish();
  }
  const auto sizes = file_sizes(directory);
  for (const std::string series : {"result", "contact"})
    EXPECT_EQ(sizes.at(series + "_*"),
              std::filesystem::file_size(directory / (series + "_0001.vtu")) +
                  std::filesystem::file_size(directory / (series + "_0002.vtu")));
}

TEST_F(Results, ATableThatIsNotWhatWasWrittenUpToTheCheckpointIsRefused) {
  {
    ResultFolder results(directory, 2);
    run_two_steps(results);
    results.put_checkpoint(behind(2));
    results.put_history(history_row(3));
  }
  const Checkpoint checkpoint = read_checkpoint(directory / "checkpoint.bin");
  const auto position = checkpoint.position;
  const auto going_on = [&] { require_position(directory, position); };
  for (const char *name : {"contact.csv", "history.csv"}) {
    const std::filesystem::path growing = directory / (name + std::string(".part"));
    const std::string written = content_of(growing);
    const std::uint64_t counted = position.tables.at(name).bytes;
    for (const std::size_t place : {std::size_t{0}, std::size_t{counted} - 2}) {
      std::string edited = written;
      edited[place] = edited[place] == '1' ? '2' : '1';  // of the same length
      std::ofstream(growing, std::ios::binary) << edited;
      EXPECT_THAT(going_on,
                  ThrowsMessage<MachineError>(AllOf(
                      HasSubstr(fmt::format("the first {} bytes of {}", counted, growing.string())),
                      HasSubstr("edited or damaged"), HasSubstr("without --resume"))));
      EXPECT_THROW(ResultFolder(directory, 2, {}, checkpoint), MachineError);
    }
    // What follows is cut off in any case.
    std::ofstream(growing, std::ios::binary) << written.substr(0, counted) << "3,";
    EXPECT_NO_THROW(going_on());
    // An ordered end has moved it into place.
    std::filesystem::rename(growing, directory / name);
    EXPECT_NO_THROW(going_on());
  }
}

TEST_F(Results, GoingOnTwiceTheTablesAreStillThoseOfTheCheckpoint) {
  {
    ResultFolder results(directory, 2);
    run_two_steps(results);
    results.put_checkpoint(behind(2));
  }
  {
    ResultFolder results(directory, 2, {}, read_checkpoint(directory / "checkpoint.bin"));
    results.put_contact(3, 0.3, one_row);
    results.put_history(history_row(3));
    results.put_checkpoint(behind(3));
  }
  EXPECT_NO_THROW(
      ResultFolder(directory, 2, {}, read_checkpoint(directory / "checkpoint.bin")).finish());
}

TEST_F(Results, ATableThatACheckpointCountsOnOutlivesAnError) {
  {
    ResultFolder results(directory, 2);
    results.put_history(history_row(1));
    results.put_checkpoint({});
  }
  EXPECT_EQ(names_in(directory), (Names{"history.csv.part", "checkpoint.bin"}));
}

TEST_F(Results, AFolderThatCannotBeMadeIsNamedWithTheReason) {
  std::ofstream(folder / "a") << "a file";
  EXPECT_THAT([&] { ResultFolder(directory, 2); },
              ThrowsMessage<MachineError>(
                  AllOf(HasSubstr(directory.string()), HasSubstr("Not a directory"))));
}

TEST_F(Results, AFolderThatCannotBeWrittenToKeepsItsFiles) {
  if (::geteuid() == 0)
    GTEST_SKIP() << "root may write everywhere";
  std::filesystem::create_directories(directory);
  std::ofstream(directory / "nodes.csv") << "old";
  std::filesystem::permissions(
      directory, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THAT([&] { ResultFolder(directory, 2); },
              ThrowsMessage<MachineError>(HasSubstr("Permission denied")));
  EXPECT_EQ(names_in(directory), Names{"nodes.csv"});
  std::filesystem::permissions(directory, std::filesystem::perms::owner_all);
}

TEST_F(Results, AFileSystemThatTakesNoFilesIsReportedAtTheStart) {
  if (!std::filesystem::is_directory("/proc/self"))
    GTEST_SKIP() << "no /proc here";
  EXPECT_THROW(ResultFolder("/proc/self", 2), MachineError);
}

TEST_F(Results, EveryRowOfTheHistoryHasTheColumnsOfTheFirst) {
  ResultFolder results(directory, 2);
  results.put_history(history_row(1));
  HistoryRow other = history_row(2);
  other.quantities.front().first = "work";
  EXPECT_THROW(results.put_history(other), std::invalid_argument);
}

TEST_F(Results, FieldsOfAnotherGridAreRefused) {
  ResultFolder results(directory, 2);
  results.put_fields(1, 0.1, grid, points, cells);
  const Grid finer = square(3);
  EXPECT_THROW(results.put_fields(2, 0.2, finer, point_fields(finer.points.size()),
                                  cell_fields(finer.n_cells())),
               std::invalid_argument);
}

}  // namespace
}  // namespace tourmaline::output
