#include "json_schema_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tourmaline::casefile {

namespace {

// A whole number as editors show it.
Json plain(double number) {
  const bool whole = std::abs(number) < 1e15 && number == std::floor(number);
  return whole ? Json(static_cast<std::int64_t>(number)) : Json(number);
}

Json limited(const char *type, const Range &range) {
  Json schema{{"type", type}};
  const Range both = range.narrowed();
  if (std::isfinite(both.low))
    schema[both.low_allowed ? "minimum" : "exclusiveMinimum"] = plain(both.low);
  if (std::isfinite(both.high))
    schema[both.high_allowed ? "maximum" : "exclusiveMaximum"] = plain(both.high);
  return schema;
}

Json list_of(const Json &entry, const std::vector<int> &counts) {
  Json schema{{"type", "array"}, {"items", entry}};
  if (!counts.empty()) {
    schema["minItems"] = *std::min_element(counts.begin(), counts.end());
    schema["maxItems"] = *std::max_element(counts.begin(), counts.end());
  }
  return schema;
}

/// What TOML may hold for the key.
struct Values {
  const Key &key;

  Json number() const {
    Json plain_number = limited("number", key.range);
    if (key.unit.empty())
      return plain_number;
    return {{"anyOf", {plain_number, {{"$ref", std::string("#/$defs/") + number_with_unit}}}}};
  }
  Json integer() const {
    Json schema = limited("integer", key.range);
    if (!schema.contains("maximum"))
      schema["maximum"] = std::numeric_limits<int>::max();
    return schema;
  }
  Json text() const {
    Json schema{{"type", "string"}};
    if (!key.choices.empty())
      schema["enum"] = key.choices;
    return schema;
  }
  Json formula() const {
    Json any{limited("number", key.range), {{"type", "string"}, {"minLength", 1}}};
    if (!key.constant_in_time)
      any.push_back({{"$ref", std::string("#/$defs/") + values_over_time}});
    return {{"anyOf", any}};
  }
  Json texts() const {
    Json list = list_of(text(), {});
    list["minItems"] = 1;
    list["uniqueItems"] = true;
    return {{"anyOf", {text(), list}}};
  }

  Json operator()(const bool *) const { return {{"type", "boolean"}}; }
  Json operator()(const int *) const { return integer(); }
  Json operator()(const double *) const { return number(); }
  Json operator()(const std::string *) const { return text(); }
  Json operator()(const std::vector<std::string> *) const { return texts(); }
  Json operator()(const std::vector<int> *) const { return list_of(integer(), key.length.counts); }
  Json operator()(const std::vector<double> *) const {
    return list_of(number(), key.length.counts);
  }
  Json operator()(const Matrix *) const {
    return list_of(list_of(number(), key.length.counts), {key.rows});
  }
  Json operator()(const Formula *) const { return formula(); }
  Json operator()(const FormulaVector *) const { return list_of(formula(), key.length.counts); }
  Json operator()(const Displacement *) const { return list_of(formula(), key.length.counts); }
};

/// The default as JSON; null where a list has none.
struct DefaultOf {
  template <class T>
  Json operator()(const T *value) const {
    return *value;
  }
  template <class T>
  Json operator()(const std::vector<T> *) const {
    return Json();
  }
  Json operator()(const double *value) const { return plain(*value); }
  Json operator()(const Formula *value) const {
    return value->is_number() ? plain(value->value({}, 0)) : Json(value->text());
  }
};

std::string description_of(const Key &key, const Value &value) {
  std::string text = key.description;
  if (std::holds_alternative<Formula *>(value) || std::holds_alternative<FormulaVector *>(value))
    text += "; number or formula";
  if (!key.unit.empty())
    text += " [" + key.unit + "]";
  if (!key.choices_words.empty())
    text += "; one of " + key.choices_words;
  if (!key.length.words.empty() && !std::holds_alternative<Matrix *>(value))
    text += "; entries: " + key.length.words;
  if (const std::string range = key.range.words(); !range.empty())
    text += "; " + range;
  if (const std::string sizes = key.range.sense_words(""); !sizes.empty())
    text += "; " + sizes;
  if (key.constant_in_time)
    text += "; must not depend on t";
  if (!key.used.words.empty())
    text += "; only with " + key.used.words;
  return key.default_words.empty() ? text : text + "; default: " + key.default_words;
}

}  // namespace

// Of a file, or points.
Json schema_of_values_over_time() {
  const Json name{{"type", "string"}, {"minLength", 1}};
  const Json number{
      {"anyOf", {{{"type", "number"}}, {{"$ref", std::string("#/$defs/") + number_with_unit}}}}};
  const Json point{{"type", "array"}, {"items", number}, {"minItems", 2}, {"maxItems", 2}};
  const Json points{{"type", "array"}, {"items", point}, {"minItems", 1}};
  const Json of_file{{"type", "object"},
                     {"properties", {{"table", name}, {"column", name}}},
                     {"required", {"table"}},
                     {"additionalProperties", false}};
  const Json of_points{{"type", "object"},
                       {"properties", {{"points", points}}},
                       {"required", {"points"}},
                       {"additionalProperties", false}};
  return {{"description", "values over the time t, linear between their points"},
          {"anyOf", {of_file, of_points}}};
}

Json schema_of_number_with_unit() {
  return {{"description", "a number and its unit, as in \"5 kPa\""},
          {"type", "string"},
          {"pattern",
           "^[ \\t]*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?"
           "([ \\t]+1/|[ \\t]*[^0-9 \\t.+*/^()-])"}};
}

Json schema_of_key(const Key &key, const Value &value) {
  Json schema{{"description", description_of(key, value)}};
  schema.update(std::visit(Values{key}, value));
  if (!key.required && !key.optional && key.default_words.empty())
    if (const Json standard = std::visit(DefaultOf{}, value); !standard.is_null())
      schema["default"] = standard;
  return schema;
}

}  // namespace tourmaline::casefile
