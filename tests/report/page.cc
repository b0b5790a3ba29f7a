#include "report/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../output/temporary_folder.h"
#include "report/result.h"
#include "result_folder.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"

namespace tourmaline::report {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// The results that a page holds.
nlohmann::json results_in(const std::string &page) {
  const std::string begin = "id=\"results\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at))["results"];
}

const std::vector<std::string> quick{"time.steps=3"};

TEST(Page, ARunLeavesItsReportUnlessToldNotTo) {
  EXPECT_TRUE(std::filesystem::exists(ResultFolder(quick).path() / "report.html"));
  EXPECT_FALSE(std::filesystem::exists(
      ResultFolder({"time.steps=3", "output.report=false"}).path() / "report.html"));
}

TEST(Page, ItIsTheSameWhenMadeAgainFromTheFolder) {
  const ResultFolder run(quick);
  const std::string first = run.content("report.html");
  write_page({run.path()}, run.path() / "report.html");
  EXPECT_TRUE(first == run.content("report.html"));
}

TEST(Page, ItAsksForNothingFromOutside) {
  const std::string page = ResultFolder(quick).content("report.html");
  for (const char *reference : {" src=\"", "<link rel=\"stylesheet\"", "@import", "url(http"})
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
}

TEST(Page, ProbesStandThereAndThoseAlongLinesAreSaidToBeThat) {
  const auto results =
      results_in(ResultFolder({"time.steps=3",
                               "probe=[{name='tip', at=[0, 0.1]}, {name='clamp', on='right'},"
                               "{name='line', from=[0, 0], to=[0.1, 0], points=3}]"})
                     .content("report.html"));
  const auto &probes = results[0]["probes"];
  ASSERT_EQ(probes.size(), 3U);
  EXPECT_EQ(probes[0]["name"], "tip");
  EXPECT_EQ(probes[0]["isLine"], false);
  EXPECT_EQ(probes[2]["isLine"], true);
  EXPECT_EQ(probes[2]["table"]["columns"][2]["columns"], 9);  // of each place in each step
  EXPECT_EQ(probes[1]["table"]["names"][2], "force_x");
  EXPECT_EQ(probes[1]["table"]["columns"][2]["columns"], 3);  // one of each step
}

TEST(Page, EveryBoundaryStandsThereWithItsConditionsAndFacets) {
  const auto results = results_in(ResultFolder(quick).content("report.html"));
  std::map<std::string, nlohmann::json> boundaries;
  for (const auto &boundary : results[0]["boundaries"])
    boundaries[boundary["name"]] = boundary;
  ASSERT_EQ(boundaries.size(), 4U);
  EXPECT_EQ(boundaries["left"]["kind"], "contact");
  EXPECT_EQ(boundaries["left"]["sizes"]["columns"], 3);
  EXPECT_EQ(boundaries["top"]["sizes"]["columns"], 4);
  EXPECT_EQ(boundaries["right"]["kind"], "displacement");
  EXPECT_EQ(boundaries["right"]["conditions"][1], "φ = 0 V");
  EXPECT_EQ(boundaries["top"]["kind"], "traction");
  EXPECT_EQ(boundaries["bottom"]["kind"], "free");
}

TEST(Page, ThePolingStandsThereAsArrows) {
  const auto result = results_in(ResultFolder(quick).content("report.html"))[0];
  EXPECT_EQ(result["poling"]["columns"], 6 * 36);
  ASSERT_EQ(result["parts"].size(), 1U);
  EXPECT_EQ(result["parts"][0]["material"],
            "BaTiO3-Liu2014: piezoelectric, pyroelectric, with thermal expansion");
  for (const auto &field : result["fields"])
    EXPECT_NE(field["name"], "poling");  // it is the same everywhere
}

TEST(Page, ACaseWithAMeshFileIsShownWithoutThatFile) {
  const output::TemporaryFolder run, elsewhere;
  const std::filesystem::path cases =
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/devices";
  for (const char *file : {"bimorph.toml", "bimorph.geo"})
    std::filesystem::copy(cases / file, elsewhere / file);
  run::simulate(casefile::read_file(elsewhere / "bimorph.toml",
                                    {"time.steps=1", "output.report=false"}, mesh::read_mesh_file),
                run.path(), {.quiet = true});
  std::filesystem::remove(elsewhere / "bimorph.geo");
  write_page({run.path()}, run / "report.html");
  const auto result = results_in(output::content_of(run / "report.html"))[0];
  EXPECT_TRUE(result["remarks"].empty()) << result["remarks"];
  std::map<std::string, nlohmann::json> conditions;
  for (const auto &boundary : result["boundaries"])
    conditions[boundary["name"]] = boundary["conditions"];
  EXPECT_EQ(conditions["pad"][1], "Tresca friction, S = 2000 N/m²");
  EXPECT_EQ(conditions["upper face"][0], "φ = 50*t V");
  ASSERT_EQ(result["parts"].size(), 2U);
  EXPECT_EQ(result["parts"][1]["name"], "lower");
  EXPECT_EQ(result["parts"][1]["material"],
            "BaTiO3-Liu2014: piezoelectric, pyroelectric, with thermal expansion");
}

TEST(Page, TheFrictionBoundIsEvaluatedWhereAndWhenItActs) {
  ResultFolder run({"time.steps=3", "contact.friction.bound=\"10 + 100*y + t\""});
  const auto results = results_in(run.content("report.html"));
  EXPECT_EQ(results[0]["frictionBound"]["columns"], 3 * 4);
}

TEST(Page, OfSeveralContactsEachNodeHasTheBoundOfItsOwn) {
  ResultFolder run({"time.steps=2",
                    "contact=[{name=\"wall\", on=\"left\", friction={law=\"tresca\", bound=7}}, "
                    "{on=\"bottom\"}]"});
  const auto result = results_in(run.content("report.html"))[0];
  EXPECT_EQ(result["contacts"].dump(), "[\"wall\",\"bottom\"]");
  std::map<std::string, nlohmann::json> conditions;
  for (const auto &boundary : result["boundaries"])
    conditions[boundary["name"]] = boundary["conditions"];
  EXPECT_EQ(conditions["left"][0], "contact wall");
  EXPECT_EQ(conditions["left"][2], "Tresca friction, S = 7 N/m²");
  EXPECT_EQ(conditions["bottom"][2], "no friction");
  const Result read = read_result(run.path(), {});
  const std::vector<double> &contact = *read.contact->find("contact"),
                            &x = *read.contact->find("x");
  for (std::size_t i = 0; i < read.contact->n_rows(); ++i) {
    EXPECT_EQ(contact[i], x[i] == 0 ? 0 : 1);
    EXPECT_EQ(read.friction_bound[i], x[i] == 0 ? 7 : 0);
  }
  ASSERT_EQ(read.contact_pieces.size(), 2u);
  for (const ContactPiece &piece : read.contact_pieces)
    for (const auto row : piece.rows)
      EXPECT_EQ(contact[row], piece.name == "left" ? 0 : 1);
}

TEST(Page, ABoundThatTheTableHasStandsThereOnce) {
  const ResultFolder run({"time.steps=1", "contact.normal=\"unilateral\"",
                          "contact.friction={law=\"coulomb\", coefficient=0.3, cohesion=2}"});
  const auto result = results_in(run.content("report.html"))[0];
  EXPECT_FALSE(result.contains("frictionBound"));
  EXPECT_THAT(result["contact"]["names"].dump(), HasSubstr("\"friction_bound\""));
  const Result read = read_result(run.path(), {});
  EXPECT_EQ(read.friction_bound, *read.contact->find("friction_bound"));
  ASSERT_EQ(read.friction_bound.size(), 4U);
}

TEST(Page, ATitleCannotBreakThePage) {
  ResultFolder run({"time.steps=1", "title=\"</script><b>\""});
  const std::string page = run.content("report.html");
  EXPECT_THAT(page, Not(HasSubstr("</script><b>")));
  EXPECT_EQ(results_in(page)[0]["title"], "</script><b>");
}

TEST(Page, WithoutFieldFilesItSaysWhy) {
  ResultFolder run({"time.steps=3", "output.fields=false"});
  const auto result = results_in(run.content("report.html"))[0];
  EXPECT_THAT(result["remarks"][0].get<std::string>(), HasSubstr("output.fields = false"));
  EXPECT_EQ(result["history"]["columns"][0]["columns"], 3);
}

TEST(Page, TwoFoldersStandSideBySideAndThreeDoNot) {
  const ResultFolder first(quick), second({"time.steps=2"});
  const std::filesystem::path both = first.path() / "both.html";
  write_page({first.path(), second.path()}, both);
  EXPECT_EQ(results_in(first.content("both.html")).size(), 2U);
  EXPECT_THROW(write_page({first.path(), first.path(), first.path()}, both), CaseError);
}

TEST(Page, FoldersOfOneNameAreToldApartByThoseInWhichTheyStand) {
  const ResultFolder run({"time.steps=1"});
  const output::TemporaryFolder elsewhere;
  for (const char *name : {"one", "other"}) {
    std::filesystem::create_directories(elsewhere / name);
    std::filesystem::copy(run.path(), elsewhere / name / "results",
                          std::filesystem::copy_options::recursive);
  }
  const auto page = elsewhere / "both.html";
  write_page({elsewhere / "one/results", elsewhere / "other/results/"}, page);
  const auto results = results_in(output::content_of(page));
  EXPECT_EQ(results[0]["name"], "one/results");
  EXPECT_EQ(results[1]["name"], "other/results");
}

TEST(Page, AFolderThatIsNoneOfOursIsRefusedAndNothingWritten) {
  const output::TemporaryFolder folder;
  EXPECT_THAT([&] { write_page({folder.path()}, folder / "report.html"); },
              ThrowsMessage<CaseError>(HasSubstr("is no result folder")));
  EXPECT_THAT([&] { write_page({folder / "nowhere"}, folder / "report.html"); },
              ThrowsMessage<CaseError>(HasSubstr("there is no such folder")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Page, OfAFailedRunItShowsTheStepsBeforeTheFailure) {
  ResultFolder run(quick);
  std::filesystem::remove(run.path() / "summary.json");
  write_page({run.path()}, run.path() / "report.html");
  const auto result = results_in(run.content("report.html"))[0];
  EXPECT_TRUE(result["summary"].is_null());
  EXPECT_THAT(result["remarks"][0].get<std::string>(), HasSubstr("did not finish"));
}

TEST(Page, SaysWhichTablesOfACompleteRunHaveGone) {
  ResultFolder run(quick);
  std::filesystem::remove(run.path() / "history.csv");
  write_page({run.path()}, run.path() / "report.html");
  const auto result = results_in(run.content("report.html"))[0];
  ASSERT_EQ(result["remarks"].size(), 1u) << result["remarks"];
  EXPECT_THAT(result["remarks"][0].get<std::string>(),
              HasSubstr("history.csv is missing, and had"));
}

TEST(Page, SaysThatADamagedSummarySaysNothing) {
  ResultFolder run(quick);
  for (const char *damaged : {"", "garbage", "{\"files\": {"}) {
    std::ofstream(run.path() / "summary.json") << damaged;
    write_page({run.path()}, run.path() / "report.html");
    const auto result = results_in(run.content("report.html"))[0];
    EXPECT_TRUE(result["summary"].is_null());
    ASSERT_EQ(result["remarks"].size(), 1u) << result["remarks"];
    EXPECT_THAT(result["remarks"][0].get<std::string>(), HasSubstr("summary.json is damaged"));
  }
}

TEST(Page, ATextAmongTheNumbersOfATableIsRefusedWithItsLine) {
  ResultFolder run(quick);
  std::string history = run.content("history.csv");
  const std::size_t second = history.find('\n') + 1;
  history.replace(second, history.find(',', second) - second, "abc");
  std::ofstream(run.path() / "history.csv") << history;
  EXPECT_THAT([&] { write_page({run.path()}, run.path() / "other.html"); },
              ThrowsMessage<CaseError>(HasSubstr("history.csv:2: \"abc\" in column")));
}

}  // namespace
}  // namespace tourmaline::report
