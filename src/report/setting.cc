#include "report/setting.h"

#include <algorithm>
#include <array>
#include <set>

#include "case/probes.h"

namespace tourmaline::report {
namespace {

struct Kind {
  const char *name;
  Colour colour;
};

const std::array<Kind, 4> kinds{{{"contact", {0xd5, 0x5e, 0x00}},
                                 {"displacement", {0x00, 0x72, 0xb2}},
                                 {"traction", {0x00, 0x9e, 0x73}},
                                 {"free", {0x8a, 0x8f, 0x98}}}};

const std::array<Colour, 5> further{{{0xb5, 0x62, 0x9b},
                                     {0xc2, 0x84, 0x00},
                                     {0x3f, 0x9f, 0xd6},
                                     {0x7a, 0x6a, 0xc8},
                                     {0x8a, 0x8f, 0x98}}};

std::size_t rank_of(const Boundary &boundary) {
  return std::find_if(kinds.begin(), kinds.end(),
                      [&](const Kind &k) { return boundary.conditions.kind == k.name; }) -
         kinds.begin();
}

bool used(const std::vector<SettingGroup> &groups, const Colour &colour) {
  return std::any_of(groups.begin(), groups.end(),
                     [&](const SettingGroup &g) { return g.colour == colour; });
}

Colour colour_for(const Boundary &boundary, const std::vector<SettingGroup> &groups) {
  const bool said = !boundary.conditions.texts.empty();
  const std::size_t rank = rank_of(boundary);
  const bool has_own = rank < 3 || (rank == 3 && !said);
  if (has_own && !used(groups, kinds[rank].colour))
    return kinds[rank].colour;
  for (const Colour &colour : further)
    if (!used(groups, colour))
      return colour;
  return further.back();
}

}  // namespace

std::vector<SettingGroup> groups_of(const Result &result) {
  std::vector<const Boundary *> ordered;
  for (const Boundary &boundary : result.boundaries)
    ordered.push_back(&boundary);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](auto *a, auto *b) { return rank_of(*a) < rank_of(*b); });
  std::vector<SettingGroup> groups;
  for (const Boundary *boundary : ordered) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const SettingGroup &group) {
      const Conditions &other = group.boundaries.front()->conditions;
      return other.kind == boundary->conditions.kind && other.texts == boundary->conditions.texts;
    });
    if (same != groups.end())
      same->boundaries.push_back(boundary);
    else
      groups.push_back({colour_for(*boundary, groups), {boundary}});
  }
  return groups;
}

bool has_unnamed_facets(const Result &result) {
  std::set<std::vector<std::uint32_t>> named;  // a facet may have several names
  for (const Boundary &boundary : result.boundaries)
    for (std::vector<std::uint32_t> facet : boundary.facets) {
      std::sort(facet.begin(), facet.end());
      named.insert(std::move(facet));
    }
  return !result.boundaries.empty() && named.size() < result.skin.n_facets;
}

std::string name_of_unnamed(const Result &result) {
  return result.dimension == 2 ? "other sides" : "other faces";
}

std::vector<Part> parts_of(const Result &result) {
  std::vector<Part> parts;
  if (!result.asked || result.asked->regions.size() < 2)
    return parts;
  for (const casefile::RegionCase &region : result.asked->regions)
    parts.push_back(
        {casefile::listed_as(region), region.material.library.value_or("material of the case")});
  return parts;
}

}  // namespace tourmaline::report
