#include "case/json_schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/schema.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {
namespace {

using Json = nlohmann::json;

// The case file with one table more, [model], where a choice that only two dimensions have, and one
// that only three have, bring a key of their own each.
void declare_with_model(Visitor &visitor, Case &asked) {
  declare(visitor, asked);
  std::string shape = "plain";
  double offset = 1, thickness = 1;
  visitor.table({.name = "model", .description = "a table of the test"}, [&](Visitor &model) {
    shape = "plain";
    model.key({.name = "shape",
               .description = "",
               .choices = asked.dimension == 2 ? std::vector<std::string>{"plain", "round"}
                                               : std::vector<std::string>{"plain", "thin"}},
              &shape);
    model.key({.name = "offset", .description = "", .used = with("shape", shape, {"round"})},
              &offset);
    model.key({.name = "thickness",
               .description = "",
               .required = true,
               .used = with("shape", shape, {"thin"})},
              &thickness);
  });
}

const Json &schema_with_model() {
  static const Json schema = Json::parse(json_schema(declare_with_model));
  return schema;
}

// What the rules of `table` demand where its key has that choice.
std::vector<Json> demands(const Json &table, const std::string &key, const std::string &choice) {
  std::vector<Json> all;
  for (const Json &rule : table.value("allOf", Json::array())) {
    const Json &condition = rule.at("if");
    if (!condition.contains("properties") || !condition["properties"].contains(key))
      continue;
    for (const Json &value : condition["properties"][key].at("enum"))
      if (value == choice)
        all.push_back(rule.at("then"));
  }
  return all;
}

TEST(JsonSchema, AKeyOfAChoiceThatDependsOnTheDimensionIsPossible) {
  const Json schema = schema_with_model();
  const Json model = schema.at("properties").at("model");
  EXPECT_EQ(model.at("properties").at("offset").at("type"), "number");
  EXPECT_EQ(model.at("properties").at("thickness").at("type"), "number");
  EXPECT_FALSE(model.contains("required"));
  EXPECT_THAT(model.at("properties").at("shape").at("enum"),
              testing::UnorderedElementsAre("plain", "round", "thin"));
}

TEST(JsonSchema, AKeyIsRefusedBesideTheChoicesThatDoNotUseIt) {
  const Json model = schema_with_model().at("properties").at("model");
  const Json no_key = false;
  const auto plain = demands(model, "shape", "plain");
  ASSERT_EQ(plain.size(), 1u);
  EXPECT_EQ(plain[0].at("properties").at("offset"), no_key);
  EXPECT_EQ(plain[0].at("properties").at("thickness"), no_key);
  const auto round = demands(model, "shape", "round");
  ASSERT_EQ(round.size(), 1u);
  EXPECT_FALSE(round[0].at("properties").contains("offset"));
  EXPECT_EQ(round[0].at("properties").at("thickness"), no_key);
  const auto thin = demands(model, "shape", "thin");
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_EQ(thin[0].at("required"), Json({"thickness"}));
}

TEST(JsonSchema, EveryKindOfMeshHasItsOwnChoices) {
  int rules = 0;
  for (const Json &rule : schema_with_model().at("allOf")) {
    const Json properties = rule.at("then").value("properties", Json::object());
    if (!properties.contains("model"))
      continue;
    ++rules;
    const Json &model = properties["model"]["properties"];
    const bool plane =
        model.at("shape").at("enum").size() == 2 && model.at("shape").at("enum").at(1) == "round";
    EXPECT_EQ(model.value("offset", Json(true)), Json(plane)) << rule.dump(2);
    EXPECT_EQ(model.value("thickness", Json(true)), Json(!plane)) << rule.dump(2);
  }
  EXPECT_EQ(rules, 4);  // boxes and annuli in two and three dimensions
}

TEST(JsonSchema, OnlyAChoiceThatNeedsNoOtherKeyCanStandForItsTable) {
  const Json schema = Json::parse(json_schema());
  const Json both = schema.at(Json::json_pointer("/properties/contact/properties/normal/anyOf"));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].at("enum"), Json({"bilateral", "unilateral"}));
  EXPECT_EQ(both[1].at("type"), "object");
  EXPECT_EQ(both[1].at("properties").at("law").at("enum").size(), 4u);
  const auto damped = demands(both[1], "law", "damped");
  ASSERT_EQ(damped.size(), 1u);
  EXPECT_EQ(damped[0].at("required"), Json({"coefficient"}));
  EXPECT_EQ(damped[0].at("properties").at("exponent"), Json(false));
}

TEST(Use, IsSaidByTheSameWordsAsItIsDecided) {
  const Use use = with("law", "tresca", {"tresca", "coulomb"});
  EXPECT_TRUE(use.holds);
  EXPECT_EQ(use.words, "law = \"tresca\" or \"coulomb\"");
  EXPECT_FALSE(with("law", "none", {"tresca"}).holds);
}

}  // namespace
}  // namespace tourmaline::casefile
