#include "run/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/conductors.h"
#include "case/probes.h"
#include "case/regime.h"
#include "case/sides.h"
#include "case/tables_in_time.h"
#include "case/toml_text.h"
#include "material/composition.h"
#include "material/constants.h"
#include "mesh/mesh.h"
#include "run/contact_edges.h"
#include "run/locking.h"
#include "run/plausibility.h"
#include "run/temperatures.h"
#include "tourmaline/case/case.h"

namespace tourmaline::run {

namespace {

using Place = std::array<double, 3>;

/// Size (area, length, volume) and centre of what is added up.
struct Extent {
  double size = 0;
  Place moment{};

  template <int dim>
  void add(const body::Quadrature<dim> &part) {
    double whole = 0;
    for (const double jxw : part.jxw)
      whole += jxw;
    if (whole == 0)
      return;  // on the axis, where it has no centre
    const Place centre = part.centre();
    for (const double jxw : part.jxw) {
      size += jxw;
      for (int axis = 0; axis < 3; ++axis)
        moment[axis] += jxw * centre[axis];
    }
  }

  // `of` so many dimensions; `nothing`: what is less is round-off.
  std::string words(int dimension, int of, double nothing = 0) const {
    constexpr const char *kind[] = {"", "length", "area", "volume"};
    constexpr const char *unit[] = {"", "m", "m^2", "m^3"};
    if (size <= nothing)
      return "on the axis, without area";
    return fmt::format("{} {:.6g} {}, centre {}", kind[of], size, unit[of],
                       place(dimension, moment, size));
  }

  static std::string place(int dimension, const Place &sum, double by) {
    std::string text;
    for (int axis = 0; axis < dimension; ++axis) {
      const double coordinate = sum[axis] / by;
      text += fmt::format("{}{:.4g}", axis == 0 ? "(" : ", ",
                          std::abs(coordinate) < 1e-12 ? 0. : coordinate);
    }
    return text + ")";
  }
};

/// One region: its extent and the sum of its poling directions over the volume.
struct Region {
  Extent extent;
  Place poling{};
};

template <int dim>
std::vector<Region> regions_of(const body::Discretisation<dim> &body,
                               const material::Composition<dim> &composition,
                               std::size_t n_regions) {
  std::vector<Region> regions(n_regions);
  body.for_each_cell([&](const body::Quadrature<dim> &cell) {
    Region &region = regions[cell.region];
    const double before = region.extent.size;
    region.extent.add(cell);
    const material::Vector poling = composition.poling(cell.region, cell.centre());
    for (int axis = 0; axis < 3; ++axis)
      region.poling[axis] += (region.extent.size - before) * poling[axis];
  });
  return regions;
}

// In a comment a line break would end it.
std::string one_line(const std::string &text) {
  const std::string quoted = casefile::toml_text(text);
  return quoted.substr(1, quoted.size() - 2);
}

bool varies(const casefile::MaterialCase &material) {
  for (const casefile::Formula &entry : material.poling)
    if (entry.depends_on_place())
      return true;
  return false;
}

std::string poling_words(const casefile::MaterialCase &material, const Region &region,
                         int dimension) {
  double square = 0;
  for (const double entry : region.poling)
    square += entry * entry;
  if (varies(material)) {
    std::string text;
    for (const casefile::Formula &entry : material.poling)
      text += (text.empty() ? "(" : ", ") + one_line(entry.text());
    return ", poled along " + text + ")";
  }
  return square == 0
             ? ", not poled"
             : ", poled along " + Extent::place(dimension, region.poling, std::sqrt(square));
}

std::string in_words(const casefile::ModelCase &model) {
  if (model.is_axisymmetric())
    return "a body of revolution about x = 0, all around";
  return "in plane " + model.plane + ", per metre of depth";
}

template <int dim>
std::string survey_in(const casefile::Case &asked) {
  const material::Composition<dim> composition(asked);
  const body::Discretisation<dim> body(mesh::build<dim>(asked), 1, body::geometry_of(asked));
  body::check_conductors(body, composition, asked,
                         body::prescribed_unknowns(body, asked.boundaries, asked.electrodes));
  std::string text = fmt::format("# Boundaries and regions of this case, {}\n",
                                 dim == 3 ? "a solid" : in_words(asked.model));
  const int solid = asked.is_per_depth() ? 2 : 3;
  const std::vector<std::string> names = casefile::side_names(asked.mesh);
  std::vector<Extent> sides(names.size());
  double largest = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    body.for_each_facet({names[i]},
                        [&](const body::Quadrature<dim> &facet) { sides[i].add(facet); });
    largest = std::max(largest, sides[i].size);
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("# boundary {}: {}\n", casefile::toml_text(names[i]),
                        sides[i].words(dim, solid - 1, 1e-12 * largest));
  const auto regions =
      regions_of(body, composition, std::max<std::size_t>(1, asked.regions.size()));
  const std::vector<casefile::MaterialCase> materials = material::materials_of(asked);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const bool whole = asked.regions.empty();
    const casefile::MaterialCase &material = materials[i];
    text += fmt::format(
        "# region {}: {}, {}{}\n",
        whole ? "(the whole body)" : casefile::toml_text(casefile::listed_as(asked.regions[i])),
        one_line(material.library.value_or("material of the case")),
        regions[i].extent.words(dim, solid), poling_words(material, regions[i], dim));
  }
  return text;
}

output::MaterialRecord record_of(const std::string &region,
                                 const casefile::MaterialCase &material) {
  return {region, material.library.value_or("material of the case"),
          material::couplings(material::constants_of(material))};
}

std::string materials_in_words(const casefile::Case &asked) {
  std::string text = "\n# Materials of this case\n";
  const std::vector<output::MaterialRecord> parts = materials_of(asked);
  const std::vector<casefile::MaterialCase> materials = material::materials_of(asked);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text += fmt::format(
        "# {}, {}, class {}: {}\n",
        asked.regions.empty() ? "(the whole body)" : casefile::toml_text(parts[i].region),
        one_line(parts[i].material), material::with_entry(materials[i]).symmetry.value_or("6mm"),
        parts[i].couplings);
  }
  return text;
}

}  // namespace

std::vector<output::MaterialRecord> materials_of(const casefile::Case &asked) {
  const std::vector<casefile::MaterialCase> materials = material::materials_of(asked);
  std::vector<output::MaterialRecord> all;
  for (std::size_t i = 0; i < materials.size(); ++i)
    all.push_back(record_of(asked.regions.empty() ? "" : casefile::listed_as(asked.regions[i]),
                            materials[i]));
  return all;
}

std::string survey(const casefile::Case &asked) {
  std::string text = materials_in_words(asked);
  if (asked.mesh.content || !asked.regions.empty() || varies(asked.material))
    text += asked.dimension == 2 ? survey_in<2>(asked) : survey_in<3>(asked);
  if (casefile::keeps_temperature(asked))
    text +=
        "\n# Nothing holds the temperature of this static case, and nothing warms the body: it "
        "stays at its initial one.\n";
  std::vector<std::string> warnings = material_warnings(asked);
  for (const std::string &warning : casefile::table_warnings(asked))
    warnings.push_back(warning);
  for (const std::string &warning : temperature_warnings(asked))
    warnings.push_back(warning);
  for (const std::string &warning : {slender_warning(asked), contact_edge_warning(asked)})
    if (!warning.empty())
      warnings.push_back(warning);
  for (const std::string &warning : warnings)
    text += "\n# warning: " + warning + "\n";
  return text;
}

}  // namespace tourmaline::run
