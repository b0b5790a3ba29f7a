#include "case/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "case/nearest.h"
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

// The names that regions have, and how the others get one.
std::string regions_words(const std::vector<RegionCase> &regions, const std::string &wanted) {
  std::vector<std::string> names;
  for (const RegionCase &region : regions)
    if (const std::string name = called(region); !name.empty())
      names.push_back(name);
  if (regions.empty())
    return "; the case has no [[region]]: give it one with that `name`, with `where` or, of a mesh "
           "file, with `on`; "
           "where = \"1\" is the whole body, and what gives no material has the case's";
  if (names.empty())
    return "; give the [[region]] that is meant a `name`";
  return fmt::format("; there are {}{}", fmt::join(names, ", "), did_you_mean(wanted, names));
}

void check_regions(const ProbeCase &probe, const std::vector<RegionCase> &regions) {
  if (!probe.region)
    return;
  for (const std::string &name : *probe.region) {
    const auto found = std::count_if(regions.begin(), regions.end(), [&](const RegionCase &region) {
      return !name.empty() && called(region) == name;
    });
    if (found == 1)
      continue;
    throw CaseError(fmt::format(
        "{} = {}: {}", place_of_key(probe.places, probe.where, "region"), toml_text(name),
        found == 0
            ? "no region is called so" + regions_words(regions, name)
            : fmt::format("{} regions are called so; give each a `name` of its own", found)));
  }
}

}  // namespace

std::string called(const RegionCase &region) {
  return region.name ? *region.name : fmt::format("{}", fmt::join(region.on, "+"));
}

std::string listed_as(const RegionCase &region) {
  if (!region.name && region.inside)
    return region.inside->text();
  return region.name ? *region.name : fmt::format("{}", fmt::join(region.on, ", "));
}

void check_probes(const Case &asked) {
  std::map<std::string, std::string> first;  // where the name was said first
  for (const ProbeCase &probe : asked.probes) {
    check_regions(probe, asked.regions);
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
