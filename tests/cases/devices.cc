// The cases of cases/devices: closed forms where there are any, facts of mechanics otherwise.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "closed_balances.h"
#include "run_case.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

RunCase device(const std::string &name, const std::vector<std::string> &overrides = {}) {
  return RunCase("cases/devices/" + name + ".toml", overrides);
}

// BaTiO3-Liu2014 in plane strain with no stress through the thickness.
constexpr double c_bar = 166e9 - 78e9 * 78e9 / 162e9;
constexpr double e_bar = -4.4 - 78e9 * 18.6 / 162e9;
constexpr double beta_bar = 12.6e-9 + 18.6 * 18.6 / 162e9;

// The curvature of a free series bimorph of two layers of height h under V
// (cases/devices/README.md).
TEST(Bimorph, WithoutThePadItBendsByTheClosedForm) {
  constexpr double h = 0.5e-3, length = 20e-3, volts = 50;
  const double curvature =
      e_bar * volts / (h * h * (4. / 3 * c_bar + e_bar * e_bar / (3 * beta_bar)));
  casefile::Case asked = casefile::read_file(
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/devices/bimorph.toml",
      {"output.fields=false"}, mesh::read_mesh_file);
  asked.contacts.clear();
  const RunCase run(asked);
  const Table nodes = run.nodes();
  // Slender beams bend like this but for the ends: 1/20 of the length is as thick as the strip.
  EXPECT_NEAR(largest(nodes, "u_y"), std::abs(curvature) * length * length / 2,
              0.03 * std::abs(curvature) * length * length / 2);
}

// The same with no word of heat: then no temperature changes, and nothing is to be warned of.
TEST(Bimorph, StaticItBendsByTheClosedForm) {
  constexpr double h = 0.5e-3, length = 20e-3, volts = 50;
  const double curvature =
      e_bar * volts / (h * h * (4. / 3 * c_bar + e_bar * e_bar / (3 * beta_bar)));
  const RunCase run = device("bimorph-static");
  EXPECT_NEAR(largest(run.nodes(), "u_y"), std::abs(curvature) * length * length / 2,
              0.01 * std::abs(curvature) * length * length / 2);
  for (const double theta : run.nodes().numbers("temperature"))
    EXPECT_EQ(theta, 0);
  EXPECT_EQ(run.summary()["warnings"].size(), 0U);
  expect_closed_balances(run.history());
}

TEST(Bimorph, ThePadSlipsAndItsFrictionStaysAtTheBound) {
  const RunCase run = device("bimorph");
  EXPECT_GT(run.history().numbers("slip").back(), 0);
  EXPECT_LE(largest(run.contact(), "tangential_traction_x"), 2e3 * (1 + 1e-12));
  for (const double imbalance : run.history().numbers("energy_imbalance"))
    EXPECT_LT(std::abs(imbalance), 1e-9);
}

TEST(Washers, BothSendChargeOfOneSignToTheShim) {
  const RunCase run = device("washers");
  const Table history = run.history();
  const auto shim = history.numbers("charge_rim of the shim"),
             foot = history.numbers("charge_foot"), head = history.numbers("charge_head");
  for (std::size_t i = 0; i < shim.size(); ++i) {
    EXPECT_LT(foot[i] * shim[i], 0);
    EXPECT_LT(head[i] * shim[i], 0);
    EXPECT_NEAR(shim[i] + foot[i] + head[i], 0, 1e-9 * std::abs(shim[i]));
  }
}

// Without friction and before the heat, a washer is a free disc under the force F but for the
// steel, which hinders its widening and with it what d31 adds: each sends a little less than d33 F.
TEST(Washers, WithoutFrictionTheirChargeIsThatOfTheForceAndProportionalToIt) {
  const RunCase run = device("washers", {"contact.friction={law='none'}"});
  const Table history = run.history();
  const auto shim = history.numbers("charge_rim of the shim"), force = history.numbers("load_z");
  constexpr double d33 = 1.914e-10;  // of BaTiO3-Liu2014, `tourmaline materials`
  for (const int step : {0, 1}) {
    EXPECT_GT(shim[step] / (2 * d33 * force[step]), 0.9);
    EXPECT_LT(shim[step] / (2 * d33 * force[step]), 1);
  }
  // But for the heat of pressing, which flows off.
  EXPECT_NEAR(shim[1] / shim[0], 2, 1e-3);
}

// Nothing warms this sensor: what is left of heat in it is round-off, and must not look like a
// fault.
TEST(FrictionSensor, WithoutHeatItsBalancesCloseToo) {
  const RunCase run = device("friction-sensor-loaded");
  expect_closed_balances(run.history(), 1e-9);
}

// Pure shear: gamma h = top - slip, |c44 gamma| <= S, D = e15 gamma on both faces.
TEST(FrictionSensor, ChargeOverSlipIsTheExactLoop) {
  constexpr double c44 = 43e9, e15 = 11.6, bound = 5e4, h = 2e-3, width = 0.01;
  const RunCase run = device("friction-sensor");
  const Table history = run.history();
  const auto charge = history.numbers("charge_top"), time = history.numbers("time");
  double slip = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double t = time[i], top = 4e-9 * (t < 1 ? t : t < 3 ? 2 - t : t - 4);
    const double shear = std::clamp((top - slip) / h, -bound / c44, bound / c44);
    slip = top - shear * h;
    EXPECT_NEAR(std::abs(charge[i]), e15 * std::abs(shear) * width,
                1e-9 * e15 * bound / c44 * width)
        << "t = " << t;
  }
}

TEST(LShape, ThePotentialStaysBetweenItsElectrodesAndTheBevelSlips) {
  const RunCase run = device("l-shape");
  const Table history = run.history();
  EXPECT_EQ(history.numbers("max_potential").back(), 20);
  EXPECT_EQ(history.numbers("min_potential").back(), 0);
  EXPECT_GT(history.numbers("slip").back(), 0);
  EXPECT_NEAR(history.numbers("charge_0 V").back() + history.numbers("charge_20 V").back(), 0,
              1e-9 * std::abs(history.numbers("charge_20 V").back()));
}

// A cantilever whose electrodes are open feels a bending moment against the turning of its end,
// spring w'(L) (cases/devices/README.md): its lowest x in w ~ cos(x s/L), ....
double lowest_root_of_a_beam(double spring_over_bending) {
  const auto moment_at_the_end = [&](double x) {
    const double share = (std::sinh(x) - std::sin(x)) / (std::cosh(x) + std::cos(x));
    const double turning = std::sinh(x) + std::sin(x) - share * (std::cosh(x) - std::cos(x));
    const double curvature = std::cosh(x) + std::cos(x) - share * (std::sinh(x) + std::sin(x));
    return x * curvature + spring_over_bending * turning;
  };
  double low = 1.5, high = 2.3;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (moment_at_the_end(low) * moment_at_the_end(middle) <= 0 ? high : low) = middle;
  }
  return low;
}

// The harvester without a stop near enough, let go with about the velocities of its first mode and
// not damped; the frequency by the rising zeros of a column.
double frequency_of_the_harvester(const std::string &resistor, const char *column) {
  const RunCase run =
      device("impact-harvester",
             {"time.end=0.0125", "time.steps=1000", "contact.gap=1e-3",
              "electrode[1].resistor=" + resistor, "load.base_acceleration=[0,0]",
              "initial.velocity=[0,'10*x*x*(6-4*x/0.04+(x/0.04)^2)']",
              "region[0].material.mass_damping=0", "region[1].material.mass_damping=0",
              "region[0].material.stiffness_damping=0", "region[1].material.stiffness_damping=0"});
  const Table history = run.history();
  expect_closed_balances(history, 1e-9);
  const auto t = history.numbers("time"), q = history.numbers(column);
  std::vector<double> zeros;
  for (std::size_t i = 0; i + 1 < q.size(); ++i)
    if (q[i] <= 0 && q[i + 1] > 0)
      zeros.push_back(t[i] - q[i] * (t[i + 1] - t[i]) / (q[i + 1] - q[i]));
  EXPECT_GE(zeros.size(), 5U);
  return static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
}

TEST(ImpactHarvester, RingsAtTheFrequenciesOfABeamWithJoinedAndWithOpenElectrodes) {
  constexpr double h = 0.5e-3, length = 0.04, density = 5500;
  const double bending = h * h * h * (2. / 3 * c_bar + e_bar * e_bar / (6 * beta_bar)),
               spring = e_bar * e_bar * h * h * h / (2 * beta_bar * length);
  const auto frequency = [&](double x) {
    return x * x * std::sqrt(bending / (density * 2 * h)) / (length * length) /
           (2 * std::numbers::pi);
  };
  const double closed_joined = frequency(lowest_root_of_a_beam(0)),
               closed_open = frequency(lowest_root_of_a_beam(spring * length / bending));
  const double joined = frequency_of_the_harvester("1e-6", "electrode_load_charge"),
               open = frequency_of_the_harvester("1e12", "electrode_load_voltage");
  // The clamp, which hinders the widening of the strip, makes it stiffer; measured: 0.2 %.
  EXPECT_NEAR(joined, closed_joined, 4e-3 * closed_joined);
  // What the electrodes do is a shift of 2 %, and not the clamp's.
  EXPECT_NEAR(open / joined, closed_open / closed_joined, 5e-4);
}

double mean_power(const RunCase &run, double resistor) {
  double squares = 0;
  const auto voltage = run.history().numbers("electrode_load_voltage");
  for (const double v : voltage)
    squares += v * v;
  return squares / resistor / static_cast<double>(voltage.size());
}

const std::vector<std::string> six_periods{"time.end=0.0125", "time.steps=1000"};

// The stop yields by p/c, some tenths of a micron, and never more.
TEST(ImpactHarvester, TheResistorHasWhatTheElectrodesGiveAndTheStopHoldsTheTip) {
  constexpr double resistor = 540, stiffness = 1e11;
  const RunCase run = device("impact-harvester", six_periods);
  const Table history = run.history();
  expect_closed_balances(history, 1e-9);
  const auto voltage = history.numbers("electrode_load_voltage"),
             current = history.numbers("electrode_load_current"),
             charge = history.numbers("electrode_load_charge");
  const double most = largest(current);
  double given = 0;
  for (std::size_t i = 0; i < voltage.size(); ++i) {
    EXPECT_NEAR(current[i], -voltage[i] / resistor, 1e-8 * most);
    if (i > 0)
      given -= (voltage[i] + voltage[i - 1]) / 2 * (charge[i] - charge[i - 1]);
  }
  // The rules of the right side and of the trapezium, for a voltage of 80 steps a period.
  const double consumed = mean_power(run, resistor) * 0.0125;
  EXPECT_NEAR(given, consumed, 5e-3 * consumed);
  double lost = 0, loaded = 0;
  for (const double power : history.numbers("time_step_loss"))
    lost += power;
  for (const double power : history.numbers("load_power"))
    loaded += power;
  EXPECT_LE(std::abs(lost), 0.02 * loaded);
  const Table contact = run.contact();
  const auto gap = contact.numbers("gap"), traction = contact.numbers("normal_traction");
  double least = 0;
  for (std::size_t i = 0; i < gap.size(); ++i) {
    least = std::min(least, gap[i]);
    EXPECT_NEAR(-traction[i], stiffness * std::max(0., -gap[i]), 1e-6 * 4e4);
  }
  EXPECT_LT(least, 0);      // it does hit
  EXPECT_GT(least, -8e-7);  // and goes in by less than a tenth of the gap
}

TEST(ImpactHarvester, ARigidStopIsNeverPassed) {
  auto overrides = six_periods;
  overrides.emplace_back("contact.normal=unilateral");
  const RunCase run = device("impact-harvester", overrides);
  double pressure = 0;
  const Table contact = run.contact();
  for (const double gap : contact.numbers("gap"))
    EXPECT_GE(gap, -1e-15);
  for (const double traction : contact.numbers("normal_traction")) {
    EXPECT_LE(traction, 0);
    pressure = std::max(pressure, -traction);
  }
  EXPECT_GT(pressure, 0);
}

// Driven between its two resonances it has its best resistance at 1/(omega C), with the stop, too;
// the stop takes a good part of the power.
TEST(ImpactHarvester, ItsBestResistanceIsThatOfItsCapacity) {
  constexpr double h = 0.5e-3, length = 0.04, frequency = 499;
  const double best = 2 * h / (beta_bar * length * 2 * std::numbers::pi * frequency);
  EXPECT_NEAR(best, 540, 2);
  std::map<std::string, double> at_best;
  for (const std::string gap : {"1e-3", "'x > 0.0379 ? 8e-6 : 1e-3'"}) {
    std::vector<double> power;
    for (const double resistor : {best / 2, best, best * 2}) {
      auto overrides = six_periods;
      overrides.push_back("contact.gap=" + gap);
      overrides.push_back(fmt::format("electrode[1].resistor={}", resistor));
      power.push_back(mean_power(device("impact-harvester", overrides), resistor));
    }
    EXPECT_GT(power[1], 1.05 * power[0]) << gap;
    EXPECT_GT(power[1], 1.05 * power[2]) << gap;
    at_best[gap] = power[1];
  }
  EXPECT_LT(at_best["'x > 0.0379 ? 8e-6 : 1e-3'"], 0.7 * at_best["1e-3"]);
}

// Where the foot has come to after each period of the drive: the mean slip of its nodes, at 0 V.
std::vector<double> foot_after_periods(const RunCase &run, double period, int periods) {
  const Table contact = run.contact();
  const auto time = contact.numbers("time"), slip = contact.numbers("slip_x");
  std::vector<double> feet;
  for (int n = 1; n <= periods; ++n) {
    double sum = 0;
    int nodes = 0;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (std::abs(time[i] - n * period) < 1e-9) {
        sum += slip[i];
        ++nodes;
      }
    EXPECT_GT(nodes, 0);
    feet.push_back(sum / nodes);
  }
  return feet;
}

// Two masses, a spring with a damper between them whose length at rest follows the voltage, and
// Coulomb's friction under the first: the last step of four.
double step_of_two_masses(double friction) {
  constexpr double height = 5e-3, steel = 7850, ceramic = 5500, damping = 1e-6;
  constexpr double foot = height * (0.01 * steel + 0.005 * ceramic),
                   mass = height * (0.02 * steel + 0.005 * ceramic);
  constexpr double det = 162e9 * 166e9 - 78e9 * 78e9, e31 = -4.4, e33 = 18.6;
  constexpr double free_strain = (e33 * 166e9 - e31 * 78e9) / det;  // of 1 V/m, in plane strain
  constexpr double steel_modulus = 210e9 / 0.91;
  constexpr double stiffness = height / (0.01 / (det / 166e9) + 0.015 / steel_modulus);
  constexpr double period = 5e-4, fall = 2e-5, dt = 1e-8;
  const int all = static_cast<int>(std::lround(period / dt)),
            slow = static_cast<int>(std::lround((period - fall) / dt));
  double x1 = 0, x2 = 0, v1 = 0, v2 = 0, before = 0;
  for (int n = 0; n < 4; ++n) {
    before = x1;
    for (int i = 0; i < all; ++i) {
      const double volts = i < slow ? 1000. * i / slow : 1000. * (all - i) / (all - slow);
      const double pull =
          stiffness * (x2 - x1 - free_strain * volts) + damping * stiffness * (v2 - v1);
      v2 -= dt * pull / mass;
      const double trial = v1 + dt * pull / foot, most = friction * dt / foot;
      v1 = trial - std::clamp(trial, -most, most);
      x1 += dt * v1;
      x2 += dt * v2;
    }
  }
  return x1 - before;
}

const std::string sawtooth =
    "1000*(mod(t, 5e-4) < 4.8e-4 ? mod(t, 5e-4)/4.8e-4 : (5e-4 - mod(t, 5e-4))/2e-5)'";

TEST(StickSlipActuator, WalksByTheStepsOfTwoMassesAndBackWithTheOtherSign) {
  for (const double coefficient : {0.2, 0.4}) {
    SCOPED_TRACE(coefficient);
    const std::string friction = fmt::format("contact.friction.coefficient={}", coefficient);
    const RunCase run = device("stick-slip-actuator", {friction});
    const auto feet = foot_after_periods(run, 5e-4, 4);
    const double step = feet[3] - feet[2];
    EXPECT_NEAR(feet[2] - feet[1], step, 1e-3 * step);
    // A rail of 15 kPa on 10 mm; the parts bend and shorten where they meet: measured 4 and 6 %.
    const double masses = step_of_two_masses(150 * coefficient);
    EXPECT_NEAR(step, masses, 0.08 * masses);
    // Without friction 1.05e-7 m, by which the foot moves in the fall: friction is felt.
    EXPECT_LT(step, 0.9 * 1.047e-7);
    const RunCase back =
        device("stick-slip-actuator", {friction, "electrode[1].voltage='-" + sawtooth});
    const auto feet_back = foot_after_periods(back, 5e-4, 4);
    EXPECT_NEAR(feet_back[3] - feet_back[2], -step, 0.01 * step);
  }
}

// Friction alone holds it: its impulse over a period of the steady walk is none, and it is
// Coulomb's.
TEST(StickSlipActuator, FrictionStaysAtItsBoundAndHasNoImpulseOverAPeriod) {
  const RunCase run = device("stick-slip-actuator");
  const Table history = run.history(), contact = run.contact();
  const auto force = history.numbers("contact_force_x");
  double impulse = 0, size = 0;
  for (std::size_t i = 1500; i < 2000; ++i) {
    impulse += force[i];
    size += std::abs(force[i]);
  }
  EXPECT_GT(size, 0);
  EXPECT_LE(std::abs(impulse), 0.01 * size);
  const auto traction = contact.numbers("tangential_traction_x"),
             bound = contact.numbers("friction_bound");
  for (std::size_t i = 0; i < traction.size(); ++i) {
    EXPECT_LE(std::abs(traction[i]), bound[i] * (1 + 1e-9));
    EXPECT_NEAR(bound[i], 3e3, 0.03 * 3e3);  // the springs hardly feel the drive
  }
  for (const double imbalance : history.numbers("energy_imbalance"))
    EXPECT_LT(std::abs(imbalance), 1e-7);
}

// As fast up as down it goes nowhere: what it does in the first period is all.
TEST(StickSlipActuator, ATriangleOfVoltageMovesItNowhere) {
  const RunCase run =
      device("stick-slip-actuator",
             {"electrode[1].voltage='1000*(1 - abs(mod(t, 5e-4)/2.5e-4 - 1))'", "time.steps=1000"});
  const auto feet = foot_after_periods(run, 5e-4, 4);
  EXPECT_LE(std::abs(feet[3] - feet[2]), 0.01 * 8.66e-8);
}

constexpr double pi = std::numbers::pi, eps0 = 8.8541878128e-12;

// Constants of PZT-5A and PZT-4 (Jaffe, Cook, Jaffe 1971).
struct Ceramic {
  double s11, s12, s13, s33, d31, d33, eps33;
};
constexpr Ceramic pzt_5a{1.64e-11,  -5.74e-12, -7.22e-12,  1.88e-11,
                         -1.71e-10, 3.74e-10,  1700 * eps0};
constexpr Ceramic pzt_4{1.23e-11, -4.05e-12, -5.31e-12, 1.55e-11, -1.23e-10, 2.89e-10, 1300 * eps0};

TEST(DiscTransducer, WithoutFrictionItIsInAUniformState) {
  const RunCase run = device("disc-transducer", {"contact.friction=\"none\""});
  constexpr double radius = 10e-3, height = 1e-3, pressure = 1e6, field = -200 / height;
  const Table contact = run.contact(), history = run.history();
  const std::size_t step = 50, nodes = 41;  // 1.25 s
  EXPECT_NEAR(contact.numbers("slip_x")[step * nodes - 1],
              radius * (pzt_5a.s13 * -pressure + pzt_5a.d31 * field), 1e-18);
  const double charge = -pi * radius * radius * (pzt_5a.eps33 * field - pzt_5a.d33 * pressure);
  EXPECT_NEAR(history.numbers("electrode_upper_charge")[step - 1] / charge, 1, 1e-11);
}

TEST(DiscTransducer, FrictionNarrowsItAsAThinDisc) {
  const RunCase run = device("disc-transducer", {"probe=[{name=\"rim\",at=[0.01,0.0005]}]"});
  constexpr double radius = 10e-3, height = 1e-3, pressure = 1e6, field = -200 / height;
  const double free = radius * (pzt_5a.s13 * -pressure + pzt_5a.d31 * field),
               rubbed = 0.2 * pressure * radius * radius * (pzt_5a.s11 + pzt_5a.s12) / (3 * height);
  const double found = read_table(run.folder() / "probe-rim.csv").numbers("u_x")[49];
  EXPECT_NEAR(found, free - rubbed, 0.005 * found);
  expect_closed_balances(run.history());
}

TEST(ShaftClamp, HasThePressureOfLamesRingWithTheStrainOfTheVoltage) {
  const RunCase run = device("shaft-clamp");
  constexpr double a = 5e-3, b = 10e-3, height = 4e-3, interference = 2e-6;
  const Table history = run.history(), rim = read_table(run.folder() / "probe-rim.csv");
  for (std::size_t n = 0; n < 4; ++n) {
    const double field = -500. * static_cast<double>(n + 1) / height;
    const double c =
        (interference / a - pzt_4.d31 * field) /
        (pzt_4.s11 * (1 / (a * a) + 1 / (b * b)) + pzt_4.s12 * (1 / (b * b) - 1 / (a * a)));
    const double force = c * (1 / (a * a) - 1 / (b * b)) * 2 * pi * a * height;
    EXPECT_NEAR(history.numbers("contact_force_x")[n] / force, 1, 5e-7);
    EXPECT_NEAR(rim.numbers("u_x")[n] / (b * (2 * pzt_4.s11 * c / (b * b) + pzt_4.d31 * field)), 1,
                1e-7);
  }
}

TEST(StackActuator, WorksAgainstItsSpringAsOneDimensionalTheorySays) {
  const RunCase run = device("stack-actuator");
  constexpr double layer = 1e-4, layers = 20, radius = 2.5e-3, pressed = 2e-7;
  const double area = pi * radius * radius, stack = area / (pzt_5a.s33 * layers * layer),
               spring = 2e12 * area;
  const Table history = run.history();
  for (std::size_t n = 0; n < 4; ++n) {
    const double volts = 25. * static_cast<double>(n + 1);
    const double end =
        (layers * pzt_5a.d33 * volts - pressed * spring / stack) / (1 + spring / stack);
    const double force = spring * (end + pressed);
    EXPECT_NEAR(history.numbers("contact_force_y")[n] / -force, 1, 1e-10);
    EXPECT_NEAR(history.numbers("electrode_drive_charge")[n] /
                    (layers * (area * pzt_5a.eps33 * volts / layer - pzt_5a.d33 * force)),
                1, 1e-10);
  }
}

// 3 d31 V L^2 / (2 h^2) without what bending adds to the field.
TEST(BimorphInPlaneStress, BendsByTheClosedFormWithoutCoupling) {
  const RunCase run = device("bimorph-plane-stress");
  const double tip = read_table(run.folder() / "probe-tip.csv").numbers("u_y").back();
  EXPECT_NEAR(tip, 3.29e-5, 0.003 * 3.29e-5);
  EXPECT_NEAR(tip, 1.5 * 2.2e-11 * 100 * 0.1 * 0.1 / 1e-6, 0.005 * tip);
}

}  // namespace
}  // namespace tourmaline::verified
