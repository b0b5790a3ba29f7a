#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "error_in.h"
#include "example.h"
#include "mistake.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_P(MistakeInAFile, IsNamedWithItsPlaceAndWhatIsAllowed) {
  const std::string error = error_in(changed(GetParam().from, GetParam().to));
  for (const std::string &piece : GetParam().pieces)
    EXPECT_THAT(error, HasSubstr(piece));
  EXPECT_THAT(error, testing::StartsWith("case.toml"));
  EXPECT_THAT(error, Not(HasSubstr("\n")));
}

const Mistake syntax[] = {
    {"[time]", "[time", {"case.toml:10:6: is not TOML"}},
    {"end = 0.2", "end = ", {"case.toml:11:", "is not TOML"}},
    {"steps = 20", "steps = 20\nsteps = 30", {"case.toml:13:", "cannot redefine"}},
    {"Thermally", "Therm\xFF\xFE", {"case.toml:1:", "is not UTF-8"}},
    {"steps = 20", "steps = 99999999999999999999", {"case.toml:12:", "64 bits"}},
    {"on = \"left\"", "on = \"left", {"case.toml:29:", "a closing quote is missing"}},
};
INSTANTIATE_TEST_SUITE_P(Syntax, MistakeInAFile, testing::ValuesIn(syntax));

const Mistake names[] = {
    {"pyroelectric = [0, 1e-4]",
     "theta_ref = 293",
     {"[material] theta_ref = 293", "did you mean \"reference_temperature\"?"}},
    {"pyroelectric = [0, 1e-4]", "rho = 5e3", {"did you mean \"density\"?"}},
    {"coefficient = 1", "k_c = 1", {"[contact.heat] k_c = 1", "did you mean \"coefficient\"?"}},
    {"[solver]", "[sovler]", {"case.toml:34:2 sovler", "unknown key", "did you mean \"solver\"?"}},
    {"friction = ",
     "frictoin = ",
     {"case.toml:31:1 [contact] frictoin",
      "allowed: name, on, gap, foundation_displacement, normal, friction, heat",
      "did you mean \"friction\"?"}},
    {"bound = 15",
     "bonud = 15",
     {"case.toml:31:", "[contact.friction] bonud = 15", "did you mean \"bound\"?"}},
    {"potential = 0", "potental = 0", {"[boundary[0]] potental", "did you mean \"potential\"?"}},
    {"normal = \"bilateral\"",
     "bound = 15",
     {"[contact] bound = 15", "one of that name in [contact.friction]"}},
    {"pyroelectric", "pyroelectrik", {"did you mean \"pyroelectric\"?"}},
    {"library = \"BaTiO3-Liu2014\"", "c66 = 43e9", {"[material] c66", "(c11 - c12)/2"}},
    {"normal = \"bilateral\"", "charge = 1", {"[contact] charge", "said by the table `electric`"}},
};
INSTANTIATE_TEST_SUITE_P(Names, MistakeInAFile, testing::ValuesIn(names));

const Mistake types[] = {
    {"\"Thermally conductive foundation\"",
     "3",
     {"title = 3", "is an integer, but must be a text"}},
    {"steps = 20", "steps = 20.0", {"[time] steps = 20", "is a number, but must be an integer"}},
    {"steps = 20", "steps = \"20\"", {"is a text, but must be an integer"}},
    {"end = 0.2", "end = true", {"[time] end = true", "is true or false, but must be a number"}},
    {"end = 0.2", "end = 2020-01-01", {"2020-01-01", "is a date or time, but must be a number"}},
    {"fields = true", "fields = 1", {"[output] fields = 1", "must be true or false"}},
    {"cells = [64, 64]", "cells = 64", {"[mesh.box] cells = 64", "must be a list of integers"}},
    {"cells = [64, 64]", "cells = [64, \"a\"]", {"case.toml:4:", "cells[1] = \"a\"", "an integer"}},
    {"box = {", "box = 3 # {", {"[mesh] box = 3", "must be a table: [mesh.box]"}},
    {"displacement = [0, 0]",
     "displacement = 0",
     {"[boundary[0]] displacement = 0", "a list of numbers, formulas or \"free\""}},
    {"potential = 0", "potential = [0]", {"is a list, but must be a number or a formula"}},
    {"on = \"right\"", "on = 1", {"[boundary[0]] on = 1", "a text or a list of texts"}},
    {"library = \"BaTiO3-Liu2014\"", "library = 1", {"[material] library = 1", "must be a text"}},
    {"library = \"BaTiO3-Liu2014\"",
     "permittivity = [1, 2, 3]",
     {"permittivity[0] = 1", "must be a list of numbers"}},
    {"box =", "file = 3 #", {"[mesh] file = 3", "must be a text"}},
};
INSTANTIATE_TEST_SUITE_P(Types, MistakeInAFile, testing::ValuesIn(types));

const Mistake numbers[] = {
    {"bound = 15",
     "bound = -15",
     {"case.toml:31:38 [contact.friction] bound = -15", "must be >= 0 N/m^2"}},
    {"bound = 15", "bound = \"-3*5\"", {"bound = \"-3*5\"", "must be >= 0 N/m^2"}},
    {"coefficient = 1,", "coefficient = -1,", {"must be >= 0 W/(K m^2)"}},
    {"coefficient = 1,", "coefficient = \"1 + t\",", {"must not depend on the time t"}},
    {"end = 0.2", "end = 0", {"[time] end = 0", "must be > 0 s"}},
    {"end = 0.2", "end = -1.5", {"end = -1.5", "must be > 0 s"}},
    {"end = 0.2", "end = nan", {"end = nan", "is not a finite number"}},
    {"end = 0.2", "end = inf", {"end = inf", "is not a finite number"}},
    {"potential = 0", "potential = nan", {"potential = nan", "is not a finite number"}},
    {"potential = 0", "potential = -inf", {"potential = -inf", "is not a finite number"}},
    {"[0, 1e-4]", "[0, nan]", {"pyroelectric[1] = nan", "is not a finite number"}},
    {"steps = 20", "steps = 0", {"steps = 0", "must be >= 1"}},
    {"steps = 20", "steps = -20", {"steps = -20", "must be >= 1"}},
    {"steps = 20", "steps = 3000000000", {"must be at most 2147483647"}},
    {"cells = [64, 64]", "cells = [64, 0]", {"cells[1] = 0", "must be >= 1"}},
    {"cells = [64, 64]", "cells = [200000, 200000]", {"[mesh.box] cells", "unknowns"}},
    {"max = [0.1, 0.1]", "max = [0.1, 0]", {"[mesh.box] max", "entry 1 must be greater"}},
    {"max = [0.1, 0.1]", "max = [0.1, 1e-200]", {"entry 1", "a side shorter than 1e-12 m"}},
    {"max = [0.1, 0.1]",
     "max = [0.1, 1e-400]",
     {"case.toml:", "the number 1e-400 is closer to 0 than double precision holds"}},
    {"min = [0, 0], max = [0.1, 0.1]",
     "min = [1e8, 0], max = [1.00000000001e8, 0.1]",
     {"double precision"}},
    {"end = 0.2",
     "end = 3e-310",
     {"[time] end = 3e-310", "cannot be meant", "from 1e-18 to 1e+18 s"}},
    {"end = 0.2", "end = 1e400", {"case.toml:11:", "1e400"}},
    {"potential = 0", "potential = 1e-310", {"closer to 0 than double precision holds; write 0"}},
    {"potential = 0", "potential = 1e200", {"cannot be meant", "at most 1e+15 V in size"}},
    {"bound = 15", "bound = \"1e100*10\"", {"bound = \"1e100*10\"", "at most 1e+18 N/m^2"}},
    {"pyroelectric = [0, 1e-4]", "m11 = 1e60", {"[material] m11", "at most 1e+15 N/(K m^2)"}},
    {"pyroelectric = [0, 1e-4]", "e31 = 1e200", {"e31 = 1e+200", "at most 1e+09 C/m^2 in size"}},
    {"pyroelectric = [0, 1e-4]", "density = 1e-200", {"from 1e-12 to 1e+12 kg/m^3"}},
    {"pyroelectric = [0, 1e-4]",
     "conductivity = [[1e99, 0, 0], [0, 1, 0], [0, 0, 1]]",
     {"conductivity[0][0] = 1e+99", "W/(K m)"}},
    {"min = [0, 0]", "min = [-1e300, 0]", {"min[0] = -1e+300", "at most 1e+09 m in size"}},
    {"[contact]",
     "[[electrode]]\nname = \"a\"\non = \"top\"\nresistor = 5e-324\n[contact]",
     {"resistor = 5e-324", "from 1e-12 to 1e+24 ohm"}},
    {"every = 1", "every = 0", {"[output] every = 0", "must be >= 1"}},
    {"method = \"condensed\"", "tolerance = 0", {"[solver] tolerance = 0", "must be > 0 and < 1"}},
    {"method = \"condensed\"", "threads = 0", {"[solver] threads = 0", "must be >= 1 and <= 1024"}},
    {"box =", "degree = 3\nbox =", {"[mesh] degree = 3", "must be >= 1 and <= 2"}},
    {"pyroelectric = [0, 1e-4]", "c11 = -1", {"[material] c11 = -1", "must be > 0 Pa"}},
    {"pyroelectric = [0, 1e-4]", "density = 0", {"density = 0", "must be > 0 kg/m^3"}},
    {"pyroelectric = [0, 1e-4]", "poling = [0, 0]", {"poling = [0, 0]", "is no direction"}},
    {"pyroelectric = [0, 1e-4]", "axis1 = [0, 2]", {"axis1 = [0, 2]", "parallel to the poling"}},
    {"pyroelectric = [0, 1e-4]",
     "pyroelectric = [0, 1e-4]\np3 = 1e-4",
     {"[material] p3 = 0.0001", "given twice, here and in `pyroelectric`"}},
};
INSTANTIATE_TEST_SUITE_P(Numbers, MistakeInAFile, testing::ValuesIn(numbers));

const Mistake lengths[] = {
    {"min = [0, 0]",
     "min = [0, 0, 0]",
     {"[mesh.box] min = [0, 0, 0]", "has 3 entries, but needs 2", "2-dimensional"}},
    {"cell = \"triangle\"", "cell = \"tetrahedron\"", {"has 2 entries, but needs 3"}},
    {"displacement = [0, 0]", "displacement = [0]", {"has 1 entry, but needs 2"}},
    {"traction = [0, \"-0.5*t\"]", "traction = [0, 0, \"-0.5*t\"]", {"has 3 entries, but needs 2"}},
    {"[0, 1e-4]", "[1e-4]", {"has 1 entry, but needs 2 or 3", "[p1, p3]"}},
    {"pyroelectric = [0, 1e-4]", "stiffness = [[1, 2], [3, 4]]", {"has 2 rows, but needs 6"}},
    {"pyroelectric = [0, 1e-4]",
     "conductivity = [[1, 2, 3], [3, 4], [5, 6, 7]]",
     {"conductivity[1] = [3, 4]", "has 2 entries, but needs 3"}},
};
INSTANTIATE_TEST_SUITE_P(Lengths, MistakeInAFile, testing::ValuesIn(lengths));

const Mistake missing[] = {
    {"end = 0.2\n", "", {"case.toml:10:1 [time] end", "missing", "[s]"}},
    {"steps = 20\n", "", {"[time] steps", "missing"}},
    {"[time]\nend = 0.2\nsteps = 20\n", "", {"time: missing"}},
    {"on = \"right\"\n", "", {"case.toml:14:1 [boundary[0]] on: missing"}},
    {", bound = 15", "", {"[contact.friction] bound: missing", "[N/m^2]"}},
    {", coefficient = 1", "", {"[contact.heat] coefficient: missing"}},
    {", foundation_temperature = -27", "", {"[contact.heat] foundation_temperature: missing"}},
    {"cells = [64, 64], ", "", {"[mesh.box] cells: missing"}},
    {"end = 0.2\nsteps = 20\n",
     "",
     {"[time] end, steps: missing", "end, time at which", "[s]; steps, number of"}},
    {"min = [0, 0], max = [0.1, 0.1], ", "", {"[mesh.box] min, max: missing"}},
    {"box =", "#", {"case.toml:3:1 [mesh]: no mesh"}},
    {"box =", "file = \"a.msh\"\nbox =", {"both mesh.box and mesh.file"}},
    {"box =", "file = \"a.msh\" #", {"[mesh] file = \"a.msh\"", "give mesh.box"}},
};
INSTANTIATE_TEST_SUITE_P(Missing, MistakeInAFile, testing::ValuesIn(missing));

// What follows its first sentence is for the reference.
TEST(MissingTable, IsToldInOneSentence) {
  EXPECT_THAT(
      error_in(changed("[material]\nlibrary = \"BaTiO3-Liu2014\"\npyroelectric = [0, 1e-4]\n", "")),
      testing::EndsWith("material: missing, but must be given: What the whole body is made of: "
                        "library = an entry of the library, constants, or both"));
}

const Mistake choices[] = {
    {"\"tresca\"",
     "\"tresc\"",
     {"[contact.friction] law = \"tresc\"", "allowed: \"none\", \"tresca\"",
      "did you mean \"tresca\"?"}},
    {"\"bilateral\"",
     "\"signorini\"",
     {"case.toml:30:10 [contact] normal = \"signorini\"", "did you mean \"unilateral\"?"}},
    {"\"bilateral\"", "\"normal_compliance\"", {"did you mean \"compliance\"?"}},
    {"\"bilateral\"", "\"bilaterl\"", {"did you mean \"bilateral\"?"}},
    {"\"bilateral\"",
     "\"unilatral\"",
     {"allowed: \"bilateral\", \"unilateral\", \"compliance\", \"damped\"",
      "did you mean \"unilateral\"?"}},
    {"\"exchange\",", "\"frictional_heating\",", {"allowed: \"insulated\", \"exchange\""}},
    {"\"exchange\"", "\"conducting\"", {"allowed: \"insulated\", \"exchange\""}},
    {"\"condensed\"", "\"monolitic\"", {"did you mean \"monolithic\"?"}},
    {"\"triangle\"", "\"tri\"", {"[mesh.box] cell = \"tri\"", "did you mean \"triangle\"?"}},
    {"on = \"left\"", "on = \"lfet\"", {"[contact] on = \"lfet\"", "did you mean \"left\"?"}},
    {"on = \"top\"", "on = \"front\"", {"allowed: \"left\", \"right\", \"bottom\", \"top\""}},
    {"on = \"top\"", "on = []", {"names nothing"}},
    {"[\"bottom\", \"top\"]", "[\"top\", \"top\"]", {"names \"top\" twice"}},
    {"law = \"tresca\"", "law = \"none\"", {"bound = 15", "only used with law = \"tresca\""}},
    {"law = \"exchange\"", "law = \"insulated\"", {"only used with law = \"exchange\""}},
    {"[[boundary]]\non = \"right\"",
     "[boundary]\non = \"right\"",
     {"case.toml:20:", "is not TOML"}},
};
INSTANTIATE_TEST_SUITE_P(Choices, MistakeInAFile, testing::ValuesIn(choices));

const Mistake formulas[] = {
    {"\"-0.5*t\"",
     "\"-0.5*\"",
     {"case.toml:26:16 [boundary[2]] traction[1] = \"-0.5*\"", "Unexpected end of expression"}},
    {"\"-0.5*t\"", "\"-0.5*tt\"", {"\"tt\" found at position 5", "did you mean \"t\"?"}},
    {"\"-0.5*t\"", "\"1/0\"", {"traction[1] = \"1/0\"", "is not a finite number"}},
    {"\"-0.5*t\"",
     "\"-0.5*t + 2.5e-400\"",
     {"traction[1] =", "the number 2.5e-400 is closer to 0"}},
    {"\"-0.5*t\"", "\"\"", {"traction[1] = \"\"", "empty"}},
    {"\"-0.5*t\"", "\"1\\u00000*t\"", {"traction[1] = \"1\\u00000*t\"", "control character"}},
    {"\"-0.5*t\"", "\"max(1, sqrt(-1))\"", {"uses a value on the way", "nan"}},
    {"\"Thermally conductive foundation\"", "\"a\\u0000b\"", {"title", "the character \\u0000"}},
    {"on = \"top\"", "on = \"t\\u0000op\"", {"on = ", "u0000"}},
    {"displacement = [0, 0]", "displacement = [0, \"Free\"]", {"did you mean \"free\"?"}},
};
INSTANTIATE_TEST_SUITE_P(Formulas, MistakeInAFile, testing::ValuesIn(formulas));

TEST(Errors, ASingleTableForAnArrayOfTablesSaysHowToWriteIt) {
  const std::string text = cube.substr(0, cube.find("[[")) + "[boundary]\non = \"top\"\n";
  EXPECT_THAT(error_in(text), HasSubstr("write [[boundary]]"));
}

TEST(Errors, AnEmptyFileSaysSo) {
  EXPECT_THAT(error_in(""), HasSubstr("case.toml: is empty"));
  EXPECT_THAT(error_in(" \n\t\n"), HasSubstr("is empty"));
  EXPECT_THAT(error_in("# nothing\n"), HasSubstr("mesh: missing"));
}

TEST(Errors, ABinaryFileIsNoText) {
  EXPECT_THAT(error_in(std::string("\x7F"
                                   "ELF\0\0",
                                   6)),
              HasSubstr("not a text file"));
}

TEST(Errors, ThirtyKilobytesOfAValueAreNotQuoted) {
  const std::string error =
      error_in(changed("\"condensed\"", "\"" + std::string(30000, 'm') + "\""));
  EXPECT_THAT(error, HasSubstr("mmm..."));
  EXPECT_LT(error.size(), 400u);
}

TEST(Errors, FilesThatCannotBeReadSayWhy) {
  const auto error_of_file = [](const std::filesystem::path &file) -> std::string {
    try {
      read_file(file);
    } catch (const CaseError &error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(error_of_file("no-such-file.toml"), HasSubstr("there is no such file"));
  EXPECT_THAT(error_of_file(testing::TempDir()), HasSubstr("is a folder"));
  EXPECT_THAT(error_of_file("/dev/null"), HasSubstr("is empty"));
  EXPECT_THAT(error_of_file("/dev/zero"), HasSubstr("larger than 16 MiB"));
}

TEST(Errors, ANumberThatIsTooLargeIsNamedInAFileToo) {
  const std::string error = error_in(changed("end = 0.2", "end = 1e400"));
  EXPECT_THAT(error, testing::StartsWith("case.toml:11:"));
  EXPECT_THAT(error, HasSubstr("the number 1e400 is too large"));
}

TEST(Errors, ANumberThatIsTooSmallIsNamedWithItsLine) {
  EXPECT_THAT(error_in(changed("end = 0.2", "end = 1e-400")),
              testing::StartsWith("case.toml:11: the number 1e-400 is closer to 0"));
  EXPECT_THAT(error_in(changed("\"Thermally conductive foundation\"",
                               "\"\"\"a \\\" #\n1e-400\"\"\" # 1e-400\nend = 1e-400")),
              testing::StartsWith("case.toml:3: the number"));
  EXPECT_THAT(error_in(changed("potential = 0", "potential = 0e-400\nx0e_1e-400 = 0.0")),
              HasSubstr("x0e_1e-400"));
}

TEST(Annulus, MistakesAreNamed) {
  const auto error = [](const std::string &annulus) {
    return error_in(ring, {"mesh.annulus." + annulus});
  };
  EXPECT_THAT(error("outer=0.05"), HasSubstr("must be greater than inner, which is 0.1"));
  EXPECT_THAT(error("outer=0.1000000001"), HasSubstr("the wall is too thin"));
  EXPECT_THAT(error("cells=[2,7]"), HasSubstr("the intervals around, must be at least 8"));
  EXPECT_THAT(error("cells=[2,16,2]"), HasSubstr("mesh.annulus.cell makes the case 2-dimensional"));
  EXPECT_THAT(error("height=1"), HasSubstr("only used with cell = \"tetrahedron\""));
  EXPECT_THAT(error_in(ring, {"contact.on=innner"}), HasSubstr("did you mean \"inner\"?"));
  EXPECT_THAT(error_in(ring, {"boundary[0].on=top"}), HasSubstr("outer"));
  EXPECT_THAT(error_in(ring, {"mesh.box={min=[0,0],max=[1,1],cells=[2,2]}"}),
              HasSubstr("both mesh.box and mesh.annulus are given"));
}

}  // namespace
}  // namespace tourmaline::casefile
