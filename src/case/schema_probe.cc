#include <fmt/format.h>

#include "schema_parts.h"
#include "sense.h"
#include "tourmaline/case/mesh_case.h"
#include "tourmaline/case/probe_case.h"

namespace tourmaline::casefile {

namespace {

Key place_key(const std::string &name, const std::string &description, int dimension) {
  return {.name = name,
          .description = description,
          .unit = "m",
          .range = any(sense::coordinate),
          .length = one_each_axis(dimension)};
}

const std::string kinds =
    "`at`, a place, or `from`, `to` and `points`, a line, or `on`, boundaries, or `region`";

std::string kind_complaint(const ProbeCase &probe) {
  const bool is_line = probe.from || probe.to || probe.points;
  const int given =
      (probe.at ? 1 : 0) + (is_line ? 1 : 0) + (probe.on ? 1 : 0) + (probe.region ? 1 : 0);
  if (given != 1)
    return (given == 0 ? "does not say where it looks; give "
                       : "looks at one thing; give either ") +
           kinds;
  if (!is_line)
    return "";
  for (const auto &[name, is_given] :
       {std::pair{"from", probe.from.has_value()}, std::pair{"to", probe.to.has_value()},
        std::pair{"points", probe.points.has_value()}})
    if (!is_given)
      return fmt::format("has no `{}`; a line is from = [...], to = [...], points = 21", name);
  return *probe.from == *probe.to ? "ends where it begins; give `at` for a single place" : "";
}

void declare(Visitor &v, ProbeCase &probe, const MeshCase &mesh, int dimension,
             bool is_axisymmetric) {
  v.place(probe.where);
  v.places(probe.places);
  v.key({.name = "name",
         .description = "of its table, probe-NAME.csv; letters, digits, _, - and .",
         .required = true},
        &probe.name);
  v.optional(place_key("at",
                       "a place in the body, not deformed: displacement, potential and "
                       "temperature there, by the shape functions",
                       dimension),
             probe.at);
  v.optional(place_key("from", "where a line of places begins, its first one", dimension),
             probe.from);
  v.optional(place_key("to", "where it ends, its last one", dimension), probe.to);
  v.optional({.name = "points",
              .description = "how many places of equal distance there are on the line",
              .range = from_to(2, 100000)},
             probe.points);
  Key on = on_sides(
      "boundary, or list of boundaries, also of a contact: the force and its moment on "
      "the body, the charge and heat that leave it through them, and their area",
      mesh);
  on.required = false;
  v.optional(on, probe.on);
  v.check("on", [&] { return probe.on ? inside_complaint(*probe.on, mesh) : std::string(); });
  Key about = place_key("about", "what the moment of the force is about", dimension);
  about.default_words = "the origin";
  about.used = with("on", probe.on.has_value());
  v.key(about, &probe.about);
  v.check("about", [&]() -> std::string {
    return is_axisymmetric && !probe.about.empty()
               ? "forces of a body of revolution have no moment about a point"
               : "";
  });
  v.optional({.name = "region",
              .description =
                  "region, or list of regions, by `name` or `on` of the [[region]]s of the case: "
                  "volume, stored energies, means and extremes of the fields"},
             probe.region);
  v.one_group({{"at"}, {"from", "to", "points"}, {"on"}, {"region"}});
  v.check("", [&] { return kind_complaint(probe); });
}

}  // namespace

void declare_probes(Visitor &v, std::vector<ProbeCase> &probes, const MeshCase &mesh, int dimension,
                    bool is_axisymmetric) {
  const Key key = {.name = "probe",
                   .description =
                       "What a table of its own, probe-NAME.csv, tells in every step: "
                       "the fields at a place or along a line, "
                       "what goes through boundaries, or what a region holds"};
  v.entries(key, probes, [&](Visitor &inner, ProbeCase &probe) {
    declare(inner, probe, mesh, dimension, is_axisymmetric);
  });
}

}  // namespace tourmaline::casefile
