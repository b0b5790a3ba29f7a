#include "case/electrodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_in.h"
#include "example.h"

namespace tourmaline::casefile {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string ground = "{ name = 'ground', on = 'right', voltage = 0 }";

// The example with these electrodes instead of its prescribed potential.
std::string error_of(const std::string &electrodes, std::vector<std::string> more = {}) {
  more.insert(more.begin(),
              {"boundary[0]={on='right', displacement=[0,0]}", "electrode=[" + electrodes + "]"});
  return error_in(example, more);
}

TEST(Electrodes, EveryKindThatThereIsCanBeAsked) {
  for (const char *top :
       {"voltage = '5*t'", "charge = 1e-9", "resistor = 1e6", "capacitor = 1e-9",
        "resistor = 1e6, capacitor = 1e-9, voltage = 3", "resistor = 1e6, to = 'ground'"})
    EXPECT_EQ(error_of(ground + ", { name = 'top', on = ['top', 'bottom'], " + top + " }"),
              "no error");
  EXPECT_EQ(error_of(ground + ", { name = 'top', on = 'top' }"), "no error");  // open
}

struct Mistake {
  std::string electrode, key, piece;  ///< of the error text
};

void PrintTo(const Mistake &mistake, std::ostream *out) {
  *out << mistake.electrode;
}

class MistakeInAnElectrode : public testing::TestWithParam<Mistake> {};

TEST_P(MistakeInAnElectrode, IsAnsweredWithTheReason) {
  const std::string error = error_of(ground + ", { " + GetParam().electrode + " }");
  EXPECT_THAT(error, HasSubstr("[electrode[1]] " + GetParam().key));
  EXPECT_THAT(error, HasSubstr(GetParam().piece));
}

INSTANTIATE_TEST_SUITE_P(
    Electrodes, MistakeInAnElectrode,
    testing::Values(
        Mistake{"name = 'ground', on = 'top'", "name", "this name has already been given at"},
        Mistake{"name = 'my top', on = 'top'", "name", "must consist of letters, digits, _ and -"},
        Mistake{"name = 'a', on = 'right'", "on", "on = \"right\": there is an electrode already"},
        Mistake{"name = 'a', on = 'top', charge = 0, voltage = 1", "charge", "its charge is given"},
        Mistake{"name = 'a', on = 'top', charge = 0, resistor = 1", "charge",
                "its charge is given"},
        Mistake{"name = 'a', on = 'top', voltage = '3*x'", "voltage", "depends on the place"},
        Mistake{"name = 'a', on = 'top', resistor = 0", "resistor", "must be > 0"},
        Mistake{"name = 'a', on = 'top', to = 'ground'", "to", "but there is none"},
        Mistake{"name = 'a', on = 'top', resistor = 1, to = 'ground', voltage = 1", "to",
                "give one"},
        Mistake{"name = 'a', on = 'top', resistor = 1, to = 'groud'", "to",
                "did you mean \"ground\"?"},
        Mistake{"name = 'a', on = 'top', resistor = 1, to = 'a'", "to",
                "is the electrode itself"}));

TEST(Electrodes, TheNearestNameIsNeverTheElectrodesOwn) {
  EXPECT_THAT(error_of("{ name = 'a', on = 'right', resistor = 1, to = 'b' }"),
              AllOf(HasSubstr("[electrode[0]] to = \"b\": names no electrode"),
                    HasSubstr("there is no other electrode"), Not(HasSubstr("did you mean"))));
}

TEST(Electrodes, AGivenChargeCannotFlowOverAResistor) {
  EXPECT_THAT(error_of(ground + ", { name = 'a', on = 'top', charge = 1e-9 }, { name = 'b', on = "
                                "'bottom', resistor = 1, to = 'a' }"),
              HasSubstr("whose charge is given and cannot flow"));
}

TEST(Electrodes, ABoundaryHasAnElectrodeOrAPotentialNotBoth) {
  const std::string error =
      error_of(ground, {"boundary[0]={on='right', displacement=[0,0], potential=0}"});
  EXPECT_THAT(error, HasSubstr("on = \"right\": this boundary has already a condition on the "
                               "potential or surface charge"));
}

TEST(Electrodes, WithoutAPathToAGivenVoltageThePotentialFloats) {
  EXPECT_THAT(error_of("{ name = 'a', on = 'top' }, { name = 'b', on = 'right', resistor = 1, to = "
                       "'a' }"),
              HasSubstr("no electrode has a path to a given voltage"));
  EXPECT_EQ(error_of("{ name = 'a', on = 'top', resistor = 1 }"), "no error");
}

TEST(Electrodes, OneSearchForPotentialsAtATime) {
  const std::string open = ground + ", { name = 'a', on = 'top' }",
                    circuit =
                        "contact={on='left', electric={law='exchange', coefficient=1e-9, "
                        "circuit={charge=0}}}";
  for (const std::string route : {"solver.method=\"monolithic\"", "solver.body=\"iterative\""}) {
    std::string named = route;
    named.replace(named.find('='), 1, " = ");
    EXPECT_EQ(error_of(open, {route}), "no error");
    EXPECT_EQ(error_of(ground, {route, circuit}), "no error");
    EXPECT_THAT(error_of(open, {route, circuit}),
                HasSubstr("not available with " + named + " where a foundation has a circuit"));
  }
  EXPECT_EQ(error_of(open, {circuit}), "no error");
}

}  // namespace
}  // namespace tourmaline::casefile
