#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "program.h"

namespace {

using testing::HasSubstr;
using testing::Not;
using tourmaline::output::content_of;

const std::string good_case = R"(title = "a square in contact"

[mesh]
box = { min = [0, 0], max = [0.1, 0.1], cells = [4, 4], cell = "triangle" }

[material]
library = "BaTiO3-Liu2014"

[time]
end = 0.2
steps = 2

[[boundary]]
on = "right"
displacement = [0, 0]
potential = 0
temperature = 0

[[boundary]]
on = "top"
traction = [0, "-0.5*t"]

[contact]
on = "left"
friction = { law = "tresca", bound = 15 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
)";

std::string good_case_with(const std::string &from, const std::string &to) {
  std::string text = good_case;
  return text.replace(text.find(from), from.size(), to);
}

struct BadInput {
  std::string claim;
  std::string text;       ///< of case.toml
  std::string arguments;  ///< after the program's name, for the shell
  int status = 2;
  std::string piece;       ///< of what stands on stderr
  bool may_write = false;  ///< steps before the failure leave their results
};

void PrintTo(const BadInput &bad, std::ostream *out) {
  *out << bad.claim;
}

class CommandLine : public Program, public testing::WithParamInterface<BadInput> {};

TEST_P(CommandLine, RefusesBadInputInOneParagraph) {
  std::ofstream(here() / "case.toml", std::ios::binary) << GetParam().text;
  const auto before = files_below(here());
  EXPECT_EQ(run(GetParam().arguments), GetParam().status);
  EXPECT_THAT(complained_, testing::StartsWith("tourmaline: "));
  EXPECT_THAT(complained_, HasSubstr(GetParam().piece));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
  EXPECT_LT(complained_.size(), 1500u);
  EXPECT_EQ(said_, "");
  if (!GetParam().may_write) {
    EXPECT_EQ(files_below(here()), before);
  }
}

std::string in_camel_case(const testing::TestParamInfo<BadInput> &info) {
  std::string name;
  bool capital = true;
  for (const char c : info.param.claim) {
    const bool letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (letter)
      name += capital ? static_cast<char>(std::toupper(c)) : c;
    capital = !letter;
  }
  return name;
}

const std::string run_it = "run case.toml -o results";

BadInput override(const std::string &claim, const std::string &assignment, const std::string &piece,
                  int status = 2) {
  return {claim, good_case, run_it + " --set '" + assignment + "'", status, piece};
}

const BadInput usage[] = {
    {"no command", good_case, "", 2, "subcommand is required"},
    {"misspelt command", good_case, "rnu case.toml", 2, "did you mean \"run\"?"},
    {"no case", good_case, "run", 2, "CASE is required"},
    {"two cases", good_case, "check case.toml case.toml", 2, "not expected"},
    {"unknown option", good_case, "run case.toml --fast", 2, "--fast"},
    {"option without value", good_case, "run case.toml -o", 2, "output"},
    {"set without value", good_case, "run case.toml --set", 2, "--set"},
    {"set without equals sign", good_case, run_it + " --set time.steps", 2, "has no \"=\""},
    {"unknown material", good_case, "materials BaTiO3-Liu2015", 2, "BaTiO3-Liu2014"},
};
INSTANTIATE_TEST_SUITE_P(Usage, CommandLine, testing::ValuesIn(usage), in_camel_case);

const BadInput files[] = {
    {"missing file", good_case, "run nothing.toml -o results", 2, "there is no such file"},
    {"folder instead of a file", good_case, "run . -o results", 2, "is a folder"},
    {"empty file", "", run_it, 2, "is empty"},
    {"only a comment", "# later\n", run_it, 2, "mesh: missing"},
    {"binary file",
     std::string("\x7F"
                 "ELF\0\1\2",
                 7),
     run_it, 2, "not a text file"},
    {"endless file", good_case, "run /dev/zero -o results", 2, "larger than 16 MiB"},
    {"not UTF-8", "title = \"\xFF\xFE\"\n", run_it, 2, "case.toml:1:"},
    {"syntax error", good_case_with("[time]", "[time"), run_it, 2, "case.toml:9:6: is not TOML"},
    {"key twice", good_case_with("steps = 2", "steps = 2\nsteps = 3"), run_it, 2, "case.toml:12:"},
    {"half a file", good_case.substr(0, 150), run_it, 2, "case.toml:"},
};
INSTANTIATE_TEST_SUITE_P(Files, CommandLine, testing::ValuesIn(files), in_camel_case);

const BadInput values[] = {
    override("unknown table", "sovler.method=condensed", "did you mean \"solver\"?"),
    override("unknown key", "contact.frictoin=3", "did you mean \"friction\"?"),
    override("number that is too large", "time.end=1e400", "the number 1e400 is too large"),
    override("wrong type", "time.steps=many", "must be an integer"),
    override("negative bound", "contact.friction.bound=-15", "must be >= 0 N/m^2"),
    override("end that is no number", "time.end=nan", "is not a finite number"),
    override("infinite end", "time.end=inf", "is not a finite number"),
    override("end at the start", "time.end=0", "must be > 0 s"),
    override("end that is denormal", "time.end=3e-310", "from 1e-18 to 1e+18 s"),
    override("resistor that is denormal", "electrode=[{name=\"a\",on=\"bottom\",resistor=5e-324}]",
             "from 1e-12 to 1e+24 ohm"),
    override("constant that overflows", "material.m11=1e200", "cannot be meant"),
    override("title that colours the terminal", "title=[\"\\u001b[31m\"]", "\\u001B[31m"),
    override("name that clears the terminal", "contact.on=\"\\u009b2J\"", "\\u009B2J"),
    override("key that turns the writing", "\xE2\x80\xAExam=1", "\\u202Exam"),
    override("formula that is cut by a zero", "boundary[1].traction=[0,\"1\\u00000\"]", "control"),
    override("material that lacks a constant", "material={library=\"BaTiO3-Liu2014\",d31=-4e-11}",
             "d33, d15"),
    override("no steps", "time.steps=0", "must be >= 1"),
    override("more steps than an integer holds", "time.steps=3000000000", "at most 2147483647"),
    override("no cells", "mesh.box.cells=[4,0]", "must be >= 1"),
    override("box turned inside out", "mesh.box.max=[0.1,-1]", "must be greater"),
    override("corner in three dimensions", "mesh.box.min=[0,0,0]", "needs 2"),
    override("unknown cell shape", "mesh.box.cell=pentagon", "\"quadrilateral\""),
    override("two meshes", "mesh.file=block.msh", "both mesh.box and mesh.file"),
    override("mesh file that is no text", "mesh.file=3", "must be a text"),
    override("unknown library entry", "material.library=BaTiO3-Liu2015", "BaTiO3-Liu2014"),
    override("material without constants", "material={c11=1e11}", "material"),
    override("material that is not stable", "material.c12=1e15", "material"),
    override("unknown boundary", "contact.on=lfet", "did you mean \"left\"?"),
    override("third axis in two dimensions", "boundary[0].on=front", "\"right\""),
    override("heat law that is a key", "contact.heat.law=frictional_heating",
             "allowed: \"insulated\", \"exchange\""),
    override("normal law by another name", "contact.normal=signorini",
             "did you mean \"unilateral\"?"),
    override("normal law without its constant", "contact.normal=damped",
             "write normal = { law = \"damped\", coefficient = ... }"),
    override("law without a coefficient", "contact.friction={law=\"coulomb\"}",
             "coefficient: missing"),
    override("negative coefficient", "contact.friction={law=\"coulomb\",coefficient=-0.1}",
             "must be >= 0"),
    override("limit below the cohesion",
             "contact.friction={law=\"coulomb\",coefficient=0.1,cohesion=2,limit=1}",
             "at least the cohesion"),
    override("gap that is not finite", "contact.gap=inf", "is not a finite number"),
    override("two contacts on one side", "contact=[{on=\"left\"},{on=\"left\"}]",
             "a boundary can have one contact"),
    override("no contact in a list", "contact=[]", "is an empty list"),
    override("bound without friction", "contact.friction.law=none", "only used with"),
    override("misspelt method", "solver.method=monolitic", "did you mean \"monolithic\"?"),
    override("two potentials", "boundary[2]={on=\"right\",potential=1}", "has already a condition"),
    override("charge beside a potential", "boundary[0].surface_charge=1", "has already"),
    override("traction on a fixed side", "boundary[0].traction=[1,0]", "has already"),
    override("contact on a clamped side", "contact.on=right", "clamped"),
    override("contact on a loaded side", "contact.on=top", "traction on a contact boundary"),
    override("temperature where heat is exchanged", "boundary[1]={on=\"left\",temperature=0}",
             "heat.law"),
    override("formula that does not parse", "boundary[1].traction=[0,\"2*(t\"]", "parenthesis"),
    override("formula with an unknown name", "boundary[1].traction=[0,\"2*time\"]", "\"time\""),
    override("constant formula that is infinite", "boundary[1].traction=[0,\"1/0\"]", "finite"),
    override("coefficient that depends on time", "contact.heat.coefficient=\"t\"", "time t"),
    override("entry that does not exist", "boundary[7].on=left", "has 2 entries"),
    override("path through a value", "time.steps.x=1", "is a value"),
    override("value that is no TOML", "mesh.box.cells=[4,", "TOML"),
    override("more unknowns than can be counted", "mesh.box.cells=[200000,200000]", "unknowns"),
    override("more unknowns than fit into memory", "mesh.box.cells=[20000,20000]", "memory"),
    {"floating potential", good_case_with("potential = 0\n", ""), run_it, 2, "floats"},
    {"no mesh", good_case_with("box =", "#"), run_it, 2, "no mesh"},
    {"mesh file", good_case_with("box =", "file = \"block.msh\" #"), run_it, 2,
     "there is no such file"},
    {"nothing holds the body", good_case_with("friction = { law = \"tresca\", bound = 15 }\n", ""),
     run_it + " --set 'boundary[0].displacement=[\"free\",\"free\"]'", 2, "translation along y"},
    {"no time", good_case_with("[time]\nend = 0.2\nsteps = 2\n", ""), run_it, 2, "time: missing"},
};
INSTANTIATE_TEST_SUITE_P(Values, CommandLine, testing::ValuesIn(values), in_camel_case);

const BadInput while_running[] = {
    {"load that grows out of all sense", good_case,
     run_it + " --quiet --set 'boundary[1].traction=[0,\"-1e308*t\"]'", 2, "at most 1e+18 N/m^2",
     true},
    {"load that hides what is no number", good_case,
     run_it + " --quiet --set 'boundary[1].traction=[0,\"max(1, sqrt(0.15-t))\"]'", 2,
     "uses a value on the way", true},
    {"load that is no number at the second step", good_case,
     run_it + " --quiet --set 'boundary[1].traction=[0,\"sqrt(0.15-t)\"]'", 2, "t = 0.2 s", true},
    {"potential that is infinite at a corner", good_case,
     run_it + " --quiet --set 'boundary[0].potential=\"1/y\"'", 2, "y = 0", true},
    {"output folder below a file", good_case, "run case.toml --quiet -o case.toml/results", 4,
     "case.toml/results"},
    {"output folder that is a file", good_case, "run case.toml --quiet -o case.toml", 4,
     "case.toml"},
    {"output folder in a place without files", good_case, "run case.toml --quiet -o /proc/results",
     4, "/proc/results"},
    {"standard output that is full", good_case, "check case.toml > /dev/full", 4, "output"},
};
INSTANTIATE_TEST_SUITE_P(WhileRunning, CommandLine, testing::ValuesIn(while_running),
                         in_camel_case);

// But for what a run will take, which is measured.
std::string before_cost(const std::string &checked) {
  const std::size_t cost = checked.find("# Expected on this machine");
  EXPECT_NE(cost, std::string::npos);
  return checked.substr(0, cost);
}

TEST_F(Program, CheckPrintsACaseThatCanBeChecked) {
  std::ofstream(here() / "case.toml") << good_case;
  ASSERT_EQ(run("check case.toml --set time.steps=3"), 0) << complained_;
  EXPECT_EQ(complained_, "");
  const std::string first = said_;
  EXPECT_THAT(first, HasSubstr("steps = 3\n"));
  std::ofstream(here() / "resolved.toml") << first;
  ASSERT_EQ(run("check resolved.toml"), 0) << complained_;
  EXPECT_EQ(before_cost(said_), before_cost(first));
}

TEST_F(Program, NothingThatAUserNamesCommandsTheTerminal) {
  const auto is_harmless = [](const std::string &text) {
    return std::none_of(text.begin(), text.end(), [](unsigned char c) {
      return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F || c == 0x9B;
    });
  };
  const std::string escape = "\x1B]0;owned\x07";
  const std::string file = "c" + escape + "\xC2\x9B" + "\x9B.toml";
  std::ofstream(here() / file) << good_case_with("\"a square in contact\"", "\"\\u001b[2J\"");
  ASSERT_EQ(run("check './" + file + "'"), 0) << complained_;
  EXPECT_TRUE(is_harmless(said_)) << said_;
  std::filesystem::remove(here() / file);
  EXPECT_EQ(run("check './" + file + "'"), 2);
  EXPECT_TRUE(is_harmless(complained_)) << complained_;
  EXPECT_THAT(complained_, HasSubstr("c\\u001B]0;owned\\u0007\\u009B\\x9B.toml"));
  EXPECT_EQ(run("'--" + escape + "'"), 2);
  EXPECT_TRUE(is_harmless(complained_)) << complained_;
}

TEST_F(Program, CheckSaysWhichCouplingsAMaterialHas) {
  std::ofstream(here() / "case.toml") << good_case_with(
      "library = \"BaTiO3-Liu2014\"",
      "c11 = 1e11\nc12 = 5e10\nc13 = 5e10\nc33 = 1e11\nc44 = 2e10\nbeta11 = 1e-8\nbeta33 = 1e-8\n"
      "k11 = 1\nk33 = 1\ndensity = 5000\nspecific_heat = 400\nreference_temperature = 293");
  ASSERT_EQ(run("check case.toml"), 0) << complained_;
  EXPECT_THAT(said_,
              HasSubstr("# (the whole body), material of the case, class 6mm: not piezoelectric, "
                        "not pyroelectric, without thermal expansion\n"));
  ASSERT_EQ(run("check case.toml --set material.d33=3e-11"), 2);
  EXPECT_THAT(complained_, HasSubstr("piezoelectric constants d31, d15 (d33 is given"));
}

TEST_F(Program, CheckWarnsOfFrictionThatFallsWithSlip) {
  std::ofstream(here() / "case.toml") << good_case_with(
      "law = \"tresca\", bound = 15",
      "law = \"coulomb\", coefficient = { static = 0.4, kinetic = 0.2, distance = 1e-6 }");
  ASSERT_EQ(run("check case.toml"), 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("# warning: "));
  EXPECT_THAT(said_, HasSubstr("static = 0.4 is above kinetic = 0.2"));
  ASSERT_EQ(run("check case.toml --set contact.friction.coefficient=0.4"), 0) << complained_;
  EXPECT_THAT(said_, Not(HasSubstr("falls as the contact slips")));
}

TEST_F(Program, CheckWritesNoFiles) {
  std::ofstream(here() / "case.toml") << good_case;
  ASSERT_EQ(run("check case.toml"), 0) << complained_;
  EXPECT_EQ(files_below(here()), std::set<std::string>{"case.toml"});
}

TEST_F(Program, ResultsGoToAFolderNamedAfterTheCase) {
  std::ofstream(here() / "square.toml") << good_case;
  ASSERT_EQ(run("run square.toml --quiet"), 0) << complained_;
  EXPECT_EQ(complained_, "");
  EXPECT_TRUE(std::filesystem::exists(here() / "results" / "square" / "summary.json"));
}

TEST_F(Program, WhatIsPrintedIntoAClosedStreamIsInNoFileOfTheResults) {
  std::ofstream(here() / "square.toml") << good_case;
  const std::string small = "run square.toml -o ";
  ASSERT_EQ(run(small + "open"), 0);
  for (const std::string closed : {">&-", "<&- >&-", "<&- >&- 2>&-"}) {
    SCOPED_TRACE(closed);
    EXPECT_EQ(run(small + "closed " + closed), 4);
    for (const char *file : {"history.csv", "contact.csv", "nodes.csv"})
      EXPECT_EQ(content_of(here() / "closed" / file), content_of(here() / "open" / file));
  }
}

TEST_F(Program, AQuietRunSaysNothingInAnyRegime) {
  std::ofstream(here() / "square.toml") << good_case;
  for (const char *regime : {"static", "quasistatic", "dynamic"}) {
    ASSERT_EQ(run(std::string("run square.toml --quiet --set material.density=5000 "
                              "--set time.regime=") +
                  regime),
              0)
        << complained_;
    EXPECT_EQ(complained_, "") << regime;
  }
}

TEST_F(Program, HelpAndVersionGoToStandardOutput) {
  for (const char *arguments : {"--help", "run --help", "check --help", "--version", "materials"}) {
    EXPECT_EQ(run(arguments), 0) << arguments;
    EXPECT_NE(said_, "") << arguments;
    EXPECT_EQ(complained_, "") << arguments;
  }
}

TEST_F(Program, KernelsThatTheUserHasSetAreUsedAndNamed) {
  setenv("OPENBLAS_CORETYPE", "Nehalem", 1);
  const int status = run("--version");
  unsetenv("OPENBLAS_CORETYPE");
  ASSERT_EQ(status, 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("OpenBLAS: Nehalem"));
}

TEST_F(Program, HelpListsEveryCommand) {
  ASSERT_EQ(run("--help"), 0);
  for (const char *command :
       {"run", "sweep", "check", "report", "figures", "materials", "schema", "reference"})
    EXPECT_THAT(said_, HasSubstr("\n  " + std::string(command))) << command;
}

TEST_F(Program, FileOfMaterialsIsShownDespiteItsMistakesAndOneEntryNeedsOnlyItself) {
  std::ofstream(here() / "mine.toml")
      << "[good]\nsource=\"x\"\nsymmetry=\"isotropic\"\nyoung=1e9\npoisson=0.3\neps11=10\n"
         "k11=1\ndensity=1000\nspecific_heat=1000\nreference_temperature=293\n[bad]\nyoung=3\n";
  EXPECT_EQ(run("materials --file mine.toml"), 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("good"));
  EXPECT_THAT(said_, HasSubstr("mine.toml:11:1 [bad] source: missing"));
  EXPECT_EQ(run("materials --file mine.toml good"), 0) << complained_;
  EXPECT_EQ(run("materials --file mine.toml bad"), 2);
  EXPECT_THAT(complained_, HasSubstr("mine.toml:11:1 [bad] source: missing"));
  std::ofstream(here() / "case.toml") << good_case;
  EXPECT_EQ(run("check case.toml --set 'material={library=\"good\",file=\"mine.toml\"}'"), 0)
      << complained_;
}

}  // namespace
