#include "report/recorded_boundaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "report/field_file.h"
#include "report/moment.h"
#include "report/text_file.h"
#include "tourmaline/error.h"

namespace tourmaline::report {

namespace fs = std::filesystem;

namespace {

std::vector<NamedFacets> facets_of(const fs::path &path) {
  std::vector<NamedFacets> boundaries;
  try {
    const auto json = nlohmann::json::parse(read_text_file(path));
    for (const auto &entry : json.at("boundaries"))
      if (!entry.value("inside", false))
        boundaries.push_back({entry.at("name").get<std::string>(),
                              entry.at("facets").get<std::vector<std::vector<std::uint32_t>>>()});
  } catch (const nlohmann::json::exception &) {
    throw CaseError(path.string() + ": is not what a run writes there");
  }
  return boundaries;
}

/// The facets that are seen, by places on the skin.
Boundary seen_boundary(const NamedFacets &named, const Result &result,
                       const std::map<std::uint32_t, std::uint32_t> &place) {
  Boundary boundary;
  boundary.name = named.name;
  if (result.asked)
    boundary.conditions = conditions_on(*result.asked, boundary.name, result.friction_name);
  for (const auto &nodes : named.facets) {
    std::vector<std::uint32_t> facet;
    for (const std::uint32_t node : nodes)
      if (const auto found = place.find(node); found != place.end())
        facet.push_back(found->second);
    if (facet.size() == nodes.size())
      boundary.facets.push_back(std::move(facet));
  }
  return boundary;
}

void add_contact_pieces(Result &result, std::vector<NamedFacets> boundaries) {
  if (result.dimension != 2 || !result.contact || !result.asked || result.asked->contacts.empty())
    return;
  const std::vector<double> *step = result.contact->find("step"), *x = result.contact->find("x"),
                            *y = result.contact->find("y");
  if (!step || !x || !y || step->empty())
    return;
  std::map<std::string, std::size_t> contact_on;
  for (std::size_t i = 0; i < result.asked->contacts.size(); ++i)
    for (const std::string &name : result.asked->contacts[i].on)
      contact_on.emplace(name, i);
  std::erase_if(boundaries,
                [&](const NamedFacets &boundary) { return !contact_on.contains(boundary.name); });
  for (NamedFacets &boundary : boundaries)
    boundary.contact = contact_on.at(boundary.name);
  const std::vector<double> *contact = result.contact->find("contact");
  std::vector<std::pair<double, double>> places;
  std::vector<std::size_t> contacts;
  for (std::size_t i = 0; i < step->size() && (*step)[i] == step->front(); ++i)
    places.emplace_back((*x)[i], (*y)[i]);
  for (std::size_t i = 0; contact && i < places.size(); ++i)
    contacts.push_back(static_cast<std::size_t>((*contact)[i]));
  result.contact_pieces = contact_pieces(boundaries, places, contacts);
}

/// The facets by rows of contact.csv, as the files for ParaView have them with all nodes of degree
/// 2; without these the corners, if they are all the nodes that there are.
std::vector<ContactFacet> contact_facets(const Result &result, const fs::path &folder,
                                         const std::vector<NamedFacets> &boundaries,
                                         std::size_t n_places) {
  std::vector<ContactFacet> facets;
  if (const std::vector<RecordedMoment> series = recorded_moments(folder, "contact.pvd");
      !series.empty()) {
    const output::Grid grid = read_field_file(series.front().file).grid;
    if (grid.points.size() != n_places)
      return {};
    for (std::size_t i = 0; i < grid.n_cells(); ++i) {
      const auto first =
          grid.connectivity.begin() + static_cast<std::ptrdiff_t>(i * grid.nodes_per_cell);
      facets.emplace_back(first, first + static_cast<std::ptrdiff_t>(grid.nodes_per_cell));
    }
    return facets;
  }
  std::set<std::string> touching;
  for (const casefile::ContactCase &contact : result.asked->contacts)
    touching.insert(contact.on.begin(), contact.on.end());
  std::map<std::uint32_t, std::uint32_t> row_of;
  for (const NamedFacets &boundary : boundaries)
    if (touching.contains(boundary.name))
      for (const auto &facet : boundary.facets) {
        facets.push_back(facet);
        for (const std::uint32_t node : facet)
          row_of[node] = 0;
      }
  if (row_of.size() != n_places)
    return {};
  std::uint32_t next = 0;
  for (auto &entry : row_of)
    entry.second = next++;
  for (ContactFacet &facet : facets)
    for (std::uint32_t &node : facet)
      node = row_of.at(node);
  return facets;
}

void add_contact_faces(Result &result, const fs::path &folder,
                       const std::vector<NamedFacets> &boundaries) {
  if (result.dimension != 3 || !result.contact || !result.asked || result.asked->contacts.empty())
    return;
  const std::vector<double> *step = result.contact->find("step"), *x = result.contact->find("x"),
                            *y = result.contact->find("y"), *z = result.contact->find("z"),
                            *contact = result.contact->find("contact");
  if (!step || !x || !y || !z || step->empty())
    return;
  std::vector<Vector3> places;
  std::vector<std::size_t> contacts;
  for (std::size_t i = 0; i < step->size() && (*step)[i] == step->front(); ++i) {
    places.push_back({(*x)[i], (*y)[i], (*z)[i]});
    if (contact)
      contacts.push_back(static_cast<std::size_t>((*contact)[i]));
  }
  result.contact_faces = contact_faces(contact_facets(result, folder, boundaries, places.size()),
                                       places, contacts, result.contact_names());
}

}  // namespace

void read_boundaries(Result &result, const fs::path &folder) {
  const fs::path path = folder / "boundaries.json";
  if (!fs::exists(path))
    return;
  std::vector<NamedFacets> boundaries = facets_of(path);
  std::map<std::uint32_t, std::uint32_t> place;
  for (std::size_t i = 0; i < result.skin.nodes.size(); ++i)
    place.emplace(result.skin.names[i], static_cast<std::uint32_t>(i));
  if (!result.points.empty())
    for (const NamedFacets &named : boundaries)
      result.boundaries.push_back(seen_boundary(named, result, place));
  add_contact_faces(result, folder, boundaries);
  add_contact_pieces(result, std::move(boundaries));
}

void remark_on_contact(Result &result) {
  if (result.contact && result.contact->n_rows() > 0 && result.contact_pieces.empty() &&
      result.contact_faces.empty())
    result.remarks.push_back(
        fmt::format("There are no {} the contact: the folder does not tell its facets "
                    "(boundaries.json, resolved.toml).",
                    result.dimension == 2 ? "curves along" : "pictures of"));
}

/// The greatest value of a column of the history; 0 when it is not there.

}  // namespace tourmaline::report
