#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tourmaline/case/formula.h"

namespace tourmaline::casefile {

/// One [[boundary]] entry. What is not given is the natural condition.
struct BoundaryCase {
  std::vector<std::string> on;
  std::string where;  ///< file and line of the entry, for error texts
  /// an entry is empty where the component is "free" [m]
  std::optional<std::vector<std::optional<Formula>>> displacement;
  std::optional<Formula> potential;       ///< [V]
  std::optional<Formula> temperature;     ///< [K], difference to the reference temperature
  std::optional<FormulaVector> traction;  ///< sigma nu = f_N [N/m^2]
  std::optional<Formula> surface_charge;  ///< D.nu = phi_b [C/m^2]
  std::optional<Formula> heat_flux;       ///< q.nu [W/m^2], positive leaves the body
};

/// One [[electrode]] entry: boundaries, and facets between cells, that share one potential. Of
/// plane bodies charges, resistances and capacitances are those of one metre of thickness.
struct ElectrodeCase {
  std::string name;
  std::vector<std::string> on;    ///< names of the boundary, or of facets inside
  std::optional<Formula> inside;  ///< `where`: not 0 at all corners of a facet between cells
  std::string where;
  std::map<std::string, std::string> places;  ///< of its keys: file, line and key
  /// [V] of the electrode; beside a resistor or capacitor of their other end, 0 when not given
  std::optional<Formula> voltage;
  std::optional<Formula> charge;    ///< total charge on the electrode [C]
  std::optional<double> resistor;   ///< [ohm]
  std::optional<double> capacitor;  ///< [F], parallel to the resistor
  std::optional<std::string> to;    ///< electrode at the other end of resistor and capacitor

  bool is_loaded() const { return resistor || capacitor; }
  /// Whether the potential is given, and not an unknown of the step.
  bool is_driven() const { return voltage && !is_loaded(); }
};

}  // namespace tourmaline::casefile
