// Mistakes in what --set gives.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_in.h"
#include "example.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

struct BadOverride {
  std::string text;
  std::string piece;
};

void PrintTo(const BadOverride &bad, std::ostream *out) {
  *out << bad.text;
}

class BadOverrides : public testing::TestWithParam<BadOverride> {};

TEST_P(BadOverrides, AreNamedAsTheirPlace) {
  const std::string error = error_in(example, {GetParam().text});
  EXPECT_THAT(error, testing::StartsWith("--set " + GetParam().text));
  EXPECT_THAT(error, HasSubstr(GetParam().piece));
}

const BadOverride bad_overrides[] = {
    {"contact.friction.bound=-3", "must be >= 0 N/m^2"},
    {"contact.friction.bund=3", "did you mean \"bound\"?"},
    {"solver.method=monolitic", "did you mean \"monolithic\"?"},
    {"time.steps=abc", "is a text, but must be an integer"},
    {"time.steps", "has no \"=\""},
    {"time.steps=", "has no value"},
    {"boundary[0.potential=7", "counted from 0"},
    {"boundary[].potential=7", "empty part"},
    {"boundary0].potential=7", "counted from 0"},
    {"=3", "empty part"},
    {"time..steps=3", "empty part"},
    {"time.steps.x=3", "time.steps is a value"},
    {"boundary[tpo].traction=[0,1]",
     "no entry of boundary is called \"tpo\"; did you mean \"top\"?"},
    {"boundary[tpo].traction=[0,1]", "; there are right, bottom+top, top"},
    {"contact[left].friction.bound=5",
     "contact is no list with an entry \"left\"; write contact.KEY"},
    {"mesh.box.cells[x]=5", "no entry of mesh.box.cells is called \"x\""},
    {"probe[a].at=[0,0]", "probe is no list"},
    {"time[end]=5", "time is no list with an entry \"end\"; write time.KEY"},
    {"boundary[9].on=left", "boundary has 3 entries"},
    {"boundary.first.on=left", "boundary is a list"},
    {"mesh.box.cells=[1,", "not one of TOML's"},
    {"time.end=1\nsteps = 3", "there are several"},
    {"mesh.box.cells[5]=3", "has 2 entries"},
    {"iterations=3", "unknown key"},
    {"steps=3", "one of that name in [time]"},
    {"time=3", "must be a table: [time]"},
    {"output={evry=3}", "did you mean \"every\"?"},
    {"boundary[1].on[0]=lft", "did you mean \"left\"?"},
    {"boundary[3].potential=1", "on: missing"},
    {"contact.normal=compliance", "[contact.normal] coefficient: missing"},
    {"contact.normal=bilaterl", "did you mean \"bilateral\"?"},
    {"contact.normal.coefficient=1e13", "only used with law = \"compliance\" or \"damped\""},
    {"contact.normal.coefficent=1e13", "did you mean \"coefficient\"?"},
    {"contact.friction.bound.x=1", "contact.friction.bound is a value"},
    {"contact[0].on=left", "contact is a table and no list"},
    {"time.end=1e400", "the number 1e400 is too large: double precision ends at 1.8e+308"},
    {"time.end=-1.5e999", "the number -1.5e999 is too large"},
    {"time.end=1_000e307", "the number 1000e307 is too large"},
    {"time.steps=99999999999999999999", "the integer 99999999999999999999 is too large: at most"},
    {"mesh.box.max=[1e400,1]", "the number 1e400 is too large"},
    {"boundary[0].potential=\"2*1e400*t\"", "the number 1e400 is too large"},
};
INSTANTIATE_TEST_SUITE_P(All, BadOverrides, testing::ValuesIn(bad_overrides));

TEST(Errors, AVeryLongOverrideIsNotRepeatedInFull) {
  EXPECT_LT(error_in(example, {"title=[" + std::string(50000, '1') + "]"}).size(), 500u);
}

}  // namespace
}  // namespace tourmaline::casefile
