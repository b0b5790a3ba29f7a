// Tables of values over time, where a formula of t may stand.

#include "case/load_table.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>

#include "../output/temporary_folder.h"
#include "case/resolved.h"
#include "case/table_file.h"
#include "case/tables_in_time.h"
#include "tourmaline/case/case.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

std::string complaint(const std::function<void()> &act) {
  try {
    act();
  } catch (const CaseError &error) {
    return error.what();
  }
  return "none";
}

std::string case_with(const std::string &traction, double end = 2) {
  return fmt::format(R"(
mesh.box = {{ min = [0, 0], max = [1, 1], cells = [1, 1] }}
material.library = "BaTiO3-Liu2014"
time = {{ end = {}, steps = 2 }}
boundary = [ {{ on = "right", displacement = [0, 0], potential = 0 }},
             {{ on = "top", traction = [0, {}] }} ]
)",
                     end, traction);
}

class FileTable : public ::testing::Test {
 protected:
  void write(const std::string &text) { std::ofstream(folder_ / "load.csv") << text; }
  Case read(const std::string &table = R"({ table = "load.csv" })") const {
    return read_text(case_with(table), (folder_ / "case.toml").string());
  }
  std::string complaint_of(const std::string &text,
                           const std::string &table = R"({ table = "load.csv" })") {
    write(text);
    return complaint([&] { read(table); });
  }
  double value(double t, const std::string &table = R"({ table = "load.csv" })") const {
    return (*read(table).boundaries.at(1).traction)[1].value({}, t);
  }

  output::TemporaryFolder folder_;
};

TEST(LoadTable, IsLinearBetweenItsPoints) {
  const LoadTable table({{0, 1}, {2, 5}, {3, -1}});
  EXPECT_EQ(table.value(0), 1);
  EXPECT_EQ(table.value(0.5), 2);
  EXPECT_EQ(table.value(2), 5);
  EXPECT_EQ(table.value(2.5), 2);
  EXPECT_EQ(table.value(3), -1);
}

TEST(LoadTable, HasTheValueOfItsEndBeyondIt) {
  const LoadTable table({{0, 1}, {2, 5}});
  EXPECT_EQ(table.value(-1e-18), 1);
  EXPECT_EQ(table.value(2 + 1e-15), 5);
}

TEST(LoadTable, WritesItselfAsTheCaseMayHaveIt) {
  EXPECT_EQ(LoadTable({{0, 0.1}, {2, -5e-7}}).text(), "{ points = [[0, 0.1], [2, -5e-07]] }");
}

TEST_F(FileTable, TakesTheSecondColumnOrTheOneOfThatName) {
  write("t, F, G\n0, 0, 10\n1, 4, 20\n# pause\n\n2, 6, 40\n");
  EXPECT_EQ(value(0.5), 2);
  EXPECT_EQ(value(1.5, R"({ table = "load.csv", column = "G" })"), 30);
}

TEST_F(FileTable, MayHaveNoNamesOtherSeparatorsAndAByteOrderMark) {
  write(
      "\xEF\xBB\xBF"
      "0;1\r\n2;+3e0\r\n");
  EXPECT_EQ(value(1), 2);
  write("0\t1\n2\t3\n");
  EXPECT_EQ(value(1), 2);
}

TEST_F(FileTable, StandsInTheResolvedCaseByItsPoints) {
  write("t,F\n0,0\n2,0.1\n");
  const std::string text = resolved(read());
  EXPECT_THAT(text, HasSubstr("traction = [0, { points = [[0, 0], [2, 0.1]] }]"));
  const Case again = read_text(text, "resolved.toml");
  EXPECT_EQ((*again.boundaries.at(1).traction)[1].value({}, 2), 0.1);
  EXPECT_EQ(resolved(again), text);
}

TEST_F(FileTable, SaysWhatIsWrongInItsFile) {
  EXPECT_THAT(complaint_of("t,F\n0,0\n1,1\n1,2\n"),
              AllOf(HasSubstr("case.toml:6:"), HasSubstr("traction[1]"),
                    HasSubstr("load.csv:4: t = 1 s follows t = 1 s; times must ascend")));
  EXPECT_THAT(complaint_of("t,F\n0,0\n2,nan\n"),
              HasSubstr("load.csv:3: column 2 is nan, which is not a finite number"));
  EXPECT_THAT(complaint_of("t,F\n0,0\n2,zwei\n"), HasSubstr("\"zwei\", which is no number"));
  EXPECT_THAT(complaint_of("t;F\n0;0\n2;0,5\n"),
              HasSubstr("\"0,5\", which is no number; decimals stand behind a point"));
  EXPECT_THAT(complaint_of("t;F\ns;N\n2;5\n"),
              HasSubstr("\"s\", which is no number; lines that begin with # are left out"));
  EXPECT_THAT(complaint_of("t;F\n0;0\n2;;\n"), HasSubstr("column 2 is empty"));
  EXPECT_THAT(complaint_of("t,F\n0,0\n2\n"),
              HasSubstr("has 1 columns, and the first line of the table has 2"));
  EXPECT_THAT(
      complaint_of("t,force,flux\n0,0,0\n2,1,1\n", R"({ table = "load.csv", column = "Force" })"),
      AllOf(HasSubstr("has no column \"Force\"; there are \"force\", \"flux\" over \"t\""),
            HasSubstr("did you mean \"force\"?")));
  EXPECT_THAT(complaint_of("0,0\n2,1\n", R"({ table = "load.csv", column = "F" })"),
              HasSubstr("no column has a name"));
  EXPECT_THAT(complaint_of("t,F\n0,\xE4\n"), HasSubstr("is not UTF-8"));
  EXPECT_THAT(complaint_of(""), HasSubstr("load.csv: is empty"));
  EXPECT_THAT(complaint_of("t,F\n"), HasSubstr("has no row of numbers"));
  EXPECT_THAT(complaint_of("0\n1\n"), HasSubstr("has one column"));
  EXPECT_THAT(complaint([&] { read(R"({ table = "loads.csv" })"); }),
              HasSubstr("loads.csv: there is no such file"));
}

TEST_F(FileTable, IsRefusedWhereItDoesNotSpanTheRun) {
  EXPECT_THAT(complaint_of("t,F\n0,0\n1.9,1\n"),
              HasSubstr("load.csv goes from t = 0 s to 1.9 s, the run from 0 to 2 s"));
  EXPECT_THAT(complaint_of("t,F\n0.1,0\n3,1\n"),
              ContainsRegex("the table in [^ ]*load.csv goes from t = 0.1 s to 3 s"));
  EXPECT_EQ(complaint_of("t,F\n-1,0\n3,1\n"), "none");
}

TEST_F(FileTable, WithAValueOutOfItsRangeIsNamed) {
  EXPECT_THAT(complaint_of("t,F\n0,0\n2,1e300\n"),
              ContainsRegex("the table in [^ ]*load.csv has 1e\\+300 at t = 2 s"));
}

TEST_F(FileTable, ThatGoesOnFarBeyondTheRunIsWarnedOf) {
  write("t,F\n0,0\n200,1\n");
  EXPECT_THAT(table_warnings(read()), ::testing::IsEmpty());
  write("t,F\n0,0\n201,1\n");
  EXPECT_THAT(
      table_warnings(read()),
      ::testing::ElementsAre(ContainsRegex(
          "traction\\[1\\]: the table in [^ ]*load.csv goes on until t = 201 s, and the run "
          "ends at 2 s")));
}

TEST(PointsOverTime, StandForTheCoefficientOfFriction) {
  const std::string friction =
      "contact={on='left', friction={law='coulomb', coefficient={points=[[0, 0.1], [2, 0.3]]}}}";
  const Case asked = read_text(case_with("0"), "case.toml", {friction});
  const auto &mu = asked.contacts.at(0).friction.coefficient;
  ASSERT_TRUE(mu.value);
  EXPECT_DOUBLE_EQ(mu.value->value({}, 1), 0.2);
  const std::string text = resolved(asked);
  EXPECT_EQ(resolved(read_text(text, "resolved.toml")), text);
  // Both ways to write it are the same case.
  EXPECT_EQ(resolved(read_text(case_with("0"), "case.toml",
                               {"contact={on='left', friction={law='coulomb', "
                                "coefficient={value={points=[[0, 0.1], [2, 0.3]]}}}}"})),
            text);
  EXPECT_THAT(complaint([&] {
                read_text(case_with("0"), "case.toml",
                          {"contact={on='left', normal={points=[[0, 0.1], [2, 0.3]]}}"});
              }),
              HasSubstr("unknown key"));
}

TEST(PointsOverTime, AreReadAsTheyStand) {
  const Case asked = read_text(case_with("{ points = [[0, 1], [2, 3]] }"), "case.toml");
  EXPECT_EQ((*asked.boundaries.at(1).traction)[1].value({}, 1), 2);
}

TEST(PointsOverTime, WithMistakesAreRefused) {
  const auto of = [](const std::string &traction) {
    return complaint([&] { read_text(case_with(traction), "case.toml"); });
  };
  EXPECT_THAT(of("{ points = [[0, 1], [2]] }"),
              HasSubstr("points[1] is [2], but must be [t, value]"));
  EXPECT_THAT(of("{ points = [] }"), HasSubstr("has no points"));
  EXPECT_THAT(of("{ points = [[0, 1], [0, 2], [2, 0]] }"), HasSubstr("times must ascend"));
  EXPECT_THAT(of("{ points = [[0, 1], [2, nan]] }"), HasSubstr("not finite"));
  EXPECT_THAT(of("{ points = [[0, 1], [2, 1e300]] }"), HasSubstr("has 1e+300 at t = 2 s"));
  EXPECT_THAT(of("{ point = [[0, 1], [2, 0]] }"), HasSubstr("did you mean \"points\"?"));
  EXPECT_THAT(of("{ points = [[0, 1], [2, 0]], table = \"a.csv\" }"), HasSubstr("gives both"));
  EXPECT_THAT(of("{ column = \"F\" }"), HasSubstr("gives none of `table` and `points`"));
}

TEST(PointsOverTime, AreRefusedWhereNothingMayDependOnTime) {
  EXPECT_THAT(complaint([] {
                read_text(case_with("0") + "initial.potential = { points = [[0, 1], [2, 3]] }\n",
                          "case.toml");
              }),
              HasSubstr("must not depend on the time t"));
}

TEST_F(FileTable, WithTwoColumnsOfOneNameIsRefused) {
  EXPECT_THAT(complaint_of("t,F,F\n0,1,2\n2,3,4\n", R"({ table = "load.csv", column = "F" })"),
              HasSubstr("several columns"));
}

// As of decimal commas: 0,5,1,5 has four.
TEST_F(FileTable, WhoseLinesHaveDifferentNumbersOfColumnsIsRefused) {
  for (const char *text : {"t,F\n0,0,0,0\n2,0,-50,0\n", "t,F,G\n0,0\n2,1\n", "0,1\n2,3,4\n"})
    EXPECT_THAT(complaint_of(text), HasSubstr("columns, and the first line of the table has"))
        << text;
}

TEST(LoadTable, BendsWhereItsSlopeChanges) {
  const Case asked = read_text(
      case_with("{ points = [[0, 0], [0.5, 1], [0.75, 1.5], [1.2, 0], [2, 0]] }"), "case.toml");
  EXPECT_THAT(bends(asked), ::testing::ElementsAre(0.75, 1.2));
  EXPECT_THAT(bends(read_text(case_with("\"t*t\""), "case.toml")), ::testing::IsEmpty());
}

}  // namespace
}  // namespace tourmaline::casefile
