#pragma once

#include <map>
#include <string>
#include <vector>

#include "tourmaline/material/constants.h"

namespace tourmaline::material {

/// A built-in material of class 6mm (isotropic about axis 3): named constants in SI units with
/// source.
struct Entry {
  std::string name, source;
  std::map<std::string, double> constants;
};

const std::vector<Entry> &library();

/// Throws CaseError naming the nearest entry.
const Entry &find(const std::string &name);

/// One line an entry.
std::string describe_library();

/// All constants of one entry with units, and the expanded tensors.
std::string describe(const std::string &name);

}  // namespace tourmaline::material
