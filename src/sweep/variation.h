#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tourmaline::sweep {

/// A key of the case file and the values that it takes, what one `--vary` says.
struct Variation {
  std::string key;                  ///< its dotted path
  std::vector<std::string> values;  ///< each as after `--set key=`
  bool logarithmic = false;         ///< whether they are spaced so
};

/// Reads KEY=V1,V2,... or KEY=lin:A:B:N or KEY=log:A:B:N, N values from A to B. Throws CaseError.
Variation read_variation(const std::string &assignment);

/// The same for all; a key may be varied once. Throws CaseError.
std::vector<Variation> read_variations(const std::vector<std::string> &assignments);

/// The finite number that a text is, apart from blanks around it.
std::optional<double> number_in(const std::string &text);

/// Throws CaseError where `--set` gives a key that is varied: one of both would mean nothing.
void require_not_set(const std::vector<Variation> &variations,
                     const std::vector<std::string> &overrides);

}  // namespace tourmaline::sweep
