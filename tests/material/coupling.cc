#include "material/coupling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "material/constants.h"
#include "tourmaline/error.h"

#include "ceramic.h"
#include "tourmaline/case/case.h"

namespace tourmaline::material {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// k^2 = 1 - eps33^S/eps33^T for a field along the axis, and the like for one across it.
TEST(CouplingFactor, IsThatOfTheMostCoupledDirection) {
  const Constants c = constants_of(verified::ceramic());
  const Tensor clamped = clamped_part(c);
  const double along = clamped(2, 2) / (c.permittivity(2, 2) + clamped(2, 2)),
               across = clamped(0, 0) / (c.permittivity(0, 0) + clamped(0, 0));
  EXPECT_NEAR(coupling_factor(c), std::sqrt(std::max(along, across)), 1e-12);
  EXPECT_GT(coupling_factor(c), 0.7);
}

// An eps^T that is not positive definite by itself is no doing of piezoelectric constants.
TEST(CouplingFactor, PermittivityOfItselfIsStillNamedAsSuch) {
  casefile::MaterialCase asked = verified::ceramic();
  asked.constants.erase("eps11");
  asked.constants.erase("eps33");
  asked.permittivity_T = {{1e-8, 2e-8, 0}, {2e-8, 1e-8, 0}, {0, 0, 1e-8}};
  try {
    constants_of(asked);
    FAIL();
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("permittivity is not positive definite"),
                                    Not(HasSubstr("too large"))));
  }
}

}  // namespace
}  // namespace tourmaline::material
