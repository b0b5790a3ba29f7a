#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_in.h"
#include "example.h"

namespace tourmaline::casefile {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class FormulaInThePlane : public testing::TestWithParam<const char *> {};

TEST_P(FormulaInThePlane, HasNoZ) {
  EXPECT_THAT(
      error_in(example, {std::string(GetParam()) + "+z\""}),
      AllOf(HasSubstr("+z\": a two-dimensional case has no z"), HasSubstr("allowed: x, y, t")));
  EXPECT_EQ(error_in(example, {std::string(GetParam()) + "+x\""}), "no error");
}

INSTANTIATE_TEST_SUITE_P(Formulas, FormulaInThePlane,
                         testing::Values("boundary[0].potential=\"1", "boundary[0].temperature=\"1",
                                         "boundary[2].surface_charge=\"1",
                                         "contact.friction.bound=\"1",
                                         "contact.heat.coefficient=\"1",
                                         "contact.heat.foundation_temperature=\"1",
                                         "load.charge=\"1", "load.heat=\"1",
                                         "initial.potential=\"1", "initial.temperature=\"1"));

TEST(FormulaInThePlaneOfAList, HasNoZ) {
  for (const char *key :
       {"boundary[0].displacement=[0,\"z\"]", "boundary[2].traction=[0,\"-z\"]",
        "load.force=[\"z\",0]", "initial.displacement=[\"z\",0]", "material.poling=[\"z\",1]"})
    EXPECT_THAT(error_in(example, {key}), HasSubstr("a two-dimensional case has no z")) << key;
}

TEST(FormulaInSpace, MayHaveZ) {
  EXPECT_EQ(error_in(cube, {"boundary[0].potential=\"z*t\""}), "no error");
}

}  // namespace
}  // namespace tourmaline::casefile
