#include "case/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "case/place_of_key.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

// File systems have names of up to 255 bytes, in which "probe-" and ".csv.part" have to fit.
constexpr std::size_t longest_name = 100;

[[noreturn]] void fail(const ProbeCase &probe, const std::string &reason) {
  throw CaseError(fmt::format("{} = {}: {}", place_of_key(probe.places, probe.where, "name"),
                              shortened(toml_text(probe.name)), reason));
}

bool may_be_in_a_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

}  // namespace

void check_probes(const Case &asked) {
  std::map<std::string, std::string> first;  // where the name was said first
  for (const ProbeCase &probe : asked.probes) {
    if (probe.name.empty() || !std::all_of(probe.name.begin(), probe.name.end(), may_be_in_a_name))
      fail(probe, "must consist of letters, digits, _, - and ., as a file is named by it");
    if (probe.name.size() > longest_name)
      fail(probe, fmt::format("is the name of a file, and may have {} letters; it has {}",
                              longest_name, probe.name.size()));
    const auto [other, is_new] =
        first.try_emplace(probe.name, place_of_key(probe.places, probe.where, "name"));
    if (!is_new)
      fail(probe, "this name has already been given at " + other->second);
  }
}

}  // namespace tourmaline::casefile
