#include "run/rehearsal.h"

#include <gmock/gmock.h>

#include "small_case.h"
#include "tourmaline/error.h"

namespace tourmaline::run {
namespace {

void rehearse_with(const std::string &change) {
  rehearse(small_case({change}));
}

TEST(Rehearsal, OfASoundCaseIsQuiet) {
  EXPECT_NO_THROW(rehearse_with("contact.gap=0"));
}

class Rehearsal : public testing::TestWithParam<std::array<const char *, 2>> {};

TEST_P(Rehearsal, FindsWhatARunWouldRefuse) {
  const auto &[change, words] = GetParam();
  try {
    rehearse_with(change);
    FAIL() << change;
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(words));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Formulas, Rehearsal,
    testing::Values(
        std::array{"contact.gap='1/(x-0.01)'", "gap"},
        std::array{"contact.friction.coefficient='0.3-x*20'", "is -0.1, but must be >= 0"},
        std::array{"contact.friction.coefficient='0.3-t/2'", "t = 0.7"},
        std::array{
            "contact.friction={law='coulomb',coefficient=0.3,cohesion=1e3,limit='2e3-1500*t'}",
            "beside the cohesion, is 950"},
        std::array{"contact.foundation_displacement=['1/(t-0.5)',0]", "foundation_displacement"},
        std::array{"contact.normal={law='compliance',coefficient='1e15*(x-0.01)'}",
                   "but must be > 0"},
        std::array{"contact.heat={law='exchange',coefficient='-x',foundation_temperature=1}",
                   "coefficient"},
        std::array{"contact.heat={law='exchange',coefficient=1,foundation_temperature=1,"
                   "pressure={coefficient='-x',reference=1e5}}",
                   "coefficient"},
        std::array{"boundary[0].traction=['sqrt(0.5-t)',0]", "traction"},
        std::array{"boundary[0].displacement=['sqrt(0.5-t)',0]", "displacement"},
        std::array{"contact.on=['bottom','left']", "45"}));

}  // namespace
}  // namespace tourmaline::run
