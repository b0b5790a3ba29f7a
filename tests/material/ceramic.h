#pragma once

#include "tourmaline/case/case.h"

namespace tourmaline::verified {

/// A ceramic as a data sheet has it, in Pa and C/m^2.
inline casefile::MaterialCase ceramic() {
  casefile::MaterialCase asked;
  asked.constants = {{"c11", 127e9},
                     {"c12", 80e9},
                     {"c13", 85e9},
                     {"c33", 117e9},
                     {"c44", 23e9},
                     {"e31", -6.6},
                     {"e33", 23.2},
                     {"e15", 17},
                     {"eps11", 1704},
                     {"eps33", 1434},
                     {"k11", 1.5},
                     {"k33", 1.5},
                     {"density", 7500},
                     {"specific_heat", 420},
                     {"reference_temperature", 293}};
  return asked;
}

}  // namespace tourmaline::verified
