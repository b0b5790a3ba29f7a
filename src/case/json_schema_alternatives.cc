#include "json_schema_alternatives.h"

#include <algorithm>
#include <string>

namespace tourmaline::casefile {

namespace {

bool holds(const Json &list, const Json &entry) {
  return std::find(list.begin(), list.end(), entry) != list.end();
}

Json union_of(const Json &one, const Json &other) {
  Json all = one;
  for (const Json &entry : other)
    if (!holds(all, entry))
      all.push_back(entry);
  return all;
}

Json intersection_of(const Json &one, const Json &other) {
  Json common = Json::array();
  for (const Json &entry : one)
    if (holds(other, entry))
      common.push_back(entry);
  return common;
}

Json difference_of(const Json &one, const Json &other) {
  Json rest = Json::array();
  for (const Json &entry : one)
    if (!holds(other, entry))
      rest.push_back(entry);
  return rest;
}

// A key that is declared in one of the two only is possible in the other's cases.
Json merged_properties(const Json &one, const Json &other) {
  Json all = one;
  for (const auto &[name, schema] : other.items())
    all[name] = all.contains(name) ? merged(all[name], schema) : schema;
  return all;
}

Json merged_entries(const Json &one, const Json &other) {
  Json all = Json::array();
  for (std::size_t i = 0; i < one.size(); ++i)
    all.push_back(merged(one[i], other[i]));
  return all;
}

// The same word of both schemas.
Json merged_word(const std::string &word, const Json &one, const Json &other) {
  if (word == "properties")
    return merged_properties(one, other);
  if (word == "items")
    return merged(one, other);
  if (word == "anyOf")
    return merged_entries(one, other);
  if (word == "enum")
    return union_of(one, other);
  if (word == "required")
    return intersection_of(one, other);
  if (word.starts_with("min"))
    return std::min(one, other);
  if (word.starts_with("max"))
    return std::max(one, other);
  return one;
}

// Without them a schema demands nothing.
bool is_demand(const std::string &word) {
  return word == "required" || word == "enum" || word.starts_with("min") || word.starts_with("max");
}

// A key that is not declared under the condition of `special` is none.
Json beyond_properties(const Json &general, const Json &special) {
  Json rest = Json::object();
  for (const auto &[name, schema] : general.items()) {
    const Json more = beyond(schema, special.contains(name) ? special[name] : Json(false));
    if (!more.is_null())
      rest[name] = more;
  }
  return rest.empty() ? Json() : rest;
}

Json beyond_word(const std::string &word, const Json &general, const Json &special) {
  if (word == "properties")
    return beyond_properties(general, special);
  if (word == "items")
    return beyond(general, special);
  if (word == "required") {
    const Json rest = difference_of(special, general);
    return rest.empty() ? Json() : rest;
  }
  return special;
}

}  // namespace

Json merged(const Json &one, const Json &other) {
  if (one == other || other == Json(false))
    return one;
  if (one == Json(false))
    return other;
  Json all = Json::object();
  for (const auto &[word, value] : one.items())
    if (other.contains(word))
      all[word] = merged_word(word, value, other[word]);
    else if (!is_demand(word))
      all[word] = value;
  return all;
}

Json beyond(const Json &general, const Json &special) {
  if (general == special)
    return Json();
  if (special == Json(false))
    return special;
  Json rest = Json::object();
  for (const auto &[word, value] : special.items()) {
    const bool same = general.contains(word) && general[word] == value;
    if (same || word == "description" || word == "default")
      continue;
    const Json more = general.contains(word) ? beyond_word(word, general[word], value) : value;
    if (!more.is_null())
      rest[word] = more;
  }
  return rest.empty() ? Json() : rest;
}

}  // namespace tourmaline::casefile
