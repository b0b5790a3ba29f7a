#pragma once

#include <map>
#include <string>
#include <vector>

#include "tourmaline/case/formula.h"

namespace tourmaline::casefile {

struct FrictionCase {
  std::string law = "none";  ///< none | tresca
  Formula bound = 0;         ///< S [N/m^2]
};

struct HeatExchangeCase {
  std::string law = "insulated";       ///< insulated | exchange
  Formula coefficient = 0;             ///< k_c [W/(K m^2)], no dependence on t
  Formula foundation_temperature = 0;  ///< theta_f [K], difference to the reference temperature
};

struct ContactCase {
  std::vector<std::string> on;
  std::string where;
  std::map<std::string, std::string> places;  ///< of its keys: file, line and key
  std::string normal = "bilateral";
  FrictionCase friction;
  HeatExchangeCase heat;
};

}  // namespace tourmaline::casefile
