#include "material/completeness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "complaint.h"
#include "material/composition.h"
#include "material/constants.h"
#include "material/description.h"
#include "material/library.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::material {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Names = std::vector<std::string>;

// Polyvinylidene fluoride as a data sheet has it, complete.
casefile::MaterialCase film() {
  casefile::MaterialCase asked;
  asked.constants = {{"s11", 5e-10},
                     {"s12", -1.45e-10},
                     {"s13", -1.45e-10},
                     {"s33", 5e-10},
                     {"s44", 1.3e-9},
                     {"d31", 2.2e-11},
                     {"d33", -3.0e-11},
                     {"d15", -2e-11},
                     {"eps11_T", 12},
                     {"eps33_T", 12},
                     {"a11", 1e-4},
                     {"a33", 1e-4},
                     {"p3", -2e-5},
                     {"k11", 0.2},
                     {"k33", 0.2},
                     {"density", 1780},
                     {"specific_heat", 1200},
                     {"reference_temperature", 293}};
  return asked;
}

casefile::MaterialCase film_without(const Names &constants) {
  casefile::MaterialCase asked = film();
  for (const std::string &constant : constants)
    EXPECT_EQ(asked.constants.erase(constant), 1u) << constant;
  return asked;
}

TEST(Completeness, AMaterialWithAllConstantsOfItsClassLacksNone) {
  EXPECT_THAT(missing_constants(film()), IsEmpty());
  EXPECT_EQ(complaint(film()), "");
}

TEST(Completeness, NoConstantOfAMaterialBecomesZeroByBeingForgotten) {
  for (const auto &[constant, value] : film().constants) {
    if (constant == "p3")
      continue;  // the only one of its kind: without it the material is not pyroelectric
    EXPECT_THAT(missing_constants(film_without({constant})), ElementsAre(constant));
    EXPECT_THAT(complaint(film_without({constant})), HasSubstr(constant)) << constant;
  }
}

TEST(Completeness, WholeKindsOfCouplingsMayBeLeftOut) {
  const auto plain = film_without({"d31", "d33", "d15", "a11", "a33", "p3"});
  EXPECT_EQ(complaint(plain), "");
  EXPECT_EQ(couplings(constants_of(plain)),
            "not piezoelectric, not pyroelectric, without thermal expansion");
  EXPECT_EQ(couplings(constants_of(film())), "piezoelectric, pyroelectric, with thermal expansion");
  EXPECT_EQ(couplings(constants_of(film_without({"p3"}))),
            "piezoelectric, not pyroelectric, with thermal expansion");
}

TEST(Completeness, AllThatIsMissingIsSaidAtOnce) {
  casefile::MaterialCase empty;
  EXPECT_THAT(missing_constants(empty),
              ElementsAre("c11", "c12", "c13", "c33", "c44", "beta11", "beta33", "k11", "k33",
                          "density", "specific_heat", "reference_temperature"));
  const std::string said = complaint(empty);
  for (const std::string &constant : missing_constants(empty))
    EXPECT_THAT(said, HasSubstr(constant));
  EXPECT_THAT(complaint(film_without({"d31", "d15", "density"})),
              HasSubstr("lacks: piezoelectric constants d31, d15 (d33 is given; all of this kind "
                        "and form, or none); density. Give them"));
}

casefile::MaterialCase named(const std::string &entry, std::map<std::string, double> constants) {
  casefile::MaterialCase asked;
  asked.library = entry;
  asked.constants = std::move(constants);
  return asked;
}

casefile::Case in_regions(const std::vector<casefile::MaterialCase> &materials) {
  casefile::Case asked;
  asked.dimension = 2;
  int line = 0;
  for (const casefile::MaterialCase &material : materials) {
    casefile::RegionCase region;
    region.material = material;
    region.material.where = "case.toml:" + std::to_string(++line) + ":1 [region.material]";
    asked.regions.push_back(region);
  }
  return asked;
}

std::string complaint_of_all(const casefile::Case &asked) {
  try {
    Composition<2>{asked};
  } catch (const CaseError &error) {
    return error.what();
  }
  return "";
}

TEST(Completeness, AllThatIsMissingOfAllRegionsIsSaidAtOnce) {
  const casefile::MaterialCase entry = named("BaTiO3-Liu2014", {{"d31", -4e-11}});
  const std::string said =
      complaint_of_all(in_regions({film_without({"density"}), film(), entry,
                                   film_without({"density"}), film_without({"d31", "k11"})}));
  EXPECT_THAT(said, testing::StartsWith("case.toml:1:1 [region.material], case.toml:4:1 "
                                        "[region.material] the material, class 6mm, lacks: "
                                        "density"));
  EXPECT_THAT(said, HasSubstr("; and case.toml:3:1 [region.material] \"BaTiO3-Liu2014\", class "
                              "6mm, lacks: piezoelectric constants d33, d15"));
  EXPECT_THAT(said, HasSubstr("; and case.toml:5:1 [region.material] the material, class 6mm, "
                              "lacks: piezoelectric constants d31"));
  EXPECT_THAT(said, HasSubstr("thermal conductivity k11"));
  EXPECT_THAT(said, testing::Not(HasSubstr("case.toml:2:1")));
  EXPECT_THAT(said, testing::EndsWith("Give them beside `library`, or a library entry that has "
                                      "them (`tourmaline materials` lists them); a field that "
                                      "[model] leaves out (`thermal = false`, `electric = false`) "
                                      "needs none"));
}

TEST(Completeness, ClassesHaveTheirOwnConstants) {
  casefile::MaterialCase crystal;
  crystal.symmetry = "mm2";
  crystal.constants = {{"e31", 1}, {"m11", 1}};
  EXPECT_THAT(missing_constants(crystal),
              testing::IsSupersetOf({"e32", "e33", "e24", "e15", "m22", "m33", "c66", "k22"}));
  crystal.symmetry = "isotropic";
  crystal.constants = {{"young", 1}};
  EXPECT_THAT(missing_constants(crystal), ElementsAre("poisson", "beta11", "k11", "density",
                                                      "specific_heat", "reference_temperature"));
}

TEST(Completeness, AWholeTensorSaysAllOfItsKind) {
  casefile::MaterialCase asked = film_without({"d31", "d33", "d15"});
  asked.piezoelectric = std::vector<std::vector<double>>(3, std::vector<double>(6, 0.1));
  EXPECT_THAT(missing_constants(asked), IsEmpty());
}

TEST(Completeness, OneConstantOverridesThatOfAnEntryInItsForm) {
  casefile::MaterialCase asked;
  asked.library = "BaTiO3-Liu2014";
  asked.constants = {{"e31", -4}};
  EXPECT_EQ(constants_of(asked).piezoelectric(2, 0), -4);
  EXPECT_EQ(constants_of(asked).piezoelectric(2, 2), 18.6);
}

TEST(Completeness, OneConstantInAnotherFormThanTheEntrysNeedsTheOthers) {
  casefile::MaterialCase asked;
  asked.library = "BaTiO3-Liu2014";
  asked.constants = {{"d31", -4e-11}};
  EXPECT_THAT(complaint(asked), HasSubstr("piezoelectric constants d33, d15 (d31 is given"));
}

TEST(Completeness, AConductorNeedsNoElectricConstants) {
  casefile::MaterialCase metal = film_without({"d31", "d33", "d15", "eps11_T", "eps33_T", "p3"});
  metal.conductor = true;
  EXPECT_THAT(missing_constants(metal), IsEmpty());
  EXPECT_EQ(couplings(constants_of(metal)), "a conductor, with thermal expansion");
}

TEST(MaterialsCommand, SaysOfEveryEntryWhetherACaseCanUseItAsItIs) {
  const auto list = nlohmann::json::parse(library_json());
  ASSERT_EQ(list.size(), library().size());
  for (const auto &entry : list) {
    casefile::MaterialCase asked;
    asked.library = entry.at("name");
    EXPECT_EQ(entry.at("complete").get<bool>(), complaint(asked).empty()) << entry.at("name");
    for (const auto &missing : entry.at("missing"))
      asked.constants[missing.at("key")] = missing.at("key") == "specific_heat" ? 400
                                           : missing.at("unit") == "W/(K m)"    ? 1
                                                                                : 1e-6;
    EXPECT_EQ(complaint(asked), "") << entry.at("name") << " with what it lacks";
    EXPECT_THAT(describe_library(), HasSubstr(entry.at("name").get<std::string>()));
  }
  EXPECT_THAT(describe_library(), HasSubstr("add a11, a33, p3, k11, k33, specific_heat"));
  EXPECT_THAT(describe_library(), HasSubstr("6mm        complete"));
}

TEST(MaterialsCommand, ShowsWhatThereIsOfAnUnfinishedEntry) {
  const auto file = std::filesystem::path(testing::TempDir()) / "tourmaline-unfinished.toml";
  std::ofstream(file) << "[half]\nsource = \"data sheet\"\nc11 = 1e11\n"
                         "[unstable]\nsource = \"data sheet\"\nsymmetry = \"cubic\"\n"
                         "c11 = 1e11\nc12 = 2e11\nc44 = 1e11\neps11 = 5\n";
  casefile::MaterialCase asked;
  asked.file = file.string();
  asked.library = "half";
  EXPECT_THAT(describe(asked),
              AllOf(HasSubstr("1e+11  Pa"), HasSubstr("elastic constants: c12 [Pa], c13 [Pa]")));
  asked.library = "unstable";
  EXPECT_THAT(describe(asked), AllOf(HasSubstr("2e+11  Pa"), HasSubstr("not positive definite"),
                                     HasSubstr("density [kg/m^3]")));
  const auto entry = nlohmann::json::parse(entry_json(asked));
  EXPECT_FALSE(entry.at("complete").get<bool>());
  EXPECT_EQ(entry.at("constants").at("c12"), 2e11);
  asked.file.reset();
  asked.library = "PVDF";
  const auto of_library = nlohmann::json::parse(entry_json(asked));
  EXPECT_FALSE(of_library.at("complete").get<bool>());
  EXPECT_EQ(of_library.at("missing").size(), 8u);
  std::filesystem::remove(file);
}

TEST(MaterialsCommand, ShowsTheEntriesOfAFileBesideThoseThatAreWrong) {
  const auto file = std::filesystem::path(testing::TempDir()) / "tourmaline-mixed.toml";
  const std::string isotropic =
      "symmetry = \"isotropic\"\nyoung = 1e9\npoisson = 0.3\neps11 = 10\ndensity = 1000\n"
      "specific_heat = 1000\nreference_temperature = 293\n";
  std::ofstream(file) << "[whole]\nsource = \"data sheet\"\nk11 = 1\n" + isotropic +
                             "[sourceless]\n" + isotropic +
                             "[misspelt]\nsource = \"data sheet\"\nk1l = 1\npoison = 1\n" +
                             isotropic;
  const std::string list = describe_library(file.string());
  EXPECT_THAT(list, testing::ContainsRegex("whole +isotropic +complete +data sheet\n"));
  EXPECT_THAT(list,
              testing::ContainsRegex("sourceless +isotropic +add k11; cannot be used: .*:11:1 "
                                     "\\[sourceless\\] source: missing, but must be given"));
  EXPECT_THAT(list, testing::ContainsRegex("misspelt .*cannot be used: .*:21:1 .*k1l = 1: unknown "
                                           "key.* and .*:22:1 .*poison = 1: unknown key"));
  const auto json = nlohmann::json::parse(library_json(file.string()));
  ASSERT_EQ(json.size(), 3u);
  for (const auto &entry : json) {
    EXPECT_EQ(entry.at("complete").get<bool>(), entry.at("name") == "whole");
    EXPECT_EQ(entry.contains("mistake"), entry.at("name") != "whole");
  }
  casefile::MaterialCase asked;
  asked.file = file.string();
  asked.library = "whole";
  EXPECT_EQ(complaint(asked), "");
  EXPECT_THAT(describe(asked), HasSubstr("data sheet"));
  asked.library = "misspelt";
  EXPECT_THAT(complaint(asked), AllOf(HasSubstr("k1l = 1"), HasSubstr("poison = 1")));
  asked.library = "sourceless";
  EXPECT_THAT(complaint(asked), HasSubstr("source: missing, but must be given"));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace tourmaline::material
