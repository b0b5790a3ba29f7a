#include "case/json_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "json_schema_key.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

/// How a body's shape is given; what a case may say elsewhere depends on it.
struct MeshKind {
  std::string given;  ///< in [mesh]
  int dimension;
};

const std::array<MeshKind, 6> mesh_kinds{
    {{"box", 2}, {"box", 3}, {"annulus", 2}, {"annulus", 3}, {"file", 2}, {"file", 3}}};

std::vector<std::string> cells_of(int dimension) {
  std::vector<std::string> names;
  for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral,
                                CellShape::tetrahedron, CellShape::hexahedron})
    if (dimension_of(shape) == dimension)
      names.emplace_back(name_of(shape));
  return names;
}

/// A key that other keys of its table may depend on.
struct Switch {
  std::string table;  ///< as a JSON pointer into the schema
  std::string key;
  std::vector<std::string> choices = {};  ///< empty: whether it is given matters
  std::string standard = {};              ///< the choice without the key
  bool sole = false;                      ///< its value may stand for the table
};

/// A switch in one position.
struct Position {
  std::string table, key;
  std::string choice = {};  ///< empty: the key is not given
};

/// What stays the same for all tables of one visit.
struct Visit {
  const MeshKind &kind;
  Position position = {};
  std::vector<Switch> switches = {};  ///< those that were met

  bool is_at(const std::string &table, const std::string &key) const {
    return position.table == table && position.key == key;
  }
};

const std::string mesh_table = "/properties/mesh";

// Of a table for which a value may stand there are two schemas, the value's first.
const std::string of_value = "/anyOf/0", of_table = "/anyOf/1";

/// One table as the declaration has it in one case.
class Table : public Visitor {
 public:
  Table(std::string path, Visit &visit, std::string sole = {})
      : path_(std::move(path)), visit_(visit), sole_(std::move(sole)) {}

  Json schema() const {
    Json all{{"type", "object"}, {"properties", properties_}, {"additionalProperties", false}};
    if (!required_.empty())
      all["required"] = required_;
    if (!one_of_.empty())
      all["oneOf"] = one_of_;
    return all;
  }

  void key(const Key &key, Value value) override {
    add(key, key.used.holds ? schema_of_key(key, value) : Json(false));
    if (const auto text = std::get_if<std::string *>(&value); text && !key.choices.empty())
      choose(key, **text);
  }

  bool given(const Key &key, bool) override {
    if (path_ == mesh_table && is_kind(key.name) && key.name != visit_.kind.given)
      return false;
    visit_.switches.push_back({path_, key.name});
    return !visit_.is_at(path_, key.name);
  }

  void table(const Key &key, const Body &body) override {
    if (!key.used.holds)
      add(key, false);
    else
      add(key, described(key, key.sole.empty() ? inner(key.name, "", body) : of_both(key, body)));
  }

  int count(const Key &, int) override { return 1; }

  void entry(const Key &key, int, const Body &body) override {
    arrays_.insert(key.name);
    if (key.may_be_table) {
      add(key, described(key, of_one_or_several(key, body)));
      return;
    }
    add(key, described(key, {{"type", "array"}, {"items", inner(key.name, "/items", body)}}));
  }

  void exactly_one(const std::vector<std::string> &names) override {
    for (const std::string &name : names) {
      Json one{{"required", {name}}};
      if (arrays_.contains(name))
        one["properties"] = {{name, {{"minItems", 1}}}};
      one_of_.push_back(one);
    }
  }

  void one_group(const std::vector<std::vector<std::string>> &groups) override {
    for (const std::vector<std::string> &group : groups) {
      Json one{{"required", group}};
      for (const std::vector<std::string> &other : groups)
        for (const std::string &name : other)
          if (std::find(group.begin(), group.end(), name) == group.end())
            one["properties"][name] = false;
      one_of_.push_back(one);
    }
  }

  void load(MeshCase &mesh) override {
    if (!mesh.file)
      return;
    MeshFile any;
    any.dimension = visit_.kind.dimension;
    mesh.content = std::make_shared<MeshFile>(any);
  }

 private:
  static bool is_kind(const std::string &name) {
    return name == "box" || name == "annulus" || name == "file";
  }

  static Json described(const Key &key, const Json &schema) {
    const std::string only = key.used.words.empty() ? "" : "; only with " + key.used.words;
    Json all{{"description", key.description + only}};
    all.update(schema);
    return all;
  }

  void add(const Key &key, const Json &schema) {
    properties_[key.name] = schema;
    if (key.required && key.used.holds)
      required_.push_back(key.name);
  }

  Json inner(const std::string &name, const std::string &suffix, const Body &body) {
    Table table(path_ + "/properties/" + name + suffix, visit_);
    body(table);
    return table.schema();
  }

  // What is said of a table's keys holds of no array, and what is said of entries of no table.
  Json of_one_or_several(const Key &key, const Body &body) {
    Json all = inner(key.name, "", body);
    all["type"] = {"object", "array"};
    all["items"] = inner(key.name, "/items", body);
    all["minItems"] = 1;
    return all;
  }

  Json of_both(const Key &key, const Body &body) {
    Table table(path_ + "/properties/" + key.name + of_table, visit_, key.sole);
    body(table);
    return {{"anyOf", {table.properties_[key.sole], table.schema()}}};
  }

  // The declaration sees the choice of this visit from here on.
  void choose(const Key &key, std::string &value) {
    if (key.optional)
      return;
    visit_.switches.push_back({path_, key.name, key.choices, value, key.name == sole_});
    if (visit_.is_at(path_, key.name))
      value = visit_.position.choice;
    else if (path_ == mesh_table + "/properties/" + visit_.kind.given && key.name == "cell")
      value = cells_of(visit_.kind.dimension).front();
  }

  std::string path_;
  Visit &visit_;
  std::string sole_;  ///< the key whose value may stand for the table
  Json properties_ = Json::object(), required_ = Json::array(), one_of_ = Json::array();
  std::set<std::string> arrays_;
};

Json visited(const Declaration &declaration, Visit &visit) {
  Case asked;
  Table root("", visit);
  declaration(root, asked);
  return root.schema();
}

Json at(const Json &schema, const std::string &pointer) {
  return schema.at(Json::json_pointer(pointer));
}

/// "If the key has one of these values", the value that it has without being there included.
Json has_choice(const std::string &key, const std::vector<std::string> &choices,
                const std::string &standard) {
  Json condition{{"properties", {{key, {{"enum", choices}}}}}};
  if (std::find(choices.begin(), choices.end(), standard) == choices.end())
    condition["required"] = {key};
  return condition;
}

void add_rule(Json &table, const Json &condition, const Json &demand) {
  if (demand.is_null())
    return;
  if (!table.contains("allOf"))
    table["allOf"] = Json::array();
  table["allOf"].push_back({{"if", condition}, {"then", demand}});
}

// A key that is not given needs no rule about itself.
Json without_key(Json demand, const std::string &key) {
  if (!demand.contains("properties"))
    return demand;
  demand["properties"].erase(key);
  if (demand["properties"].empty())
    demand.erase("properties");
  return demand.empty() ? Json() : demand;
}

/// One kind of mesh: the case with every switch as it is without its key, the switches, and what
/// their tables are in each of their positions; the first of a switch without choices is "given".
struct Variant {
  const MeshKind &kind;
  Json standard, any;
  std::vector<Switch> switches;
  std::vector<std::vector<Json>> positions;
};

std::vector<Json> positions_of(const Declaration &declaration, const Switch &turned,
                               const Variant &variant) {
  std::vector<Json> all;
  if (turned.choices.empty())
    all.push_back(at(variant.standard, turned.table));
  std::vector<std::string> choices = turned.choices;
  if (choices.empty())
    choices.emplace_back();
  for (const std::string &choice : choices) {
    Visit visit{variant.kind, {turned.table, turned.key, choice}};
    all.push_back(at(visited(declaration, visit), turned.table));
  }
  return all;
}

// Visits take time. Of two kinds with as many dimensions a table that is the same without its
// switch is the same in every position; nullptr: there is none yet.
const std::vector<Json> *known_positions(const std::vector<Variant> &earlier, const Switch &turned,
                                         const Variant &variant) {
  for (const Variant &other : earlier)
    if (other.kind.dimension == variant.kind.dimension)
      for (std::size_t i = 0; i < other.switches.size(); ++i)
        if (const Switch &same = other.switches[i];
            same.table == turned.table && same.key == turned.key &&
            same.choices == turned.choices &&
            at(other.standard, turned.table) == at(variant.standard, turned.table))
          return &other.positions[i];
  return nullptr;
}

// Alone a choice can stand for its table where the table needs no other key.
void restrict_value(Json &any, const Switch &turned, const std::vector<Json> &positions) {
  Json alone = Json::array();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Json required = positions[i].value("required", Json::array());
    if (std::all_of(required.begin(), required.end(),
                    [&](const Json &name) { return name == turned.key; }))
      alone.push_back(turned.choices[i]);
  }
  const std::string both = turned.table.substr(0, turned.table.size() - of_table.size());
  any.at(Json::json_pointer(both + of_value))["enum"] = alone;
}

Variant variant_of(const Declaration &declaration, const MeshKind &kind,
                   const std::vector<Variant> &earlier) {
  Visit visit{kind};
  Variant variant{kind, visited(declaration, visit), {}, {}, {}};
  variant.any = variant.standard;
  std::set<std::pair<std::string, std::string>> seen;
  for (const Switch &turned : visit.switches)
    if (seen.emplace(turned.table, turned.key).second) {
      variant.switches.push_back(turned);
      const std::vector<Json> *known = known_positions(earlier, turned, variant);
      variant.positions.push_back(known ? *known : positions_of(declaration, turned, variant));
      Json &table = variant.any.at(Json::json_pointer(turned.table));
      for (const Json &position : variant.positions.back())
        table = merged(table, position);
      if (turned.sole)
        restrict_value(variant.any, turned, variant.positions.back());
    }
  return variant;
}

/// A switch in all kinds of meshes that have it.
struct SharedSwitch {
  Switch turned;                             ///< with the choices of all
  std::vector<std::vector<Json>> of_choice;  ///< by position, the table in each of the kinds
};

void add(SharedSwitch &shared, const Switch &turned, const std::vector<Json> &positions) {
  std::vector<std::string> &known = shared.turned.choices;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::size_t place = i;
    if (!turned.choices.empty()) {
      const auto found = std::find(known.begin(), known.end(), turned.choices[i]);
      place = static_cast<std::size_t>(found - known.begin());
      if (found == known.end())
        known.push_back(turned.choices[i]);
    }
    shared.of_choice.resize(std::max(shared.of_choice.size(), place + 1));
    shared.of_choice[place].push_back(positions[i]);
  }
}

std::vector<SharedSwitch> shared_switches(const std::vector<Variant> &variants) {
  std::vector<SharedSwitch> all;
  for (const Variant &variant : variants)
    for (std::size_t i = 0; i < variant.switches.size(); ++i) {
      const Switch &turned = variant.switches[i];
      auto shared = std::find_if(all.begin(), all.end(), [&](const SharedSwitch &other) {
        return other.turned.table == turned.table && other.turned.key == turned.key;
      });
      if (shared == all.end())
        shared = all.insert(all.end(), {turned, {}});
      add(*shared, turned, variant.positions[i]);
    }
  return all;
}

Json merged_all(const std::vector<Json> &schemas) {
  Json all = schemas.front();
  for (const Json &schema : schemas)
    all = merged(all, schema);
  return all;
}

void add_rules_of_choices(Json &table, const Switch &turned, const std::vector<Json> &demands) {
  std::vector<bool> told(demands.size(), false);
  for (std::size_t i = 0; i < demands.size(); ++i) {
    std::vector<std::string> alike;
    for (std::size_t j = i; j < demands.size(); ++j)
      if (!told[j] && demands[j] == demands[i]) {
        alike.push_back(turned.choices[j]);
        told[j] = true;
      }
    if (!alike.empty())
      add_rule(table, has_choice(turned.key, alike, turned.standard), demands[i]);
  }
}

// What the position of the switch demands of its table, whatever the mesh.
void add_rules(Json &schema, const SharedSwitch &shared) {
  std::vector<Json> positions;
  for (const std::vector<Json> &of_kinds : shared.of_choice)
    positions.push_back(merged_all(of_kinds));
  const Json any = merged_all(positions);
  std::vector<Json> demands(positions.size());
  std::transform(positions.begin(), positions.end(), demands.begin(),
                 [&](const Json &position) { return beyond(any, position); });
  const Switch &turned = shared.turned;
  Json &table = schema.at(Json::json_pointer(turned.table));
  if (!turned.choices.empty())
    add_rules_of_choices(table, turned, demands);
  else
    add_rule(table, {{"not", {{"required", {turned.key}}}}}, without_key(demands[1], turned.key));
}

Json without_mesh(Json schema) {
  schema["properties"].erase("mesh");
  return schema;
}

// A mesh file's dimension and names are not in the case.
void add_mesh_rule(Json &schema, const MeshKind &kind, const Json &any, const Json &special) {
  if (kind.given == "file")
    return;
  const Json cell = has_choice("cell", cells_of(kind.dimension), name_of(CellShape::triangle));
  const Json condition{
      {"required", {"mesh"}},
      {"properties",
       {{"mesh", {{"required", {kind.given}}, {"properties", {{kind.given, cell}}}}}}}};
  add_rule(schema, condition, beyond(without_mesh(any), without_mesh(special)));
}

Json complete(const Declaration &declaration) {
  std::vector<Variant> variants;
  std::vector<Json> all;
  for (const MeshKind &kind : mesh_kinds) {
    variants.push_back(variant_of(declaration, kind, variants));
    all.push_back(variants.back().any);
  }
  const Json any = merged_all(all);
  Json schema = any;
  for (const SharedSwitch &shared : shared_switches(variants))
    add_rules(schema, shared);
  for (const Variant &variant : variants)
    add_mesh_rule(schema, variant.kind, any, variant.any);
  return schema;
}

}  // namespace

std::string json_schema(const Declaration &declaration) {
  Json schema{
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"$id", fmt::format("urn:tourmaline:case-file:{}", schema_version)},
      {"version", schema_version},
      {"title", "Tourmaline case file"},
      {"description",
       "All values are SI; temperatures are differences to the reference temperature. Printed by "
       "`tourmaline schema`. What a case must satisfy beyond this schema, `tourmaline check` "
       "says."}};
  schema.update(complete(declaration));
  schema["$defs"] = {{values_over_time, schema_of_values_over_time()},
                     {number_with_unit, schema_of_number_with_unit()}};
  return schema.dump(2) + "\n";
}

std::string json_schema() {
  return json_schema([](Visitor &visitor, Case &asked) { declare(visitor, asked); });
}

}  // namespace tourmaline::casefile
