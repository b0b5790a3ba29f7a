// Label: routes. The state in which a motion starts, found by a factorisation and without one.

#include "solve/settling.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tourmaline/case/reader.h"

namespace tourmaline::solve {
namespace {

// Charge crosses the contact, from which some nodes have come off and some have not, one electrode
// floats, and nothing is in equilibrium; the foundation is at a voltage or has one of its own.
std::string block(int dim) {
  const bool plane = dim == 2;
  return fmt::format(R"toml(
mesh.box = {{ min = [0, 0{0}], max = [0.02, 0.01{1}], cells = [8, 4{2}], cell = "{3}" }}
material = {{ library = "BaTiO3-Liu2014", poling = [1, 2{0}] }}
time = {{ end = 1e-6, steps = 5, regime = "dynamic" }}
boundary = [ {{ on = "top", temperature = 0, traction = ["2e5", -1e6{0}] }} ]
electrode = [ {{ name = "given", on = "left", voltage = 0 }},
              {{ name = "floating", on = "right", capacitor = 1e-11 }} ]
[initial]
potential = "1e6*x*(x - 0.02)*y"
temperature = "3*x"
displacement = [0, "1e-4*(x - 0.01)"{0}]
[contact]
on = "{4}"
normal = "unilateral"
friction = {{ law = "coulomb", coefficient = 0.3 }}
electric = {{ law = "exchange", coefficient = 1e-5, foundation_potential = 20 }}
)toml",
                     plane ? "" : ", 0", plane ? "" : ", 0.01", plane ? "" : ", 3",
                     plane ? "quadrilateral" : "tetrahedron", plane ? "bottom" : "front");
}

template <int dim>
std::vector<double> settled(const casefile::Case &asked, bool iteratively) {
  const Model<dim> model(asked);
  std::vector<double> state = body::initial_state(model.body, asked.initial);
  FoundationCircuits<dim> foundations(model);
  foundations.begin(state);
  settle(model, iteratively, foundations, state);
  return state;
}

template <int dim>
void expect_same(const std::vector<std::string> &changes) {
  const casefile::Case asked = casefile::read_text(block(dim), "start.toml", changes);
  const std::vector<double> factorised = settled<dim>(asked, false),
                            iterated = settled<dim>(asked, true),
                            before = body::initial_state(Model<dim>(asked).body, asked.initial);
  std::vector<double> size(dim + 2, 0.), moved(size), apart(size);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::size_t c = i % size.size();
    size[c] = std::max(size[c], std::abs(factorised[i]));
    moved[c] = std::max(moved[c], std::abs(factorised[i] - before[i]));
    apart[c] = std::max(apart[c], std::abs(factorised[i] - iterated[i]));
  }
  for (std::size_t c = 0; c < size.size(); ++c)
    EXPECT_LE(apart[c], 1e-11 * size[c]) << "component " << c;
  EXPECT_GT(moved[1], 1e-6 * size[1]);      // nodes without mass
  EXPECT_GT(moved[dim], 1e-2 * size[dim]);  // potentials
  EXPECT_EQ(moved[dim + 1], 0);
}

TEST(StartOfMotion, IsSettledAlikeWithAndWithoutAFactorisation) {
  for (const std::vector<std::string> &changes : {std::vector<std::string>{}, {"mesh.degree=2"}}) {
    SCOPED_TRACE(changes.size());
    expect_same<2>(changes);
  }
  expect_same<3>({});
  expect_same<3>({"mesh.box.cell=\"hexahedron\"", "contact.friction=\"none\""});
}

// The equation of first order of a damped node lets it not jump.
TEST(StartOfMotion, LeavesNodesThatAreDampedWhereTheyAre) {
  for (const bool iteratively : {false, true}) {
    const casefile::Case asked =
        casefile::read_text(block(2), "start.toml", {"material.stiffness_damping=2e-8"});
    const std::vector<double> before = body::initial_state(Model<2>(asked).body, asked.initial),
                              after = settled<2>(asked, iteratively);
    double moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (i % 4 < 2)
        EXPECT_EQ(after[i], before[i]);
      else
        moved = std::max(moved, std::abs(after[i] - before[i]));
    EXPECT_GT(moved, 1);  // V
  }
}

TEST(StartOfMotion, IsSettledAlikeWhereAFoundationHasAPotentialOfItsOwn) {
  expect_same<2>(
      {"contact.electric={law=\"exchange\",coefficient=1e-5,"
       "circuit={resistor=1e5,capacitor=1e-11}}",
       "electrode[1]={name=\"other\",on=\"right\",voltage=5}"});
}

}  // namespace
}  // namespace tourmaline::solve
