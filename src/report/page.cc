#include "report/page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "output/atomic_file.h"
#include "page_template.h"
#include "report/colour_map.h"
#include "report/packing.h"
#include "report/poling.h"
#include "report/result.h"
#include "report/setting.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

using Json = nlohmann::json;

/// Of one page, on the skin: some 25 MB in a browser. 50 states of 64 x 64 squares have 10 million.
constexpr std::size_t most_numbers = 12'000'000;
/// Behind the skin of solid bodies, which are packed to a byte or two each.
constexpr std::size_t most_inner_numbers = 4'000'000;

template <typename Number>
std::vector<float> as_floats(const std::vector<Number> &numbers) {
  return {numbers.begin(), numbers.end()};
}

template <std::size_t n>
Json indices(Packing &packing, const std::vector<std::array<std::uint32_t, n>> &tuples) {
  std::vector<std::uint32_t> flat;
  for (const auto &tuple : tuples)
    flat.insert(flat.end(), tuple.begin(), tuple.end());
  return packing.integers(flat);
}

Json places_json(Packing &packing, const std::vector<Vector3> &places) {
  std::vector<float> flat;
  for (const Vector3 &place : places)
    flat.insert(flat.end(), place.begin(), place.end());
  return packing.floats(flat, 1);
}

Json grid_json(Packing &packing, const Result &result) {
  return {{"points", places_json(packing, result.points)},
          {"nodes", packing.integers(result.skin.names)},
          {"cells", packing.integers(result.skin.cells)},
          {"triangles", indices(packing, result.skin.triangles)},
          {"triangleCells", packing.integers(result.skin.triangle_cells)},
          {"edges", indices(packing, result.skin.edges)}};
}

Json solid_json(Packing &packing, const Result &result) {
  if (!result.solid)
    return nullptr;
  return {{"points", places_json(packing, result.solid->points)},
          {"nodes", packing.integers(result.solid->names)},
          {"corners", result.solid->corners},
          {"parts", packing.integers(result.solid->parts)},
          {"partCells", packing.integers(result.solid->part_cells)}};
}

Json components_json(Packing &packing, const Field &field, std::size_t states,
                     const std::vector<std::vector<float>> &components) {
  Json values = Json::array();
  for (const std::vector<float> &component : components)
    values.push_back(field.is_unknown() ? packing.floats(component, states)
                                        : packing.levels(component, states));
  return values;
}

/// The unknowns are exact to single precision, so that they can be compared with nodes.csv; what is
/// derived from them is rounded.
Json field_json(Packing &packing, const Field &field, const Result &result) {
  const std::size_t states = result.times.size();
  Json json{{"name", field.name},
            {"unit", field.unit},
            {"on", field.on_points ? "points" : "cells"},
            {"origin", field.origin()},
            {"belowRoundOff", field.below_round_off},
            {"components", field.components},
            {"values", components_json(packing, field, states, field.values)}};
  if (result.solid)
    json["inner"] = components_json(packing, field, states, field.inner);
  return json;
}

Json table_json(Packing &packing, const Table &table) {
  Json columns = Json::array();
  for (const std::vector<double> &column : table.columns)
    columns.push_back(packing.floats(as_floats(column), 1));
  return {{"names", table.names}, {"columns", columns}};
}

Json boundary_json(Packing &packing, const Boundary &boundary) {
  std::vector<std::uint32_t> nodes, sizes;
  for (const auto &facet : boundary.facets) {
    sizes.push_back(static_cast<std::uint32_t>(facet.size()));
    nodes.insert(nodes.end(), facet.begin(), facet.end());
  }
  return {{"name", boundary.name},
          {"kind", boundary.conditions.kind},
          {"conditions", boundary.conditions.texts},
          {"sizes", packing.integers(sizes)},
          {"nodes", packing.integers(nodes)}};
}

Json piece_json(Packing &packing, const ContactPiece &piece) {
  return {{"name", piece.name},
          {"abscissa", piece.abscissa},
          {"origin", piece.origin},
          {"rows", packing.integers(piece.rows)},
          {"along", packing.floats(as_floats(piece.along), 1)}};
}

Json face_json(Packing &packing, const ContactFace &face) {
  return {{"contact", face.contact},
          {"place", face.place},
          {"across", face.across},
          {"up", face.up},
          {"origin", face.origin},
          {"sizes", packing.integers(face.sizes)},
          {"rows", packing.integers(face.rows)},
          {"x", packing.floats(as_floats(face.x), 1)},
          {"y", packing.floats(as_floats(face.y), 1)}};
}

/// Tail and tip of each arrow; null where nothing is poled.
Json poling_json(Packing &packing, const Result &result) {
  std::vector<float> ends;
  for (const PolingArrow &arrow : poling_arrows(result))
    for (const Vector3 &end : {arrow.tail, arrow.tip})
      ends.insert(ends.end(), end.begin(), end.end());
  return ends.empty() ? Json() : packing.floats(ends, 1);
}

/// Where the poling is the same everywhere, the arrows say all.
bool is_shown(const Field &field, const Result &result) {
  return field.name != "poling" || result.field("region");
}

// Empty where the record has no such text.
std::string text_in(const Json &record, const char *key) {
  const auto found = record.is_object() ? record.find(key) : record.end();
  return found != record.end() && found->is_string() ? found->get<std::string>() : "";
}

// The materials with the couplings that they have not, so that nobody looks for them in vain.
Json parts_json(const Result &result, const Json &summary) {
  Json parts = Json::array();
  if (summary.is_object() && summary.contains("materials")) {
    for (const Json &record : summary["materials"]) {
      const std::string region = text_in(record, "region");
      const std::string words = text_in(record, "material") + ": " + text_in(record, "couplings");
      parts.push_back({{"name", region.empty() ? "body" : region}, {"material", words}});
    }
    return parts;
  }
  for (const Part &part : parts_of(result))
    parts.push_back({{"name", part.name}, {"material", part.material}});
  return parts;
}

Json left_out(const Result &result) {
  Json fields = Json::array();
  for (const char *field : {"potential", "temperature"})
    if (result.asked && !result.asked->model.has(field))
      fields.push_back(field);
  return fields;
}

Json result_json(Packing &packing, const Result &result) {
  Json json{{"name", result.name},
            {"title", result.asked ? result.asked->title : ""},
            {"dimension", result.dimension},
            {"leftOut", left_out(result)},
            {"perDepth", result.asked ? result.asked->is_per_depth() : result.dimension == 2},
            {"case", result.resolved},
            {"summary", Json::parse(result.summary, nullptr, false)},
            {"remarks", result.remarks},
            {"times", result.times},
            {"steps", result.steps},
            {"fields", Json::array()},
            {"boundaries", Json::array()},
            {"unnamed", has_unnamed_facets(result) ? name_of_unnamed(result) : ""},
            {"contactPieces", Json::array()},
            {"contactFaces", Json::array()},
            {"parts", Json::array()}};
  if (json["summary"].is_discarded())
    json["summary"] = nullptr;
  if (!result.points.empty())
    json["grid"] = grid_json(packing, result);
  json["solid"] = solid_json(packing, result);
  for (const Field &field : result.fields)
    if (is_shown(field, result))
      json["fields"].push_back(field_json(packing, field, result));
  json["poling"] = poling_json(packing, result);
  json["parts"] = parts_json(result, json["summary"]);
  for (const Boundary &boundary : result.boundaries)
    json["boundaries"].push_back(boundary_json(packing, boundary));
  for (const ContactPiece &piece : result.contact_pieces)
    json["contactPieces"].push_back(piece_json(packing, piece));
  for (const ContactFace &face : result.contact_faces)
    json["contactFaces"].push_back(face_json(packing, face));
  if (result.asked && result.asked->contacts.size() > 1)
    for (const casefile::ContactCase &contact : result.asked->contacts)
      json["contacts"].push_back(contact.called());
  if (result.history)
    json["history"] = table_json(packing, *result.history);
  for (const ProbeTable &probe : result.probes)
    json["probes"].push_back({{"name", probe.name},
                              {"isLine", probe.is_line},
                              {"table", table_json(packing, probe.table)}});
  if (result.contact)
    json["contact"] = table_json(packing, *result.contact);
  if (!result.friction_bound.empty() && !result.contact->find("friction_bound"))
    json["frictionBound"] = packing.floats(as_floats(result.friction_bound), 1);
  return json;
}

Json map_json(const ColourMap &map) {
  std::string hex;
  for (const Colour &colour : map)
    for (const std::uint8_t channel : colour)
      hex += fmt::format("{:02x}", channel);
  return hex;
}

/// JSON inside a script element: "</script>" in a title must not end it.
std::string script_text(const Json &json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

// The names that a folder has with more and more of its path: "b", "a/b".
std::string name_with(const std::filesystem::path &folder, int parts) {
  std::filesystem::path plain = std::filesystem::absolute(folder).lexically_normal();
  if (!plain.has_filename())
    plain = plain.parent_path();
  std::filesystem::path name;
  for (int i = 0; i < parts && plain.has_filename(); ++i, plain = plain.parent_path())
    name = name.empty() ? plain.filename() : plain.filename() / name;
  return name.string();
}

/// Two folders of one name are told apart by those in which they stand.
void tell_apart(Json &results, const std::vector<std::filesystem::path> &folders) {
  if (results.size() < 2 || results[0]["name"] != results[1]["name"])
    return;
  for (int parts = 2; parts <= 64; ++parts) {
    const std::string one = name_with(folders[0], parts), other = name_with(folders[1], parts);
    if (one == other)
      continue;
    results[0]["name"] = one;
    results[1]["name"] = other;
    return;
  }
}

/// A page that is not written yet.
struct Page {
  std::string results, numbers;
  bool has_all = true;    ///< all field files of the runs
  bool has_least = true;  ///< only the last one of each

  std::size_t bytes() const { return results.size() + numbers.size() + page_template().size(); }
};

/// `numbers` on skins and behind them are shared out among the folders.
Page made(const std::vector<std::filesystem::path> &folders, std::size_t numbers,
          std::size_t inner_numbers) {
  Packing packing;
  Json results = Json::array();
  Page page;
  for (const std::filesystem::path &folder : folders) {
    const Result result = read_result(folder, {.most_numbers = numbers / folders.size(),
                                               .most_inner = inner_numbers / folders.size()});
    page.has_all = page.has_all && result.times.size() == result.n_states;
    page.has_least = page.has_least && result.times.size() <= 1;
    results.push_back(result_json(packing, result));
  }
  tell_apart(results, folders);
  page.results = script_text(
      {{"results", results},
       {"colourMaps", {{"even", map_json(viridis())}, {"signed", map_json(blue_red())}}}});
  page.numbers = packing.text();
  return page;
}

/// The page with the most moments that was found to fit; with what lies behind the skins, too, if
/// that fits.
Page fitted(const std::vector<std::filesystem::path> &folders, std::size_t most_bytes) {
  // A number takes some 0.8 bytes of a page, more or less as it changes from moment to moment.
  auto numbers = static_cast<double>(most_bytes) / 0.8;
  std::optional<Page> best;
  for (int attempt = 0; attempt < 5; ++attempt) {
    Page page = made(folders, static_cast<std::size_t>(numbers), 0);
    const double share = static_cast<double>(page.bytes()) / static_cast<double>(most_bytes);
    const bool fits = share <= 1, is_last = page.has_all || share > 0.8;
    if (!fits && page.has_least)
      throw CaseError(fmt::format(
          "a page with one moment of the fields has {:.3g} MB already, and at most {:.3g} MB are "
          "asked for; give more with --size",
          static_cast<double>(page.bytes()) / 1e6, static_cast<double>(most_bytes) / 1e6));
    if (fits && (!best || page.bytes() > best->bytes()))
      best = std::move(page);
    if (fits && is_last)
      break;
    numbers *= 0.95 / share;
  }
  if (!best)
    return made(folders, 0, 0);
  if (best->has_all) {
    const double left = static_cast<double>(most_bytes) - static_cast<double>(best->bytes());
    Page page =
        made(folders, static_cast<std::size_t>(numbers), static_cast<std::size_t>(left / 0.8));
    if (page.bytes() <= most_bytes)
      return page;
  }
  return *std::move(best);
}

}  // namespace

void write_page(const std::vector<std::filesystem::path> &folders,
                const std::filesystem::path &file, std::size_t most_bytes) {
  if (folders.empty() || folders.size() > 2)
    throw CaseError(fmt::format("a report shows one folder, or two side by side; {} were given",
                                folders.size()));
  const Page page = most_bytes > 0 ? fitted(folders, most_bytes)
                                   : made(folders, most_numbers, most_inner_numbers);
  constexpr std::string_view end = "</body>";
  const std::string_view shell = page_template();
  const std::size_t at = shell.rfind(end);
  if (at == std::string_view::npos)
    throw MachineError("the report page inside this program is damaged; build it again");
  output::AtomicFile out(file);
  out.append(shell.substr(0, at));
  out.append("<script type=\"application/json\" id=\"results\">" + page.results +
             "</script>\n<script type=\"text/plain\" id=\"numbers\">");
  out.append(page.numbers);
  out.append("</script>\n");
  out.append(shell.substr(at));
  out.finish();
}

}  // namespace tourmaline::report
