#include "run/plausibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "material/completeness.h"
#include "material/library.h"
#include "run/survey.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"

#include "../cases/run_case.h"
#include "../material/ceramic.h"

namespace tourmaline::run {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using tourmaline::verified::ceramic;
using tourmaline::verified::RunCase;
namespace fs = std::filesystem;

const fs::path repository(TOURMALINE_SOURCE_DIR);

casefile::Case of(const std::vector<casefile::MaterialCase> &materials) {
  casefile::Case asked;
  asked.dimension = 3;
  if (materials.size() == 1) {
    asked.material = materials.front();
    return asked;
  }
  for (const casefile::MaterialCase &material : materials) {
    casefile::RegionCase region;
    region.on = {"part" + std::to_string(asked.regions.size())};
    region.material = material;
    asked.regions.push_back(region);
  }
  return asked;
}

// With thermal constants, which most sources do not give.
casefile::MaterialCase completed(const std::string &name) {
  casefile::MaterialCase asked;
  asked.library = name;
  for (const std::string &constant : material::missing_constants(material::with_entry(asked)))
    asked.constants[constant] = constant == "specific_heat" ? 400 : constant[0] == 'k' ? 1 : 1e-6;
  return asked;
}

TEST(Plausibility, NoMaterialOfTheLibraryIsSuspicious) {
  for (const material::Entry &entry : material::library())
    EXPECT_THAT(material_warnings(of({completed(entry.name)})), IsEmpty()) << entry.name;
}

TEST(Plausibility, NoTwoMaterialsOfTheLibraryAreSuspiciousTogether) {
  for (const material::Entry &one : material::library())
    for (const material::Entry &other : material::library())
      EXPECT_THAT(material_warnings(of({completed(one.name), completed(other.name)})), IsEmpty())
          << one.name << " and " << other.name;
}

TEST(Plausibility, NoCaseOfTheRepositoryIsSuspicious) {
  int n_cases = 0;
  for (const auto &file : fs::recursive_directory_iterator(repository / "cases"))
    if (file.path().extension() == ".toml") {
      ++n_cases;
      const auto asked = casefile::read_file(file.path(), {}, mesh::read_mesh_file);
      EXPECT_THAT(material_warnings(asked), IsEmpty()) << file.path();
    }
  EXPECT_GE(n_cases, 20);
}

casefile::MaterialCase scaled(casefile::MaterialCase asked, char letter, double factor) {
  for (auto &[key, value] : asked.constants)
    if (key[0] == letter && std::isdigit(static_cast<unsigned char>(key[1])))
      value *= factor;
  return asked;
}

TEST(Plausibility, StiffnessInGigapascalsCouplesTooStrongly) {
  EXPECT_THAT(material_warnings(of({ceramic()})), IsEmpty());
  EXPECT_THAT(material_warnings(of({scaled(ceramic(), 'c', 1e-9)})),
              ElementsAre(AllOf(HasSubstr("coupling factor is 1, and no known material"),
                                HasSubstr("1 GPa = 1e9 Pa"))));
}

TEST(Plausibility, OneConstantInGigapascalsStandsOut) {
  casefile::MaterialCase plain = scaled(ceramic(), 'e', 1);
  for (const char *key : {"e31", "e33", "e15"})
    plain.constants.erase(key);
  EXPECT_THAT(material_warnings(of({plain})), IsEmpty());
  plain.constants["c44"] = 23;
  EXPECT_THAT(
      material_warnings(of({plain})),
      ElementsAre(HasSubstr("the stiffness c11 = 1.27e+11 Pa is 5.5e+09 times c44 = 23 Pa")));
}

TEST(Plausibility, OneMaterialInOtherUnitsThanAnotherStandsOut) {
  casefile::MaterialCase steel;
  steel.symmetry = "isotropic";
  steel.conductor = true;
  steel.constants = {{"young", 200e9},  {"poisson", 0.3},       {"k11", 50},
                     {"density", 7800}, {"specific_heat", 500}, {"reference_temperature", 293}};
  EXPECT_THAT(material_warnings(of({ceramic(), steel})), IsEmpty());
  steel.constants["young"] = 200;
  EXPECT_THAT(material_warnings(of({ceramic(), steel})),
              ElementsAre(HasSubstr("times as stiff as region \"part1\"")));
  // Rubber that is nearly incompressible is softer in shear by far, and not in other units.
  steel.constants["young"] = 1e6;
  steel.constants["poisson"] = 0.49999;
  EXPECT_THAT(material_warnings(of({ceramic(), steel})), IsEmpty());
}

TEST(Plausibility, ConstantsPerStressThatAreTooLargeAreNamedAsTheCause) {
  casefile::MaterialCase sheet = ceramic();
  for (const char *key : {"e31", "e33", "e15", "eps11", "eps33"})
    sheet.constants.erase(key);
  sheet.constants.insert({{"d31", -2.74e-10},
                          {"d33", 5.93e-10},
                          {"d15", 7.41e-10},
                          {"eps11_T", 3130},
                          {"eps33_T", 3400}});
  EXPECT_THAT(material_warnings(of({sheet})), IsEmpty());
  for (const char *key : {"d31", "d33", "d15"})
    sheet.constants[key] *= 1e12;
  try {
    material_warnings(of({sheet}));
    FAIL() << "d in pC/N passed";
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("eps^T - d c d^T, is not positive definite"),
                                    HasSubstr("piezoelectric constants are too large"),
                                    HasSubstr("1 pC/N = 1e-12 C/N"), HasSubstr("coupling factor")));
  }
}

TEST(Plausibility, ConstantsInOtherUnitsThanTheirsStandOut) {
  const auto with = [](const std::string &key, double value) {
    casefile::MaterialCase material = ceramic();
    material.constants[key] = value;
    return material_warnings(of({material}));
  };
  casefile::MaterialCase relative = ceramic();
  relative.constants.erase("eps11");
  relative.constants.erase("eps33");
  relative.constants["beta11"] = 1704;
  relative.constants["beta33"] = 1434;
  EXPECT_THAT(material_warnings(of({relative})),
              ElementsAre(HasSubstr("relative permittivities are given as eps11")));
  EXPECT_THAT(with("density", 7.5), ElementsAre(HasSubstr("1 g/cm^3 = 1000 kg/m^3")));
  EXPECT_THAT(with("reference_temperature", 20), ElementsAre(HasSubstr("absolute")));
  EXPECT_THAT(with("reference_temperature", 77), IsEmpty());
}

const std::string beam = "tests/cases/ill_conditioned/beam.toml";

// The beam as a strip of half a metre's height, pulled.
std::vector<std::string> strip(const std::vector<std::string> &overrides) {
  std::vector<std::string> all{"mesh.box.max=[1,0.5]",
                               "boundary[1]={on=\"left\",displacement=[\"0.2*t\",0]}"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return all;
}

casefile::Case strip_case(const std::vector<std::string> &overrides) {
  return casefile::read_file(repository / beam, strip(overrides), mesh::read_mesh_file);
}

std::vector<std::string> warnings_of(const std::vector<std::string> &overrides) {
  const RunCase run(beam, strip(overrides));
  return run.summary()["warnings"].get<std::vector<std::string>>();
}

TEST(Plausibility, StrainsThatALinearTheoryDoesNotKnowAreTold) {
  EXPECT_THAT(warnings_of({}), ElementsAre(HasSubstr("strains reach 0.2")));
  EXPECT_THAT(warnings_of({"boundary[1].displacement=[\"0.02*t\",0]"}), IsEmpty());
  EXPECT_THAT(warnings_of({"solver.method=monolithic"}), ElementsAre(HasSubstr("strains reach")));
  EXPECT_THAT(warnings_of({"solver.body=iterative"}), ElementsAre(HasSubstr("strains reach")));
}

TEST(Plausibility, StrainsThatHaveGoneAtTheEndAreToldWithTheirMoment) {
  EXPECT_THAT(warnings_of({"time={end=1,steps=4}", "boundary[1].displacement=[\"0.8*t*(1-t)\",0]"}),
              ElementsAre(AllOf(HasSubstr("strains reach 0.2"), HasSubstr("(step 2, t = 0.5 s)"))));
}

TEST(Survey, TellsTheClassOfAnEntryThatDoesNotSayIt) {
  const casefile::Case asked = strip_case({"material={library=\"BaTiO3-Liu2014\"}"});
  EXPECT_THAT(survey(asked), HasSubstr("# (the whole body), BaTiO3-Liu2014, class 6mm: piezo"));
}

TEST(Plausibility, ARunAndItsCheckTellTheSameOfTheMaterial) {
  const std::vector<std::string> soft{
      "material={c11=127,c12=80,c13=85,c33=117,c44=23,e31=-6.6,"
      "e33=23,e15=17,eps11=1704,eps33=1434,k11=1,k33=1,"
      "density=7500,specific_heat=420,reference_temperature=293}",
      "boundary[1].displacement=[0,0]"};
  EXPECT_THAT(warnings_of(soft),
              ElementsAre(HasSubstr("material of the case: the electromechanical "
                                    "coupling factor is 1")));
  EXPECT_THAT(survey(strip_case(soft)),
              HasSubstr("# warning: material of the case: the electromechanical coupling factor"));
}

}  // namespace
}  // namespace tourmaline::run
