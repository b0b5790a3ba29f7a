// Label: analytic. What the heat equation promises of a body whose contact lets no heat through.

#include "march.h"
#include "richer_paper.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

const std::string no_exchange = "contact.heat.coefficient=0";

TEST(HeatAtTheContact, ExchangeWithACoefficientOfZeroIsInsulation) {
  const RunCase zero(paper({no_exchange}));
  const RunCase insulated(paper({"contact.heat={law='insulated'}"}));
  // Zeros are added to the same numbers, so even the last digit agrees.
  for (const char *column : {"u_x", "u_y", "potential", "temperature"})
    EXPECT_EQ(zero.nodes().columns.at(column), insulated.nodes().columns.at(column)) << column;
  for (const double flux : zero.contact().numbers("heat_flux"))
    EXPECT_EQ(flux, 0);
}

// Entropy of a state: the integral of M:eps(u) + P.E(phi) + alpha theta (6), from the heat rows,
// which carry the sign -.
double entropy(const solve::Model<2> &model, const std::vector<double> &state) {
  std::vector<double> product(state.size());
  model.op.multiply(0, state, product);
  double sum = 0;
  for (std::size_t i = 3; i < product.size(); i += 4)
    sum -= product[i];
  return sum;
}

// The parts of u, phi and theta in the entropy of the last state, with no temperature prescribed.
Eigen::Vector3d entropies(casefile::Case asked) {
  for (casefile::BoundaryCase &boundary : asked.boundaries)
    boundary.temperature.reset();
  const solve::Model<2> model(asked);
  const std::vector<double> state = march(model).state;
  Eigen::Vector3d parts;
  for (std::size_t field = 0; field < 3; ++field) {
    std::vector<double> alone = state;
    for (std::size_t i = 0; i < alone.size(); ++i)
      if (std::max<std::size_t>(i % 4, 1) - 1 != field)
        alone[i] = 0;
    parts[static_cast<Eigen::Index>(field)] = entropy(model, alone);
  }
  return parts;
}

TEST(HeatAtTheContact, WhereNoHeatCrossesAnyBoundaryTheEntropyStaysWhatItWas) {
  const Eigen::Vector3d insulated = entropies(paper({no_exchange}));
  EXPECT_LT(std::abs(insulated.sum()), round_off * insulated.cwiseAbs().maxCoeff());
  EXPECT_GT(insulated.cwiseAbs().minCoeff(), 1e-6 * insulated.cwiseAbs().maxCoeff());
  const Eigen::Vector3d cooled = entropies(paper());
  EXPECT_LT(cooled.sum(), -0.5 * cooled.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace tourmaline::verified
