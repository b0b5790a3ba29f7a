#include "output/summary.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace tourmaline::output {
namespace {

using Json = nlohmann::ordered_json;

/// A number as the tables have it: no negative zero; null where there is none.
Json number(double value) {
  if (!std::isfinite(value))
    return nullptr;
  return value == 0 ? 0. : value;
}

Json place(int dimension, const Vector3 &point) {
  Json coordinates = Json::array();
  for (int i = 0; i < dimension; ++i)
    coordinates.push_back(number(point[i]));
  return coordinates;
}

Json versions(const Summary &summary) {
  Json json{{"tourmaline", summary.version}};
  for (const auto &[name, version] : summary.components)
    json[name] = version;
  return json;
}

Json extremes(int dimension, const std::vector<Extreme> &list) {
  Json json = Json::array();
  for (const Extreme &extreme : list)
    json.push_back({{"field", extreme.field},
                    {"minimum", number(extreme.minimum)},
                    {"at_minimum", place(dimension, extreme.at_minimum)},
                    {"maximum", number(extreme.maximum)},
                    {"at_maximum", place(dimension, extreme.at_maximum)}});
  return json;
}

Json materials(const std::vector<MaterialRecord> &list) {
  Json json = Json::array();
  for (const MaterialRecord &record : list)
    json.push_back({{"region", record.region},
                    {"material", record.material},
                    {"couplings", record.couplings}});
  return json;
}

Json contacts(const std::vector<ContactRecord> &list) {
  Json json = Json::array();
  for (const ContactRecord &record : list)
    json.push_back({{"name", record.name}, {"nodes", record.nodes}});
  return json;
}

Json seconds_json(const Seconds &seconds) {
  return {{"mesh", number(seconds.mesh)},
          {"start", number(seconds.start)},
          {"assemble", number(seconds.assemble)},
          {"analyse", number(seconds.analyse)},
          {"factorise", number(seconds.factorise)},
          {"condense", number(seconds.condense)},
          {"step",
           {{"total", number(seconds.step.total)},
            {"per_step", number(seconds.step.per_step)},
            {"substitutions", number(seconds.step.substitutions)},
            {"contact", number(seconds.step.contact)},
            {"estimates", number(seconds.step.estimates)}}},
          {"output", number(seconds.output)},
          {"total", number(seconds.total)}};
}

}  // namespace

std::string summary_text(int dimension, const Summary &summary) {
  Json json;
  json["case"] = summary.title;
  if (!summary.friction_name.empty())
    json["friction_law"] = summary.friction_name;
  json["versions"] = versions(summary);
  json["inputs"] = summary.inputs;
  json["files"] = summary.files;
  json["sizes"] = summary.sizes;
  json["iterations"] = summary.iterations;
  json["factorisations"] = summary.factorisations;
  if (!summary.factorised_by.empty())
    json["factorised_by"] = summary.factorised_by;
  if (!summary.instead_of_own.empty())
    json["not_factorised_by_own"] = summary.instead_of_own;
  json["negative_pivots"] =
      summary.negative_pivots ? Json(*summary.negative_pivots) : Json(nullptr);
  json["backward_error"] = number(summary.backward_error);
  json["forward_error"] = number(summary.forward_error);
  json["refined"] = summary.is_refined;
  json["extremes"] = extremes(dimension, summary.extremes);
  json["materials"] = materials(summary.materials);
  if (!summary.contacts.empty())
    json["contacts"] = contacts(summary.contacts);
  json["seconds"] = seconds_json(summary.seconds);
  json["memory"] = summary.peak_memory_bytes;
  json["warnings"] = summary.warnings;
  // A title in another encoding than UTF-8 must not cost the run its summary.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tourmaline::output
