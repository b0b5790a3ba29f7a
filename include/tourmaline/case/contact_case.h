#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tourmaline/case/formula.h"

namespace tourmaline::casefile {

/// The response of the foundation along the normal, p = -sigma_nu >= 0 where it is not bilateral.
struct NormalCase {
  std::string law = "bilateral";  ///< bilateral | unilateral | compliance | damped
  Formula coefficient = 0;        ///< c: [N/m^(2+m)] of compliance, [N s/m^3] of damped
  double exponent = 1;            ///< m >= 1 of compliance

  bool can_open() const { return law != "bilateral"; }
  bool depends_on_rate() const { return law == "damped"; }
};

/// mu of Coulomb's law: `value` alone, or from `at_rest` to `kinetic` over `speed` or `distance`.
struct FrictionCoefficientCase {
  std::optional<Formula> value;
  std::optional<Formula> at_rest, kinetic;
  std::optional<double> speed;     ///< [m/s]
  std::optional<double> distance;  ///< [m]
};

struct FrictionCase {
  std::string law = "none";  ///< none | tresca | coulomb
  Formula bound = 0;         ///< S of Tresca's law [N/m^2]
  FrictionCoefficientCase
      coefficient;               ///< of Coulomb's, whose bound is min(cohesion + mu p, limit)
  Formula cohesion = 0;          ///< [N/m^2]
  std::optional<Formula> limit;  ///< [N/m^2]; not given: none

  bool resists() const { return law != "none"; }
};

/// coefficient (p/reference)^exponent, added to k_c.
struct PressureConductanceCase {
  Formula coefficient = 0;  ///< [W/(K m^2)], no dependence on t
  double reference = 0;     ///< > 0 [N/m^2]
  double exponent = 1;      ///< > 0
};

struct HeatExchangeCase {
  std::string law = "insulated";       ///< insulated | exchange
  Formula coefficient = 0;             ///< k_c [W/(K m^2)], no dependence on t
  Formula foundation_temperature = 0;  ///< theta_f [K], difference to the reference temperature
  std::optional<PressureConductanceCase> pressure = {};
  std::optional<double> ramp = {};  ///< opening over which k_c fades [m]
  /// of the power of friction that enters the body, 0 to 1; not given: friction makes no heat
  std::optional<double> friction_share = {};

  bool exchanges() const { return law != "insulated"; }
};

/// What is connected to a foundation that conducts, as to an electrode; with nothing it is open and
/// keeps its charge. Its charge is -integral of D.nu over the contact.
struct FoundationCircuitCase {
  std::optional<Formula> charge;    ///< [C]
  std::optional<double> resistor;   ///< [ohm]
  std::optional<double> capacitor;  ///< [F], parallel to the resistor
  Formula voltage = 0;              ///< of their other end [V]

  bool is_loaded() const { return resistor || capacitor; }
};

struct ChargeExchangeCase {
  std::string law = "insulated";  ///< insulated | exchange | leak
  Formula coefficient = 0;        ///< [F/m^2] of exchange, [S/m^2] of leak, no dependence on t
  /// phi_f [V], or what it is found from
  std::optional<Formula> foundation_potential = {};
  std::optional<FoundationCircuitCase> circuit = {};
  std::optional<double> ramp = {};  ///< opening over which the coefficient fades [m]

  bool exchanges() const { return law != "insulated"; }
};

/// One contact with a foundation. A case may have several, on boundaries of their own.
struct ContactCase {
  std::optional<std::string> name;  ///< letters, digits, _ and -
  std::vector<std::string> on;
  std::string where;
  std::map<std::string, std::string> places;  ///< of its keys: file, line and key
  Formula gap =
      0;  ///< g [m], by which body and foundation are apart along the normal; no dependence on t
  FormulaVector
      foundation_displacement;  ///< [m], one entry for each axis; empty: the foundation rests
  NormalCase normal;
  FrictionCase friction;
  HeatExchangeCase heat;
  ChargeExchangeCase electric;

  /// The key by which what crosses of heat or charge depends on the contact's state; empty: none.
  std::string crosses_by_state() const;

  /// The contact in files and texts: its name, or else those of its boundaries, "left+right".
  std::string called() const;
};

}  // namespace tourmaline::casefile
