#include "sample.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tourmaline::verified {

double Units::factor(const Dimension &of) const {
  return std::pow(length, of.length) * std::pow(force, of.force) * std::pow(voltage, of.voltage) *
         std::pow(temperature, of.temperature) * std::pow(time, of.time);
}

Dimension dimension_of_key(const std::string &key, const std::string &law) {
  static const std::map<std::string, Dimension> by_law{
      {"contact.normal compliance", {-3, 1}},
      {"contact.normal damped", {-3, 1, 0, 0, 1}},
      {"contact.friction coulomb", {}},
      {"contact.electric exchange", {-1, 1, -2}},
      {"contact.electric leak", {-1, 1, -2, 0, -1}}};
  if (key == "coefficient" && by_law.contains(law))
    return by_law.at(law);
  static const std::map<std::string, Dimension> whole{{"displacement", {1}},
                                                      {"foundation_displacement", {1}},
                                                      {"gap", {1}},
                                                      {"ramp", {1}},
                                                      {"foundation_potential", {0, 0, 1}},
                                                      {"friction_share", {}},
                                                      {"reference", {-2, 1}},
                                                      {"cohesion", {-2, 1}},
                                                      {"limit", {-2, 1}},
                                                      {"potential", {0, 0, 1}},
                                                      {"voltage", {0, 0, 1}},
                                                      {"temperature", {0, 0, 0, 1}},
                                                      {"foundation_temperature", {0, 0, 0, 1}},
                                                      {"reference_temperature", {0, 0, 0, 1}},
                                                      {"traction", {-2, 1}},
                                                      {"bound", {-2, 1}},
                                                      {"surface_charge", {-1, 1, -1}},
                                                      {"heat_flux", {-1, 1, 0, 0, -1}},
                                                      {"force", {-3, 1}},
                                                      {"charge", {-2, 1, -1}},
                                                      {"heat", {-2, 1, 0, 0, -1}},
                                                      {"coefficient", {-1, 1, 0, -1, -1}},
                                                      {"resistor", {-1, -1, 2, 0, 1}},
                                                      {"density", {-4, 1, 0, 0, 2}},
                                                      {"specific_heat", {2, 0, 0, -1, -2}}};
  static const std::map<std::string, Dimension> by_letters{
      {"c", {-2, 1}},        {"e", {-1, 1, -1}},     {"beta", {0, 1, -2}},
      {"m", {-2, 1, 0, -1}}, {"p", {-1, 1, -1, -1}}, {"k", {0, 1, 0, -1, -1}}};
  const auto found = whole.find(key);
  return found != whole.end() ? found->second
                              : by_letters.at(key.substr(0, key.find_first_of("0123456789")));
}

std::string SampleMesh::text() const {
  const bool solid = points.front().size() == 3;
  const int facet_type = !solid ? 1 : simplices ? 2 : 3, cell_type = (solid ? 4 : 2) + !simplices;
  const int n_sides = *std::max_element(side.begin(), side.end()) + 1,
            n_regions = *std::max_element(region.begin(), region.end()) + 1;
  std::string out = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n",
                                n_sides + n_regions);
  for (int i = 0; i < n_sides; ++i)
    out += fmt::format("{} {} \"side{}\"\n", solid + 1, i + 1, i);
  for (int i = 0; i < n_regions; ++i)
    out += fmt::format("{} {} \"region{}\"\n", solid + 2, n_sides + i + 1, i);
  out += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    out += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", i + 1, points[i][0], points[i][1],
                       solid ? points[i][2] : 0.);
  out += fmt::format("$EndNodes\n$Elements\n{}\n", facets.size() + cells.size());
  std::size_t number = 0;
  const auto element = [&](const std::vector<int> &vertices, int type, int tag) {
    out += fmt::format("{} {} 2 {} {}", ++number, type, tag, tag);
    for (const int v : vertices)
      out += fmt::format(" {}", v + 1);
    out += "\n";
  };
  for (std::size_t i = 0; i < facets.size(); ++i)
    element(facets[i], facet_type, side[i] + 1);
  for (std::size_t i = 0; i < cells.size(); ++i)
    element(cells[i], cell_type, n_sides + region[i] + 1);
  return out + "$EndElements\n";
}

namespace {

std::string formula(const std::vector<Term> &terms, Eigen::Index row, double end) {
  std::vector<std::string> sum;
  for (const Term &term : terms) {
    std::string place = fmt::format("{:.17g}", term.value[row]);
    for (Eigen::Index axis = 0; axis < term.gradient.cols(); ++axis)
      if (term.gradient(row, axis) != 0)
        place += fmt::format(" + {:.17g}*{}", term.gradient(row, axis), "xyz"[axis]);
    const std::string time = fmt::format("(t/{:.17g})", end);
    sum.push_back(fmt::format("{}*({})", fmt::format(fmt::runtime(term.course), time), place));
  }
  return fmt::format("\"{}\"", fmt::join(sum, " + "));
}

std::string value_of(const Condition &condition, double end) {
  const Eigen::Index rows = condition.terms.front().value.size();
  std::vector<std::string> parts;
  for (Eigen::Index row = 0; row < rows; ++row)
    parts.push_back(!condition.free.empty() && condition.free[static_cast<std::size_t>(row)]
                        ? "\"free\""
                        : formula(condition.terms, row, end));
  return rows == 1 ? parts[0] : fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string list(const Eigen::VectorXd &v) {
  return fmt::format("[{:.17g}]", fmt::join(v.begin(), v.end(), ", "));
}

std::string table(const SampleMaterial &material) {
  std::string out = fmt::format("symmetry = \"{}\", poling = {}, axis1 = {}", material.symmetry,
                                list(material.poling), list(material.axis1));
  if (material.conductor)
    out += ", conductor = true";
  for (const auto &[key, value] : material.constants)
    out += fmt::format(", {} = {:.17g}", key, value);
  return "{ " + out + " }";
}

}  // namespace

std::string Sample::law_of(const std::string &table) const {
  const auto found = laws.find(table);
  return table + " " + (found == laws.end() ? "" : found->second);
}

bool Sample::has_free_components() const {
  return std::any_of(conditions.begin(), conditions.end(),
                     [](const Condition &c) { return !c.free.empty(); });
}

bool Sample::contact_is_tilted() const {
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    if (fmt::format("side{}", mesh.side[i]) != contact)
      continue;
    Eigen::ArrayXd size = Eigen::ArrayXd::Zero(dimension());
    for (const int vertex : mesh.facets[i])
      size = size.max((mesh.points[vertex] - mesh.points[mesh.facets[i][0]]).array().abs());
    if ((size > 1e-6 * size.maxCoeff()).all())
      return true;
  }
  return false;
}

const Condition *Sample::find(const std::string &table, const std::string &key) const {
  for (const Condition &condition : conditions)
    if (condition.table == table && condition.key == key)
      return &condition;
  return nullptr;
}

std::string Sample::text() const {
  std::string out = fmt::format(
      "mesh = {{ file = \"sample.msh\", degree = {}{} }}\n"
      "time = {{ end = {:.17g}, steps = {} }}\nsolver = {{ {} }}\n"
      "output = {{ fields = false, report = false, checkpoint = \"never\" }}\n",
      degree, incompatible ? ", modes = \"incompatible\"" : "", end, steps, solver);
  if (materials.size() == 1)
    out += "material = " + table(materials[0]) + "\n";
  if (!contact.empty())
    out += fmt::format("contact.on = \"{}\"\n", contact);
  for (const auto &[table, law] : laws)
    out += fmt::format("{}.law = \"{}\"\n", table, law);
  for (const auto &[key, value] : numbers)
    out += fmt::format("{} = {:.17g}\n", key, value);
  for (const Condition &condition : conditions)
    if (condition.on.empty())
      out += fmt::format("{}.{} = {}\n", condition.table, condition.key, value_of(condition, end));
  for (std::size_t i = 0; materials.size() > 1 && i < materials.size(); ++i)
    out += fmt::format("[[region]]\non = \"region{}\"\nmaterial = {}\n", i, table(materials[i]));
  for (const Condition &condition : conditions) {
    if (condition.on.empty())
      continue;
    out += fmt::format("[[{}]]\non = \"{}\"\n{} = {}\n", condition.table, condition.on,
                       condition.key, value_of(condition, end));
    if (condition.table == "electrode")
      out += "name = \"" + condition.on + "\"\n";
    if (condition.resistor > 0)
      out += fmt::format("resistor = {:.17g}\n", condition.resistor);
  }
  return out;
}

}  // namespace tourmaline::verified
