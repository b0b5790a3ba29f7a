#include <fmt/format.h>

#include <algorithm>

#include "schema_parts.h"

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

std::string all_regions(const MeshCase &mesh) {
  if (!mesh.content)
    return "";
  std::string all;
  for (const std::string &name : mesh.content->regions.names)
    all += (all.empty() ? "\"" : ", \"") + name + "\"";
  return all;
}

Key key_of_names(const MeshCase &mesh) {
  Key key{.name = "on", .description = "region, or list of regions, of a mesh file"};
  if (mesh.content && !mesh.content->cells.empty()) {  // that of a finished run has facets alone
    key.choices = mesh.content->regions.names;
    key.no_choices = "the mesh file names no region: put its " +
                     std::string(mesh.content->dimension == 2 ? "surfaces" : "volumes") +
                     " into physical groups, or say by `where` which cells are meant";
  }
  key.choices_words = "the names of a mesh file";
  key.default_words = "none";
  key.used = with("mesh.file", !mesh.box && !mesh.annulus);
  return key;
}

void declare(Visitor &v, RegionCase &region, const MeshCase &mesh) {
  v.place(region.place);
  v.optional({.name = "name",
              .description = "by which probes know it; where it is not given, the names of `on`, "
                             "joined by +"},
             region.name);
  v.key(key_of_names(mesh), &region.on);
  v.optional({.name = "where",
              .description = "formula: a cell belongs to the region when this is not 0 at its "
                             "centre, as with \"y > 0.01\"",
              .constant_in_time = true},
             region.inside);
  v.exactly_one({"on", "where"});
  v.check("", [&]() -> std::string {
    if (region.on.empty() == !region.inside)
      return "give either `on`, a name in the mesh file, or `where`, a formula";
    return "";
  });
  v.table({.name = "material",
           .description = "What the region is made of; the keys are those of [material]",
           .required = true},
          [&](Visitor &inner) { declare(inner, region.material, dimension_of(mesh)); });
}

// A region of the mesh that no entry names has no material.
std::string uncovered_complaint(const std::vector<RegionCase> &regions, const MeshCase &mesh) {
  if (!mesh.content || regions.empty())
    return "";
  for (const RegionCase &region : regions)
    if (region.inside)
      return "";  // to be seen cell by cell
  for (const std::string &name : mesh.content->regions.names)
    if (std::none_of(regions.begin(), regions.end(), [&](const RegionCase &region) {
          return std::find(region.on.begin(), region.on.end(), name) != region.on.end();
        }))
      return fmt::format("no entry says what \"{}\" is made of; the mesh has the regions {}", name,
                         all_regions(mesh));
  return "";
}

void declare_regions(Visitor &v, std::vector<RegionCase> &regions, const MeshCase &mesh) {
  const Key key = {.name = "region",
                   .description =
                       "A part of the body with a material of its own, instead of [material]. "
                       "Every cell must be in exactly one region; where regions meet they are "
                       "bonded"};
  v.entries(key, regions,
            [&](Visitor &inner, RegionCase &region) { declare(inner, region, mesh); });
  v.check("region", [&] { return uncovered_complaint(regions, mesh); });
}

}  // namespace

void declare_composition(Visitor &v, Case &c) {
  declare_regions(v, c.regions, c.mesh);
  const Key key = {
      .name = "material",
      .description =
          "What the whole body is made of: library = an entry of the library, constants, or both. "
          "Constants are those of (1)-(3) in crystal axes, sigma = F eps(u) - "
          "E^T E(phi) - M theta, D = E eps(u) + beta E(phi) + P theta, q = -K grad theta, with "
          "E(phi) = -grad phi. Each of them may be given in the stress-charge form (c, e, "
          "permittivity at constant strain) or in the strain-charge form of data sheets (s, d, "
          "permittivity at constant stress), from which the first is computed. What is not given "
          "is taken from the library's entry; without an entry it must be given, but a material "
          "without "
          "any piezoelectric constant, without thermal expansion or without pyroelectric constant "
          "is not "
          "piezoelectric, does not expand, is not pyroelectric (`tourmaline check` says so); of "
          "each of "
          "these kinds all constants of the class are given or none",
      .required = c.regions.empty()};
  const bool given = v.given(key, c.regions.empty());
  if (given)
    v.table(key, [&](Visitor &inner) { declare(inner, c.material, c.dimension); });
  v.exactly_one({"region", "material"});
  v.check("material", [&] {
    return given && !c.regions.empty() ? "stands beside [[region]]; a body has either of them" : "";
  });
}

}  // namespace tourmaline::casefile
