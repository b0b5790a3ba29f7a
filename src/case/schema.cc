#include "tourmaline/case/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tourmaline/case/interval.h"
#include "tourmaline/case/sides.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

bool Range::contains(double number) const {
  return std::isfinite(number) && (low_allowed ? number >= low : number > low) &&
         (high_allowed ? number <= high : number < high);
}

std::string Range::words() const {
  const std::string lower = fmt::format("{} {}", low_allowed ? ">=" : ">", low);
  const std::string upper = fmt::format("{} {}", high_allowed ? "<=" : "<", high);
  if (std::isfinite(low) && std::isfinite(high))
    return lower + " and " + upper;
  return std::isfinite(low) ? lower : std::isfinite(high) ? upper : "";
}

Range positive() {
  return {.low = 0, .low_allowed = false};
}
Range not_negative() {
  return {.low = 0};
}
Range at_least(double low) {
  return {.low = low};
}
Range from_to(double low, double high) {
  return {.low = low, .high = high};
}

Length one_each_axis(int dimension) {
  return {{dimension},
          "one for each axis",
          fmt::format("the shape of its cells makes the case {}-dimensional", dimension)};
}

int dimension_of(CellShape shape) {
  return shape == CellShape::triangle || shape == CellShape::quadrilateral ? 2 : 3;
}

int dimension_of(const MeshCase &mesh) {
  if (mesh.annulus)
    return dimension_of(mesh.annulus->cell);
  if (mesh.content)
    return mesh.content->dimension;
  return mesh.box ? dimension_of(mesh.box->cell) : 2;
}

const char *name_of(CellShape shape) {
  constexpr const char *names[] = {"triangle", "quadrilateral", "tetrahedron", "hexahedron"};
  return names[static_cast<int>(shape)];
}

CellShape shape_named(const std::string &name) {
  for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral,
                                CellShape::tetrahedron, CellShape::hexahedron})
    if (name == name_of(shape))
      return shape;
  throw CaseError("there is no cell shape \"" + name + "\"");
}

namespace {

std::string corners_complaint(const Box &box) {
  for (std::size_t i = 0; i < box.max.size(); ++i) {
    if (!(box.max[i] > box.min[i]))
      return fmt::format("entry {} must be greater than that of min, which is {}", i, box.min[i]);
    // Below this the corners of a cell are the same numbers.
    const double size = (box.max[i] - box.min[i]) / box.cells[i];
    const double far = std::max(std::abs(box.min[i]), std::abs(box.max[i]));
    if (!std::isfinite(size) || size < 1e-10 * far)
      return fmt::format(
          "entry {} and that of min, {}, make cells of {} m, which double precision "
          "cannot tell apart",
          i, box.min[i], size);
  }
  return "";
}

std::string cells_complaint(const Box &box, int degree) {
  double unknowns = static_cast<double>(box.cells.size()) + 2;
  for (const int cells : box.cells)
    unknowns *= static_cast<double>(degree) * cells + 1;
  if (unknowns < std::numeric_limits<int>::max())
    return "";
  return fmt::format("makes {:.3g} unknowns; at most {} are possible", unknowns,
                     std::numeric_limits<int>::max());
}

// Nodes that are closer than 1e-9 of the largest extent count as one place; graded_line makes no
// cell smaller than a uniform one over the grading.
std::string grading_complaint(const Box &box) {
  double extent = 0;
  for (std::size_t i = 0; i < box.max.size(); ++i)
    extent = std::max(extent, box.max[i] - box.min[i]);
  for (const Side &side : sides(static_cast<int>(box.max.size())))
    if (const auto given = box.grading.find(side.name); given != box.grading.end()) {
      const double uniform = (box.max[side.axis] - box.min[side.axis]) / box.cells[side.axis];
      if (uniform / given->second < 1e-8 * extent)
        return fmt::format(
            "{} = {} makes cells too small to tell their corners apart; at most {:.3g}", side.name,
            given->second, std::max(1., 1e8 * uniform / extent));
    }
  return "";
}

void declare_grading(Visitor &v, Box &box) {
  for (const Side &side : sides(dimension_of(box.cell))) {
    std::optional<double> value;
    if (const auto given = box.grading.find(side.name); given != box.grading.end())
      value = given->second;
    v.optional({.name = side.name,
                .description = "size of the largest cells along this axis over that at the " +
                               side.name + " side",
                .range = at_least(1),
                .default_words = "1"},
               value);
    if (value)
      box.grading[side.name] = *value;
  }
}

void declare(Visitor &v, Box &box, int degree) {
  std::string cell = name_of(box.cell);
  v.key({.name = "cell",
         .description = "shape of the cells, which says also whether the case is two- or "
                        "three-dimensional; simplices come from splitting squares and cubes",
         .choices = {"triangle", "quadrilateral", "tetrahedron", "hexahedron"}},
        &cell);
  box.cell = shape_named(cell);
  const Length axes = one_each_axis(dimension_of(box.cell));
  v.key({.name = "min",
         .description = "corner where the coordinates are least",
         .unit = "m",
         .required = true,
         .length = axes},
        &box.min);
  v.key({.name = "max",
         .description = "corner where the coordinates are greatest",
         .unit = "m",
         .required = true,
         .length = axes},
        &box.max);
  v.key({.name = "cells",
         .description = "intervals along each axis",
         .required = true,
         .range = at_least(1),
         .length = axes},
        &box.cells);
  v.table({.name = "grading",
           .description =
               "Makes the cells smaller towards sides, smoothly; in 3D there are front and back "
               "too. A number says how many times smaller cells are at that side than where they "
               "are largest along the same axis, as `cells` grows; 1 is uniform. Opposite sides "
               "may both be named. The vertices are the images of equidistant points under a map "
               "that does not depend on `cells`, so doubling `cells` keeps them and divides every "
               "interval in two"},
          [&](Visitor &inner) { declare_grading(inner, box); });
  v.check("max", [&] { return corners_complaint(box); });
  v.check("cells", [&] { return cells_complaint(box, degree); });
  v.check("grading", [&] { return grading_complaint(box); });
}

std::string radii_complaint(const Annulus &ring) {
  if (!(ring.outer > ring.inner))
    return fmt::format("must be greater than inner, which is {}", ring.inner);
  if (ring.outer - ring.inner < 1e-8 * ring.outer * ring.cells[0])
    return "the wall is too thin to tell the corners of its cells apart";
  return "";
}

std::string cells_complaint(const Annulus &ring, int degree) {
  // With fewer the facets of a node differ too much to have one normal.
  if (constexpr int least = 8; ring.cells[1] < least)
    return fmt::format("entry 1, the intervals around, must be at least {}", least);
  double unknowns = static_cast<double>(ring.cells.size()) + 2;
  for (const int cells : ring.cells)
    unknowns *= static_cast<double>(degree) * cells + 1;
  if (unknowns < std::numeric_limits<int>::max())
    return "";
  return fmt::format("makes {:.3g} unknowns; at most {} are possible", unknowns,
                     std::numeric_limits<int>::max());
}

void declare(Visitor &v, Annulus &ring, int degree) {
  std::string cell = name_of(ring.cell);
  v.key({.name = "cell",
         .description = "shape of the cells; triangles and quadrilaterals make a ring, tetrahedra "
                        "and hexahedra a tube",
         .choices = {"triangle", "quadrilateral", "tetrahedron", "hexahedron"}},
        &cell);
  ring.cell = shape_named(cell);
  const bool tube = dimension_of(ring.cell) == 3;
  v.key({.name = "inner",
         .description = "inner radius",
         .unit = "m",
         .required = true,
         .range = positive()},
        &ring.inner);
  v.key({.name = "outer",
         .description = "outer radius",
         .unit = "m",
         .required = true,
         .range = positive()},
        &ring.outer);
  v.key({.name = "height",
         .description = "length of the tube along z",
         .unit = "m",
         .required = true,
         .range = positive(),
         .used = tube,
         .used_with = "cell = \"tetrahedron\" or \"hexahedron\""},
        &ring.height);
  v.key({.name = "cells",
         .description = "intervals along the radius, around and, of a tube, along z",
         .required = true,
         .range = at_least(1),
         .length = {{tube ? 3 : 2},
                    "along the radius, around, of a tube along z",
                    fmt::format("mesh.annulus.cell makes the case {}-dimensional", tube ? 3 : 2)}},
        &ring.cells);
  v.check("outer", [&] { return radii_complaint(ring); });
  v.check("cells", [&] { return cells_complaint(ring, degree); });
}

// Where the file has no name, nobody could give a condition.
std::string unnamed_complaint(const MeshCase &mesh) {
  if (!mesh.content || mesh.unnamed != "error")
    return "";
  const MeshFile &file = *mesh.content;
  std::vector<std::size_t> unnamed;
  for (std::size_t facet = 0; facet < file.n_facets(); ++facet)
    if (!file.inside[facet] && file.boundaries.set_of[facet] == 0)
      unnamed.push_back(facet);
  if (unnamed.empty())
    return "";
  const auto &p = file.points[file.facets[unnamed.front() * file.vertices_per_facet()]];
  return fmt::format(
      "{} of the {} facets of the boundary have no name, one of them at ({:g}, {:g}, {:g}), so "
      "that "
      "no condition can be given there. Put them into a physical group, or say mesh.unnamed = "
      "\"natural\": no traction, no charge and no heat flow there",
      unnamed.size(), std::count(file.inside.begin(), file.inside.end(), false), p[0], p[1], p[2]);
}

void declare_file(Visitor &v, MeshCase &mesh) {
  const std::string used_with = "mesh.file";
  v.optional(
      {.name = "file",
       .description =
           "mesh or geometry, found from the folder of the case. Gmsh's .msh (2.2 or 4.1, text or "
           "binary; triangles, quadrilaterals, tetrahedra or hexahedra of order 1; a plane body "
           "lies in z = 0): physical groups name boundaries and regions, a group without a name "
           "goes by its number. Gmsh's .geo, and .step, .iges, .brep from CAD, are meshed with "
           "simplices; faces and solids from CAD go by their labels or by \"surface 1\", "
           "\"volume 1\", ... (`tourmaline check` lists them with their places)"},
      mesh.file);
  const bool file = mesh.file.has_value();
  v.optional({.name = "size",
              .description = "size of the largest cells of a geometry; required for .step, .iges "
                             "and .brep",
              .unit = "m",
              .range = positive(),
              .used = file,
              .used_with = used_with},
             mesh.size);
  v.key({.name = "scale",
         .description = "the unit of length of the file, 1e-3 when it is in millimetres; .step and "
                        ".iges know theirs and come in metres",
         .unit = "m",
         .range = positive(),
         .used = file,
         .used_with = used_with},
        &mesh.scale);
  v.key({.name = "unnamed",
         .description = "what facets of the boundary without a name are; error: a mistake; "
                        "natural: free of traction, charge and heat flow",
         .choices = {"error", "natural"},
         .used = file,
         .used_with = used_with},
        &mesh.unnamed);
}

void declare(Visitor &v, MeshCase &mesh) {
  declare_file(v, mesh);
  v.key({.name = "degree",
         .description = "of the finite elements for all fields",
         .range = from_to(1, 2)},
        &mesh.degree);
  const Key box = {.name = "box",
                   .description =
                       "A rectangle or cuboid whose sides are parallel to the axes; its "
                       "sides are named left, right (least and greatest x), bottom, top "
                       "(2D: y, 3D: z) and in 3D front, back (y)",
                   .optional = true};
  if (v.given(box, mesh.box.has_value())) {
    if (!mesh.box)
      mesh.box.emplace();
    v.table(box, [&](Visitor &inner) { declare(inner, *mesh.box, mesh.degree); });
  }
  const Key annulus = {.name = "annulus",
                       .description =
                           "The ring between two circles about the origin, in 3D a tube along z "
                           "from z = 0 on; its sides are named inner, outer and in 3D bottom, "
                           "top. The corners of the cells lie on circles, edges are straight",
                       .optional = true};
  if (v.given(annulus, mesh.annulus.has_value())) {
    if (!mesh.annulus)
      mesh.annulus.emplace();
    v.table(annulus, [&](Visitor &inner) { declare(inner, *mesh.annulus, mesh.degree); });
  }
  v.check("", [&] {
    return mesh.box || mesh.annulus || mesh.file
               ? ""
               : "no mesh; give mesh.box = { min, max, cells, cell } or mesh.annulus = { inner, "
                 "outer, cells, cell }";
  });
  v.check("annulus", [&] {
    return mesh.box && mesh.annulus
               ? "both mesh.box and mesh.annulus are given; a case has one mesh"
               : "";
  });
  v.check("file", [&] {
    if ((mesh.box || mesh.annulus) && mesh.file)
      return mesh.box ? "both mesh.box and mesh.file are given; a case has one mesh"
                      : "both mesh.annulus and mesh.file are given; a case has one mesh";
    return "";
  });
  if (mesh.file)
    v.locate("file", *mesh.file);
  v.load(mesh);
  v.check("file", [&] { return unnamed_complaint(mesh); });
}

std::string all_regions(const MeshCase &mesh) {
  if (!mesh.content)
    return "";
  std::string all;
  for (const std::string &name : mesh.content->regions.names)
    all += (all.empty() ? "\"" : ", \"") + name + "\"";
  return all;
}

void declare(Visitor &v, RegionCase &region, const MeshCase &mesh) {
  v.place(region.place);
  const Key on = {
      .name = "on",
      .description = "region, or list of regions, of a mesh file",
      .choices = mesh.content ? mesh.content->regions.names : std::vector<std::string>{},
      .choices_words = "the names of a mesh file",
      .default_words = "none",
      .used = !mesh.box && !mesh.annulus,
      .used_with = "mesh.file"};
  v.key(on, &region.on);
  v.optional({.name = "where",
              .description = "formula: a cell belongs to the region when this is not 0 at its "
                             "centre, as with \"y > 0.01\"",
              .constant_in_time = true},
             region.inside);
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
  regions.resize(static_cast<std::size_t>(v.count(key, static_cast<int>(regions.size()))));
  for (std::size_t i = 0; i < regions.size(); ++i)
    v.entry(key, static_cast<int>(i), [&](Visitor &inner) { declare(inner, regions[i], mesh); });
  v.check("region", [&] { return uncovered_complaint(regions, mesh); });
}

void declare(Visitor &v, TimeCase &time) {
  v.key({.name = "end",
         .description = "time at which the simulation ends; it begins at 0",
         .unit = "s",
         .required = true,
         .range = positive()},
        &time.end);
  v.key({.name = "steps",
         .description = "number of equal time steps (backward Euler)",
         .required = true,
         .range = at_least(1)},
        &time.steps);
}

Key on_sides(const std::string &description, const MeshCase &mesh) {
  std::vector<std::string> names = side_names(mesh);
  if (mesh.content)  // a complaint of their own awaits those that lie inside
    for (const std::string &name : mesh.content->inner_names())
      names.push_back(name);
  return {.name = "on",
          .description = description,
          .required = true,
          .choices = names,
          .choices_words =
              "left, right, bottom, top, in 3D also front, back, of a box; inner, "
              "outer, in 3D also bottom, top, of an annulus; the names of a mesh file"};
}

// Of names in a mesh file that lie inside, where a condition would mean something else.
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

void declare_mechanics(Visitor &v, BoundaryCase &boundary, int dimension) {
  v.optional({.name = "displacement",
              .description = "prescribed displacement u; a component may be \"free\"",
              .unit = "m",
              .length = one_each_axis(dimension)},
             boundary.displacement);
  v.optional({.name = "traction",
              .description =
                  "force on the body, sigma nu = f_N (8), nu the outward normal; must be 0 where "
                  "the displacement is prescribed",
              .unit = "N/m^2",
              .length = one_each_axis(dimension)},
             boundary.traction);
}

void declare(Visitor &v, BoundaryCase &boundary, const MeshCase &mesh, int dimension) {
  v.place(boundary.where);
  v.key(on_sides("boundary, or list of boundaries, that the conditions hold on", mesh),
        &boundary.on);
  v.check("on", [&] { return inside_complaint(boundary.on, mesh); });
  declare_mechanics(v, boundary, dimension);
  v.optional({.name = "potential", .description = "prescribed electric potential", .unit = "V"},
             boundary.potential);
  v.optional(
      {.name = "surface_charge", .description = "free charge, D.nu = phi_b (11)", .unit = "C/m^2"},
      boundary.surface_charge);
  v.optional({.name = "temperature",
              .description = "prescribed difference to the reference temperature",
              .unit = "K"},
             boundary.temperature);
  v.optional({.name = "heat_flux",
              .description = "heat flow q.nu; positive leaves the body",
              .unit = "W/m^2"},
             boundary.heat_flux);
}

void declare(Visitor &v, FrictionCase &friction) {
  v.key({.name = "law",
         .description = "none: the foundation is slippery; tresca: the tangential traction stays "
                        "below a given bound, and slip is opposed by it (9)",
         .choices = {"none", "tresca"},
         .foreseen = {"coulomb", "slip_rate"}},
        &friction.law);
  v.key({.name = "bound",
         .description = "friction bound S of Tresca's law (9)",
         .unit = "N/m^2",
         .required = true,
         .range = not_negative(),
         .used = friction.law == "tresca",
         .used_with = "law = \"tresca\""},
        &friction.bound);
}

void declare(Visitor &v, HeatExchangeCase &heat) {
  v.key({.name = "law",
         .description = "insulated: no heat crosses; exchange: q.nu = k_c (theta - theta_f) (13)",
         .choices = {"insulated", "exchange"},
         .foreseen = {"pressure_dependent", "frictional_heating"}},
        &heat.law);
  const bool exchange = heat.law == "exchange";
  const std::string used_with = "law = \"exchange\"";
  v.key({.name = "coefficient",
         .description = "coefficient of heat exchange k_c (13)",
         .unit = "W/(K m^2)",
         .required = true,
         .range = not_negative(),
         .constant_in_time = true,
         .used = exchange,
         .used_with = used_with},
        &heat.coefficient);
  v.key({.name = "foundation_temperature",
         .description = "temperature theta_f of the foundation (13), difference to the reference "
                        "temperature",
         .unit = "K",
         .required = true,
         .used = exchange,
         .used_with = used_with},
        &heat.foundation_temperature);
}

void declare(Visitor &v, ContactCase &contact, const MeshCase &mesh) {
  v.place(contact.where);
  v.key(on_sides("boundary, or list of boundaries, in contact with the foundation", mesh),
        &contact.on);
  v.check("on", [&] { return inside_complaint(contact.on, mesh); });
  v.key({.name = "normal",
         .description = "bilateral: contact is never lost, u_nu = 0 (9)",
         .choices = {"bilateral"},
         .foreseen = {"signorini", "normal_compliance", "damped_response"}},
        &contact.normal);
  v.refuse("charge", "not available in this version; no charge crosses the contact boundary");
  v.table({.name = "friction", .description = "The tangential contact law"},
          [&](Visitor &inner) { declare(inner, contact.friction); });
  v.table({.name = "heat", .description = "The heat flow between body and foundation"},
          [&](Visitor &inner) { declare(inner, contact.heat); });
}

void declare_augmented_lagrangian(Visitor &v, SolverCase &solver) {
  const bool monolithic = solver.method == "monolithic";
  const std::string used_with = "method = \"monolithic\"";
  const std::string from_stiffness = "from the stiffness of the body at the contact";
  v.key({.name = "multiplier",
         .description = "where the contact multipliers live; nodal: at the contact nodes, with "
                        "lumped weights; piecewise-constant: on the facets (section 3.1), with "
                        "the facet means of u_nu and du_tau",
         .choices = {"nodal", "piecewise-constant"},
         .used = monolithic,
         .used_with = used_with},
        &solver.multiplier);
  v.optional({.name = "r_normal",
              .description = "r_nu of the augmented Lagrangian (40); it changes the number of "
                             "iterations, not the solution",
              .unit = "N/m^3",
              .range = positive(),
              .default_words = from_stiffness,
              .used = monolithic,
              .used_with = used_with},
             solver.r_normal);
  v.optional({.name = "r_tangential",
              .description = "r_tau of the augmented Lagrangian (41), which multiplies the slip "
                             "rate du_tau / k; it changes the number of iterations, not the "
                             "solution",
              .unit = "N s/m^3",
              .range = positive(),
              .default_words = from_stiffness,
              .used = monolithic,
              .used_with = used_with},
             solver.r_tangential);
}

void declare(Visitor &v, SolverCase &solver) {
  v.key(
      {.name = "method",
       .description = "condensed: one factorisation for all steps, Newton iteration on the contact "
                      "boundary; monolithic: Newton iteration on all unknowns, as in the paper",
       .choices = {"condensed", "monolithic"}},
      &solver.method);
  v.key({.name = "body",
         .description =
             "how the body's linear equations are solved. direct: one factorisation; iterative: "
             "preconditioned Krylov iteration, for bodies in three dimensions that are too large "
             "for a factorisation; automatic: direct where its estimated memory is at most half of "
             "what is available",
         .choices = {"automatic", "direct", "iterative"},
         .used = solver.method == "condensed",
         .used_with = "method = \"condensed\""},
        &solver.body);
  v.key(
      {.name = "linear_tolerance",
       .description = "at which the iterative solution of the body's equations stops: norm of the "
                      "residual over that of the largest contribution, in each field",
       .range = {.low = 0, .high = 1e-3, .low_allowed = false},
       .used = solver.body != "direct",
       .used_with = "body = \"iterative\" or \"automatic\""},
      &solver.linear_tolerance);
  v.key({.name = "tolerance",
         .description = "at which the contact iteration stops: natural residual divided by the "
                        "largest nodal force",
         .range = {.low = 0, .high = 1, .low_allowed = false, .high_allowed = false}},
        &solver.tolerance);
  v.key({.name = "max_iterations",
         .description = "Newton iterations in one step after which the run fails",
         .range = at_least(1)},
        &solver.max_iterations);
  v.key({.name = "threads", .description = "of OpenBLAS and OpenMP", .range = from_to(1, 1024)},
        &solver.threads);
  declare_augmented_lagrangian(v, solver);
}

void declare(Visitor &v, OutputCase &output) {
  v.key({.name = "fields",
         .description =
             "whether VTU files are written; without them only the tables and the summary"},
        &output.fields);
  v.key({.name = "every",
         .description = "steps between two field files",
         .range = at_least(1),
         .default_words = "time.steps / 50, rounded up: at most about 50 files"},
        &output.every);
  v.key({.name = "report", .description = "whether the report, a web page, is written"},
        &output.report);
  v.key({.name = "checkpoint",
         .description =
             "how often a run saves what `--resume` needs to go on from there: every so many "
             "steps, \"10 steps\", or after some time, \"30 s\", \"5 min\", \"2 h\"; \"never\" "
             "leaves it to the signals that stop a run"},
        &output.checkpoint);
  v.check("checkpoint", [&] { return interval_complaint(output.checkpoint); });
}

void declare(Visitor &v, LoadCase &load, int dimension) {
  v.key({.name = "force",
         .description = "force f_0 on the volume (4)",
         .unit = "N/m^3",
         .length = one_each_axis(dimension),
         .default_words = "none"},
        &load.force);
  v.key({.name = "charge", .description = "free charge phi_0 in the volume (5)", .unit = "C/m^3"},
        &load.charge);
  v.key({.name = "heat", .description = "heat source q_0 in the volume (6)", .unit = "W/m^3"},
        &load.heat);
}

void declare(Visitor &v, InitialCase &initial, int dimension) {
  v.key({.name = "displacement",
         .description = "displacement u_0 at the time 0",
         .unit = "m",
         .length = one_each_axis(dimension),
         .constant_in_time = true,
         .default_words = "zero"},
        &initial.displacement);
  v.key({.name = "potential",
         .description = "electric potential at the time 0",
         .unit = "V",
         .constant_in_time = true},
        &initial.potential);
  v.key(
      {.name = "temperature",
       .description = "temperature theta_0 at the time 0, difference to the reference temperature",
       .unit = "K",
       .constant_in_time = true},
      &initial.temperature);
}

void declare_boundaries(Visitor &v, std::vector<BoundaryCase> &boundaries, const MeshCase &mesh,
                        int dimension) {
  const Key key = {.name = "boundary",
                   .description =
                       "Conditions on a part of the boundary. Several entries may name one "
                       "boundary as long as no field gets two conditions there. Where "
                       "nothing is said, there is no traction, charge or heat flow"};
  boundaries.resize(static_cast<std::size_t>(v.count(key, static_cast<int>(boundaries.size()))));
  for (std::size_t i = 0; i < boundaries.size(); ++i)
    v.entry(key, static_cast<int>(i),
            [&](Visitor &inner) { declare(inner, boundaries[i], mesh, dimension); });
}

void declare(Visitor &v, ElectrodeCase &electrode, const MeshCase &mesh) {
  v.place(electrode.where);
  v.key({.name = "name",
         .description = "what its columns in history.csv are called; letters, digits, _ and -",
         .required = true},
        &electrode.name);
  v.key(on_sides("boundary that the electrode covers, or list of boundaries that it joins", mesh),
        &electrode.on);
  v.optional({.name = "voltage",
              .description = "potential of the electrode over time; beside a resistor or capacitor "
                             "that of their other end, 0 when not given",
              .unit = "V"},
             electrode.voltage);
  v.optional({.name = "charge",
              .description = "total charge on the electrode over time, -integral of D.nu; its "
                             "potential follows",
              .unit = "C (2D: C/m)"},
             electrode.charge);
  v.optional({.name = "resistor",
              .description = "resistance between the electrode and ground, or `voltage`, or `to`",
              .unit = "ohm (2D: ohm m)",
              .range = positive()},
             electrode.resistor);
  v.optional({.name = "capacitor",
              .description = "capacitance between the same two, parallel to the resistor",
              .unit = "F (2D: F/m)",
              .range = positive()},
             electrode.capacitor);
  v.optional({.name = "to",
              .description = "name of the electrode that resistor and capacitor lead to, instead "
                             "of ground"},
             electrode.to);
}

void declare_electrodes(Visitor &v, std::vector<ElectrodeCase> &electrodes, const MeshCase &mesh) {
  const Key key = {
      .name = "electrode",
      .description =
          "A conducting film on parts of the boundary: one potential all over. With "
          "`voltage` it is driven (0: grounded); with `charge` it floats with that "
          "charge; with a resistor or capacitor these lead to ground, to a given "
          "voltage or to another electrode; with nothing it is open and keeps its "
          "charge at the time 0. In 2D charges, resistances and capacitances are those "
          "of one metre of thickness"};
  electrodes.resize(static_cast<std::size_t>(v.count(key, static_cast<int>(electrodes.size()))));
  for (std::size_t i = 0; i < electrodes.size(); ++i)
    v.entry(key, static_cast<int>(i), [&](Visitor &inner) { declare(inner, electrodes[i], mesh); });
}

void declare_contact(Visitor &v, std::optional<ContactCase> &contact, const MeshCase &mesh) {
  const Key key = {.name = "contact",
                   .description =
                       "Contact with a foundation that does not deform. Without this table "
                       "there is no contact",
                   .optional = true};
  if (!v.given(key, contact.has_value()))
    return;
  if (!contact)
    contact.emplace();
  v.table(key, [&](Visitor &inner) { declare(inner, *contact, mesh); });
}

void declare_material(Visitor &v, Case &c) {
  declare_regions(v, c.regions, c.mesh);
  const Key key = {
      .name = "material",
      .description =
          "What the whole body is made of: constants of (1)-(3) in crystal axes, sigma = F eps(u) "
          "- "
          "E^T E(phi) - M theta, D = E eps(u) + beta E(phi) + P theta, q = -K grad theta, with "
          "E(phi) = -grad phi. Each of them may be given in the stress-charge form (c, e, "
          "permittivity at constant strain) or in the strain-charge form of data sheets (s, d, "
          "permittivity at constant stress), from which the first is computed. What is not given "
          "is taken from the library's entry; without an entry it must be given",
      .required = c.regions.empty()};
  const bool given = v.given(key, c.regions.empty());
  if (given)
    v.table(key, [&](Visitor &inner) { declare(inner, c.material, c.dimension); });
  v.check("material", [&] {
    return given && !c.regions.empty() ? "stands beside [[region]]; a body has either of them" : "";
  });
}

}  // namespace

void declare(Visitor &v, Case &c) {
  v.key({.name = "title", .description = "what the run is called in its results"}, &c.title);
  v.table({.name = "mesh", .description = "The body's shape and its cells", .required = true},
          [&](Visitor &inner) { declare(inner, c.mesh); });
  c.dimension = dimension_of(c.mesh);
  declare_material(v, c);
  v.table({.name = "time", .description = "The simulated time", .required = true},
          [&](Visitor &inner) { declare(inner, c.time); });
  declare_boundaries(v, c.boundaries, c.mesh, c.dimension);
  declare_electrodes(v, c.electrodes, c.mesh);
  declare_contact(v, c.contact, c.mesh);
  v.table({.name = "load", .description = "Loads on the volume"},
          [&](Visitor &inner) { declare(inner, c.load, c.dimension); });
  v.table({.name = "initial", .description = "The state at the time 0"},
          [&](Visitor &inner) { declare(inner, c.initial, c.dimension); });
  v.table({.name = "solver", .description = "How the equations are solved"},
          [&](Visitor &inner) { declare(inner, c.solver); });
  v.table({.name = "output", .description = "What a run leaves in its folder"},
          [&](Visitor &inner) { declare(inner, c.output); });
}

}  // namespace tourmaline::casefile
