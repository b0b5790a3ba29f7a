#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/sides.h"
#include "schema_parts.h"
#include "sense.h"
#include "tourmaline/case/mesh_case.h"

namespace tourmaline::casefile {

namespace {

std::string corners_complaint(const Box &box) {
  for (std::size_t i = 0; i < box.max.size(); ++i) {
    if (!(box.max[i] > box.min[i]))
      return fmt::format("entry {} must be greater than that of min, which is {}", i, box.min[i]);
    if (box.max[i] - box.min[i] < sense::length.least)
      return fmt::format("entry {} and that of min, {}, make a side shorter than {:g} m", i,
                         box.min[i], sense::length.least);
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

// Around a ring this counts the first nodes twice, which does not matter here.
std::string unknowns_complaint(const std::vector<int> &cells, int degree) {
  double unknowns = static_cast<double>(cells.size()) + 2;
  for (const int intervals : cells)
    unknowns *= static_cast<double>(degree) * intervals + 1;
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
                .range = {.low = 1, .sense = sense::ratio},
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
         .range = any(sense::coordinate),
         .length = axes},
        &box.min);
  v.key({.name = "max",
         .description = "corner where the coordinates are greatest",
         .unit = "m",
         .required = true,
         .range = any(sense::coordinate),
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
  v.check("cells", [&] { return unknowns_complaint(box.cells, degree); });
  v.check("grading", [&] { return grading_complaint(box); });
}

std::string radii_complaint(const Annulus &ring) {
  if (!(ring.outer > ring.inner))
    return fmt::format("must be greater than inner, which is {}", ring.inner);
  if (ring.outer - ring.inner < 1e-8 * ring.outer * ring.cells[0])
    return "the wall is too thin to tell the corners of its cells apart";
  return "";
}

// With fewer the facets of a node differ too much to have one normal.
std::string around_complaint(const Annulus &ring) {
  constexpr int least = 8;
  return ring.cells[1] < least
             ? fmt::format("entry 1, the intervals around, must be at least {}", least)
             : "";
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
         .range = positive(sense::length)},
        &ring.inner);
  v.key({.name = "outer",
         .description = "outer radius",
         .unit = "m",
         .required = true,
         .range = positive(sense::length)},
        &ring.outer);
  v.key({.name = "height",
         .description = "length of the tube along z",
         .unit = "m",
         .required = true,
         .range = positive(sense::length),
         .used = with("cell", cell, {"tetrahedron", "hexahedron"})},
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
  v.check("cells", [&] { return around_complaint(ring); });
  v.check("cells", [&] { return unknowns_complaint(ring.cells, degree); });
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
  const Use file = with("mesh.file", mesh.file.has_value());
  v.key({.name = "scale",
         .description = "the unit of length of the file, 1e-3 when it is in millimetres; .step and "
                        ".iges know theirs and come in metres",
         .unit = "m",
         .range = positive(sense::length),
         .used = file},
        &mesh.scale);
  v.optional(
      {.name = "size",
       .description = "size of the largest cells of a geometry, in the unit of its file, which "
                      "is `scale`; required for .step, .iges and .brep. A size that changes "
                      "nothing is a mistake",
       .unit = "scale",
       .range = positive(sense::length),
       .used = file,
       .unit_here = mesh.scale == 1 ? "m" : fmt::format("{} m", mesh.scale)},
      mesh.size);
  v.key({.name = "unnamed",
         .description = "what facets of the boundary without a name are; error: a mistake; "
                        "natural: free of traction, charge and heat flow",
         .choices = {"error", "natural"},
         .used = file},
        &mesh.unnamed);
}

std::string modes_complaint(const MeshCase &mesh) {
  const CellShape cell = shape_of(mesh);
  const bool simplices = cell == CellShape::triangle || cell == CellShape::tetrahedron;
  // What a result folder tells of a mesh holds no cells.
  const bool is_known = !mesh.file || (mesh.content && !mesh.content->cells.empty());
  if (mesh.modes == "none" || !simplices || !is_known)
    return "";
  return fmt::format(
      "incompatible modes are for quadrilaterals and hexahedra, and the cells are {}; to let these "
      "bend, give mesh.degree = 2",
      cell == CellShape::triangle ? "triangles" : "tetrahedra");
}

}  // namespace

void declare(Visitor &v, MeshCase &mesh) {
  declare_file(v, mesh);
  v.key({.name = "degree",
         .description = "of the finite elements for all fields",
         .range = from_to(1, 2)},
        &mesh.degree);
  v.key({.name = "modes",
         .description =
             "what linear quadrilaterals and hexahedra have beside their nodes' shape functions. "
             "none: nothing; they are far too stiff where a body bends and cells are few or long. "
             "incompatible: bubbles inside each cell (Wilson's, as corrected by Taylor), which let "
             "it bend, for displacement and potential. Triangles and tetrahedra bend with "
             "degree = 2",
         .choices = {"none", "incompatible"},
         .used = {mesh.degree == 1, "degree = 1"}},
        &mesh.modes);
  v.optional_table(
      {.name = "box",
       .description = "A rectangle or cuboid whose sides are parallel to the axes; its "
                      "sides are named left, right (least and greatest x), bottom, top "
                      "(2D: y, 3D: z) and in 3D front, back (y)"},
      mesh.box, [&](Visitor &inner, Box &box) { declare(inner, box, mesh.degree); });
  v.optional_table(
      {.name = "annulus",
       .description = "The ring between two circles about the origin, in 3D a tube along z "
                      "from z = 0 on; its sides are named inner, outer and in 3D bottom, "
                      "top. The corners of the cells lie on circles, edges are straight"},
      mesh.annulus, [&](Visitor &inner, Annulus &ring) { declare(inner, ring, mesh.degree); });
  v.exactly_one({"box", "annulus", "file"});
  v.check("", [&] {
    return mesh.box || mesh.annulus || mesh.file ? ""
                                                 : "no mesh; give mesh.box = { min, max, cells, "
                                                   "cell }, mesh.annulus = { inner, outer, "
                                                   "cells, cell } or mesh.file";
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
  v.check("modes", [&] { return modes_complaint(mesh); });
}

}  // namespace tourmaline::casefile
