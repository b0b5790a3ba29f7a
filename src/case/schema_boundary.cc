#include <fmt/format.h>

#include <algorithm>

#include "case/sides.h"
#include "schema_parts.h"
#include "sense.h"
#include "tourmaline/case/boundary_case.h"
#include "tourmaline/case/mesh_case.h"

namespace tourmaline::casefile {

Key on_sides(const std::string &description, const MeshCase &mesh) {
  std::vector<std::string> names = side_names(mesh);
  if (mesh.content)  // a complaint of their own awaits those that lie inside
    for (const std::string &name : mesh.content->inner_names())
      names.push_back(name);
  const std::string none = "the mesh file names no boundary: put its " +
                           std::string(dimension_of(mesh) == 2 ? "curves" : "surfaces") +
                           " into physical groups";
  return {.name = "on",
          .description = description,
          .required = true,
          .choices = names,
          .choices_words =
              "left, right, bottom, top, in 3D also front, back, of a box; inner, "
              "outer, in 3D also bottom, top, of an annulus; the names of a mesh file",
          .no_choices = mesh.content ? none : ""};
}

std::string inside_complaint(const std::vector<std::string> &on, const MeshCase &mesh) {
  if (!mesh.content)
    return "";
  const std::vector<std::string> inner = mesh.content->inner_names();
  for (const std::string &name : on)
    if (std::find(inner.begin(), inner.end(), name) != inner.end())
      return fmt::format(
          "\"{}\" lies inside the body, at least in part; conditions are possible on its boundary",
          name);
  return "";
}

Key of_whole_body(Key key, bool is_per_depth) {
  const std::string plane = key.unit == "ohm" ? "ohm m" : key.unit + "/m";
  key.unit_here = is_per_depth ? plane : key.unit;
  key.unit += " (plane bodies: " + plane + ")";
  return key;
}

namespace {

void declare_mechanics(Visitor &v, BoundaryCase &boundary, int dimension) {
  v.optional({.name = "displacement",
              .description = "prescribed displacement u; a component may be \"free\"",
              .unit = "m",
              .range = any(sense::coordinate),
              .length = one_each_axis(dimension)},
             boundary.displacement);
  v.optional({.name = "traction",
              .description =
                  "force on the body, sigma nu = f_N (8), nu the outward normal; must be 0 where "
                  "the displacement is prescribed",
              .unit = "N/m^2",
              .range = any(sense::traction),
              .length = one_each_axis(dimension)},
             boundary.traction);
}

void declare(Visitor &v, BoundaryCase &boundary, const MeshCase &mesh, int dimension) {
  v.place(boundary.where);
  v.key(on_sides("boundary, or list of boundaries, that the conditions hold on", mesh),
        &boundary.on);
  v.check("on", [&] { return inside_complaint(boundary.on, mesh); });
  declare_mechanics(v, boundary, dimension);
  v.optional({.name = "potential",
              .description = "prescribed electric potential",
              .unit = "V",
              .range = any(sense::potential)},
             boundary.potential);
  v.optional({.name = "surface_charge",
              .description = "free charge, D.nu = phi_b (11)",
              .unit = "C/m^2",
              .range = any(sense::charge)},
             boundary.surface_charge);
  v.optional({.name = "temperature",
              .description = "prescribed difference to the reference temperature",
              .unit = "K",
              .range = any(sense::temperature)},
             boundary.temperature);
  v.optional({.name = "heat_flux",
              .description = "heat flow q.nu; positive leaves the body",
              .unit = "W/m^2",
              .range = any(sense::heat_flux)},
             boundary.heat_flux);
}

void declare(Visitor &v, ElectrodeCase &electrode, const MeshCase &mesh, bool is_per_depth) {
  v.place(electrode.where);
  v.places(electrode.places);
  v.key({.name = "name",
         .description = "what its columns in history.csv are called; letters, digits, _ and -",
         .required = true},
        &electrode.name);
  Key on = on_sides(
      "boundary that the electrode covers, or list of boundaries that it joins; facets "
      "inside the body that have a name, too",
      mesh);
  on.required = false;
  on.default_words = "none";
  v.key(on, &electrode.on);
  v.optional({.name = "where",
              .description = "formula, for an electrode inside the body: it covers all facets "
                             "between cells at whose corners this is not 0, as with \"abs(y - "
                             "0.01) < 1e-6\"; alone or beside `on`",
              .constant_in_time = true},
             electrode.inside);
  v.check("", [&]() -> std::string {
    return electrode.on.empty() && !electrode.inside
               ? "give `on`, names of boundaries, or `where`, a formula for facets inside the body"
               : "";
  });
  v.optional({.name = "voltage",
              .description = "potential of the electrode over time; beside a resistor or capacitor "
                             "that of their other end, 0 when not given",
              .unit = "V",
              .range = any(sense::potential)},
             electrode.voltage);
  v.optional(of_whole_body(
                 {.name = "charge",
                  .description = "total charge on the electrode over time, -integral of D.nu; its "
                                 "potential follows",
                  .unit = "C",
                  .range = any(sense::charge)},
                 is_per_depth),
             electrode.charge);
  v.optional(
      of_whole_body(
          {.name = "resistor",
           .description = "resistance between the electrode and ground, or `voltage`, or `to`",
           .unit = "ohm",
           .range = positive(sense::resistance)},
          is_per_depth),
      electrode.resistor);
  v.optional(
      of_whole_body({.name = "capacitor",
                     .description = "capacitance between the same two, parallel to the resistor",
                     .unit = "F",
                     .range = positive(sense::capacitance)},
                    is_per_depth),
      electrode.capacitor);
  v.optional({.name = "to",
              .description = "name of the electrode that resistor and capacitor lead to, instead "
                             "of ground"},
             electrode.to);
}

}  // namespace

void declare_boundaries(Visitor &v, std::vector<BoundaryCase> &boundaries, const MeshCase &mesh,
                        int dimension) {
  const Key key = {.name = "boundary",
                   .description =
                       "Conditions on a part of the boundary. Several entries may name one "
                       "boundary as long as no field gets two conditions there. Where "
                       "nothing is said, there is no traction, charge or heat flow"};
  v.entries(key, boundaries, [&](Visitor &inner, BoundaryCase &boundary) {
    declare(inner, boundary, mesh, dimension);
  });
}

void declare_electrodes(Visitor &v, std::vector<ElectrodeCase> &electrodes, const MeshCase &mesh,
                        bool is_per_depth) {
  const Key key = {
      .name = "electrode",
      .description =
          "A conducting film on parts of the boundary or between cells: one potential all over, "
          "and no thickness. With "
          "`voltage` it is driven (0: grounded); with `charge` it floats with that "
          "charge; with a resistor or capacitor these lead to ground, to a given "
          "voltage or to another electrode; with nothing it is open and keeps its "
          "charge at the time 0. Of plane bodies charges, resistances and capacitances are "
          "those of one metre of thickness"};
  v.entries(key, electrodes, [&](Visitor &inner, ElectrodeCase &electrode) {
    declare(inner, electrode, mesh, is_per_depth);
  });
}

}  // namespace tourmaline::casefile
