#include "solve/circuit.h"

#include <gtest/gtest.h>

namespace tourmaline::solve {
namespace {

using casefile::ElectrodeCase;
using casefile::Formula;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double step = 0.5;

ElectrodeCase electrode(const char *name) {
  ElectrodeCase found;
  found.name = name;
  return found;
}

// Resistor and capacitor between a and b, a capacitor from b to a source of 10 V/s and one from c
// to an electrode whose voltage is given; d has a charge of its own.
std::vector<ElectrodeCase> electrodes() {
  ElectrodeCase a = electrode("a"), b = electrode("b"), given = electrode("given"),
                c = electrode("c"), d = electrode("d");
  a.to = "b";
  a.resistor = 4;
  a.capacitor = 3;
  b.voltage = Formula(std::string("10*t"));
  b.capacitor = 2;
  given.voltage = Formula(6.);
  c.to = "given";
  c.capacitor = 7;
  d.charge = Formula(std::string("3*t"));
  return {a, b, given, c, d};
}

TEST(Circuit, ResistorsAndCapacitorsJoinTheFreeElectrodes) {
  const Circuit circuit(electrodes(), step);
  EXPECT_EQ(circuit.free(), (std::vector<std::size_t>{0, 1, 3, 4}));
  // k / R + C of each: 1/8 + 3 F, 2 F and 7 F.
  const MatrixXd expected{{3.125, -3.125, 0, 0}, {-3.125, 5.125, 0, 0}, {0, 0, 7, 0}, {0, 0, 0, 0}};
  EXPECT_EQ(circuit.admittance(), expected);
}

// Q_n - Q_(n-1) is what branches have brought: C times the change, k / R times the value now, of
// the voltage that their other end has beyond this one. What belongs to V_n is Y's.
TEST(Circuit, ItsRightSideIsWhatItHasBroughtBeforeAndWhatSourcesBring) {
  const Circuit circuit(electrodes(), step);
  const VectorXd charges{{1, 2, 3, 4}}, before{{0.5, 0.25, 5, 1, 99}}, now{{99, 99, 6, 99, 99}};
  const double between = 3 * (0.5 - 0.25);
  const VectorXd expected{
      {1 + between, 2 - between + 2 * (0.25 - 15) + 2 * 20, 3 + 7 * (1 - 5) + 7 * 6, 6}};
  EXPECT_EQ(circuit.right_side(1.5, 2, charges, before, now), expected);
}

// A source of 10 V that is there from the start has brought nothing before it.
TEST(Circuit, SourcesAreSwitchedOnAtTheStart) {
  ElectrodeCase a = electrode("a");
  a.voltage = Formula(10.);
  a.capacitor = 2;
  const Circuit circuit({a}, step);
  const VectorXd charges{{1}}, before{{3}}, now{{99}};
  EXPECT_EQ(circuit.right_side(std::nullopt, step, charges, before, now)[0], 1 + 2 * 3 + 2 * 10);
  EXPECT_EQ(circuit.right_side(0., step, charges, before, now)[0], 1 + 2 * (3 - 10) + 2 * 10);
}

TEST(Circuit, AtOnceChargeComesThroughCapacitorsAlone) {
  const Circuit circuit(electrodes(), 0);
  const MatrixXd expected{{3, -3, 0, 0}, {-3, 5, 0, 0}, {0, 0, 7, 0}, {0, 0, 0, 0}};
  EXPECT_EQ(circuit.admittance(), expected);
}

}  // namespace
}  // namespace tourmaline::solve
