// Label: analytic. Backward Euler is of first order for a body that sticks and slips.

#include <fmt/format.h>

#include "richer_paper.h"

namespace tourmaline::verified {
namespace {

// Loads grow smoothly from nothing. Nodes change from stick to slip between two steps, which lets
// the ratio scatter about 2.
TEST(TimeStep, HalvedHalvesTheErrorOfASlidingBody) {
  std::vector<Table> nodes;
  for (const int steps : {20, 40, 80, 160}) {
    const RunCase run(paper({fmt::format("time.steps={}", steps),
                             "contact.heat.foundation_temperature='-27*(t/0.2)^2'",
                             "boundary[2].traction=['75*t^2','-125*t^2']"}));
    EXPECT_TRUE(sticks_and_slips(run.contact().columns.at("status")));
    nodes.push_back(run.nodes());
  }
  for (const char *column : {"u_x", "u_y", "potential", "temperature"}) {
    std::vector<double> change;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      change.push_back(difference(nodes[i], nodes[i + 1], column, 1));
    RecordProperty(column,
                   fmt::format("{:.3e} {:.3e} {:.3e}, ratios {:.3f} {:.3f}", change[0], change[1],
                               change[2], change[0] / change[1], change[1] / change[2]));
    EXPECT_NEAR(change[0] / change[1], 2, 0.2) << column;
    EXPECT_NEAR(change[1] / change[2], 2, 0.1) << column;
  }
}

}  // namespace
}  // namespace tourmaline::verified
