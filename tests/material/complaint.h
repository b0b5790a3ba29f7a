#pragma once

#include <string>

#include "material/constants.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::material {

/// What is said against a material, or nothing.
inline std::string complaint(const casefile::MaterialCase &asked) {
  try {
    constants_of(asked);
  } catch (const CaseError &error) {
    return error.what();
  }
  return "";
}

}  // namespace tourmaline::material
