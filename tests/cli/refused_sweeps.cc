#include <gmock/gmock.h>

#include "sweep.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;

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

TEST_F(Sweep, ColumnsAreNoFolder) {
  EXPECT_EQ(run("sweep small.toml --vary contact.friction.bound=5 --output max:slip,load_y"), 2);
  EXPECT_THAT(complained_, HasSubstr("--output is the folder of the study; what sweep.csv and "
                                     "sweep.svg show is chosen by --columns max:slip,load_y. If "
                                     "a folder is meant, write ./max:slip,load_y"));
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
    {"UnknownOutput", "--vary contact.friction.bound=5 --columns slop", "did you mean \"slip\"?"},
    {"UnknownOutputIsAnsweredWithTheList", "--vary contact.friction.bound=5 --columns max:slop",
     "did you mean \"max:slip\"?; allowed: step, time, newton_iterations, "},
    {"UnknownReduction", "--vary contact.friction.bound=5 --columns maks:slip",
     "did you mean \"max\"?"},
    {"TimeBehindTheEnd", "--vary contact.friction.bound=5 --columns slip@2",
     "above 0 and at most 1, the end of the runs"},
    {"OneNumberInTwoForms", "--vary contact.friction.bound=15,1.5e1",
     "gives 15 twice, the second time as 1.5e1"},
    {"WrongSet", "--vary contact.friction.bound=5 --set time.steps=0", "steps = 0: must be >= 1"},
    {"NoJobs", "--vary contact.friction.bound=5 --jobs 0", "--jobs"},
};
INSTANTIATE_TEST_SUITE_P(Studies, BadSweep, testing::ValuesIn(bad_studies),
                         [](const auto &bad) { return std::string(bad.param.claim); });

}  // namespace
