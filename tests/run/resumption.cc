#include "run/resumption.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "case/resolved.h"
#include "output/summary.h"
#include "run/versions.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::run {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

class Resuming : public ::testing::Test {
 protected:
  Resuming() {
    std::string name = ::testing::TempDir() + "/tourmaline-XXXXXX";
    folder_ = mkdtemp(name.data());
    asked_.title = "a run";
    asked_.output.every = 1;
    asked_.mesh.file = "/body.msh";
    mesh_->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh_->cells = {0, 1, 2};
    mesh_->boundaries.names = {"side"};
    asked_.mesh.content = mesh_;
    asked_.material.file = folder_ / "materials.toml";
    put("materials.toml", "[one]\n");
  }
  ~Resuming() override { std::filesystem::remove_all(folder_); }

  void put(const std::string &name, const std::string &text) const {
    std::ofstream(folder_ / name) << text;
  }
  void save(const std::string &program = program_version()) const {
    output::Checkpoint checkpoint;
    checkpoint.program = program;
    checkpoint.inputs = inputs_of(asked_);
    checkpoint.step = 3;
    output::write_checkpoint(folder_ / output::checkpoint_name, checkpoint);
  }
  auto asking() const {
    return [this] { resumption(asked_, folder_); };
  }

  std::filesystem::path folder_;
  std::shared_ptr<casefile::MeshFile> mesh_ = std::make_shared<casefile::MeshFile>();
  casefile::Case asked_;
};

TEST_F(Resuming, TheSameCaseGoesOn) {
  save();
  const Resumption found = resumption(asked_, folder_);
  ASSERT_TRUE(found.checkpoint);
  EXPECT_EQ(found.checkpoint->step, 3u);
  EXPECT_FALSE(found.is_complete());
}

TEST_F(Resuming, AFolderWithoutCheckpointAndSummaryHoldsNothing) {
  const Resumption found = resumption(asked_, folder_ / "later");
  EXPECT_FALSE(found.checkpoint);
  EXPECT_FALSE(found.is_complete());
}

TEST_F(Resuming, FrictionLawsOfAProgramGoOnUnderTheirNameOnly) {
  output::Checkpoint checkpoint;
  checkpoint.program = program_version();
  checkpoint.inputs = inputs_of(asked_, "nap, along = 5");
  output::write_checkpoint(folder_ / output::checkpoint_name, checkpoint);
  EXPECT_NO_THROW(resumption(asked_, folder_, "nap, along = 5"));
  EXPECT_THAT(asking(), ThrowsMessage<CaseError>(HasSubstr(
                            "the friction law was \"nap, along = 5\" of a program, is that of the "
                            "case")));
  EXPECT_THAT([&] { resumption(asked_, folder_, "nap, along = 6"); },
              ThrowsMessage<CaseError>(HasSubstr("is \"nap, along = 6\" of a program")));
  save();
  EXPECT_THAT([&] { resumption(asked_, folder_, "nap, along = 5"); },
              ThrowsMessage<CaseError>(HasSubstr("the friction law was that of the case, is")));
}

TEST_F(Resuming, AMeshThatHasChangedBehindItsNameIsAnotherCase) {
  const auto refused = ThrowsMessage<CaseError>(
      AllOf(HasSubstr("the content of /body.msh has changed"), Not(HasSubstr("materials"))));
  save();
  mesh_->points[1][0] = 1.0000000001;
  EXPECT_THAT(asking(), refused);
  mesh_->points[1][0] = 1;
  EXPECT_NO_THROW(asking()());
  mesh_->boundaries.names[0] = "top";
  EXPECT_THAT(asking(), refused);
}

TEST_F(Resuming, AFileOfMaterialsThatHasChangedIsAnotherCase) {
  save();
  put("materials.toml", "[two]\n");
  EXPECT_THAT(asking(), ThrowsMessage<CaseError>(AllOf(HasSubstr("materials.toml has changed"),
                                                       Not(HasSubstr("body.msh")))));
}

TEST_F(Resuming, EveryKeyThatDiffersIsToldButTheIntervalOfCheckpoints) {
  save();
  asked_.output.checkpoint = "1 h";
  EXPECT_NO_THROW(asking()());
  asked_.title = "another";
  asked_.time.steps = 7;
  EXPECT_THAT(asking(), ThrowsMessage<CaseError>(AllOf(
                            HasSubstr("title was \"a run\", is \"another\""),
                            HasSubstr("time.steps was 1, is 7"), Not(HasSubstr("checkpoint")))));
}

TEST_F(Resuming, AnotherVersionOfTheProgramDoesNotGoOn) {
  save("0.0.1");
  EXPECT_THAT(asking(), ThrowsMessage<MachineError>(
                            AllOf(HasSubstr("Tourmaline 0.0.1"), HasSubstr(program_version()))));
}

class Complete : public Resuming {
 protected:
  Complete() {
    summarise({});
    put("resolved.toml", casefile::resolved(asked_));
    put("report.html", "");
  }

  void summarise(const std::map<std::string, std::uint64_t> &files, int ranks = 1) {
    output::Summary summary;
    summary.inputs = contents_of(asked_);
    summary.files = files;
    summary.sizes = {{"ranks", ranks}};
    put("summary.json", output::summary_text(2, summary));
  }
  std::string warning() const { return resumption(asked_, folder_).warning; }
};

TEST_F(Complete, OfTheSameCaseHasNothingToDo) {
  EXPECT_TRUE(resumption(asked_, folder_).is_complete());
  asked_.title = "another";
  EXPECT_THAT(asking(), ThrowsMessage<CaseError>(HasSubstr("title was")));
}

TEST_F(Complete, ItsFilesAreComparedToo) {
  mesh_->points[1][0] = 1.0000000001;
  EXPECT_THAT(asking(),
              ThrowsMessage<CaseError>(HasSubstr("the content of /body.msh has changed")));
  mesh_->points[1][0] = 1;
  put("materials.toml", "[two]\n");
  EXPECT_THAT(asking(), ThrowsMessage<CaseError>(HasSubstr("materials.toml has changed")));
  put("materials.toml", "[one]\n");
  EXPECT_TRUE(resumption(asked_, folder_).is_complete());
}

TEST_F(Complete, WithFrictionLawsOfAProgramItIsOneOfTheirs) {
  put("resolved.toml", casefile::resolved_with_law(asked_, "nap, along = 5"));
  EXPECT_TRUE(resumption(asked_, folder_, "nap, along = 5").is_complete());
  EXPECT_THAT(asking(),
              ThrowsMessage<CaseError>(HasSubstr("the friction law was \"nap, along = 5\"")));
}

TEST_F(Complete, WithoutItsPageTheStepsAreDone) {
  std::filesystem::remove(folder_ / "report.html");
  EXPECT_TRUE(resumption(asked_, folder_).has_all_steps);
  EXPECT_FALSE(resumption(asked_, folder_).is_complete());
  asked_.output.report = false;
  put("resolved.toml", casefile::resolved(asked_));
  EXPECT_TRUE(resumption(asked_, folder_).is_complete());
}

TEST_F(Complete, ATableThatWasCutOrIsMissingMakesItNone) {
  summarise({{"history.csv", 4}, {"nodes.csv", 2}});
  put("history.csv", "1\n2\n");
  EXPECT_THAT(asking(), ThrowsMessage<MachineError>(HasSubstr("nodes.csv of the complete run")));
  put("nodes.csv", "1\n");
  EXPECT_TRUE(resumption(asked_, folder_).is_complete());
  put("history.csv", "1\n");
  EXPECT_THAT(asking(),
              ThrowsMessage<MachineError>(
                  AllOf(HasSubstr("history.csv"), HasSubstr("has 2 bytes, and should have 4"))));
}

TEST_F(Complete, FieldFilesAreNeededOnlyForAPageThatIsMissing) {
  summarise({{"result_*", 4}});
  EXPECT_TRUE(resumption(asked_, folder_).is_complete());
  std::filesystem::remove(folder_ / "report.html");
  EXPECT_THAT(asking(), ThrowsMessage<MachineError>(
                            AllOf(HasSubstr("result_0000.vtu, result_0001.vtu and result.pvd of"),
                                  HasSubstr("are missing, and its page is to be made of them"))));
  put("result_0000.vtu", "12");
  put("result_0001.vtu", "34");
  put("result.pvd", "");
  EXPECT_TRUE(resumption(asked_, folder_).has_all_steps);
  put("result_0001.vtu", "345");
  EXPECT_THAT(asking(),
              ThrowsMessage<MachineError>(HasSubstr("have 5 bytes, and should have 4, and its")));
}

TEST_F(Complete, FieldFilesThatHaveGoneAreNamed) {
  asked_.time.steps = 12;
  asked_.output.every = 5;
  put("resolved.toml", casefile::resolved(asked_));
  summarise({{"result_*", 4}});
  for (const char *name :
       {"result_0000.vtu", "result_0005.vtu", "result_0010.vtu", "result_0012.vtu", "result.pvd"})
    put(name, name == std::string("result.pvd") ? "" : "1");
  EXPECT_EQ(warning(), "");
  std::filesystem::remove(folder_ / "result_0010.vtu");
  EXPECT_THAT(warning(), HasSubstr("result_0010.vtu of the complete run in " + folder_.string() +
                                   " is missing; without --resume"));
  std::filesystem::remove(folder_ / "result_0012.vtu");
  EXPECT_THAT(warning(), HasSubstr("result_0010.vtu and result_0012.vtu of the complete run in"));
  put("result_0010.vtu", "1");
  put("result_0012.vtu", "123");
  EXPECT_THAT(warning(), HasSubstr("have 6 bytes, and should have 4"));
  asked_.time.steps = 100;
  put("resolved.toml", casefile::resolved(asked_));
  summarise({{"result_*", 4}});
  EXPECT_THAT(warning(), HasSubstr("result_0015.vtu, result_0020.vtu, result_0025.vtu, "
                                   "result_0030.vtu and 14 more of the complete run in"));
  EXPECT_TRUE(resumption(asked_, folder_).is_complete());
}

TEST_F(Complete, FieldFilesOfEveryRankAreLookedFor) {
  summarise({{"result_*", 4}}, 2);
  for (const char *name : {"result_0000_0.vtu", "result_0000_1.vtu", "result_0000.pvtu",
                           "result_0001_0.vtu", "result.pvd"})
    put(name, "");
  EXPECT_THAT(warning(), HasSubstr("result_0001_1.vtu and result_0001.pvtu of the complete run"));
}

TEST_F(Complete, FieldFilesOfTheContactAreLookedForBehindItsSteps) {
  asked_.time.steps = 2;
  put("resolved.toml", casefile::resolved(asked_));
  summarise({{"contact_*", 2}});
  put("contact_0001.vtu", "1");
  put("contact_0002.vtu", "1");
  put("contact.pvd", "");
  EXPECT_EQ(warning(), "");
  put("contact_0002.vtu", "");
  EXPECT_THAT(warning(), HasSubstr("the field files contact_* of the complete run in"));
  std::filesystem::remove(folder_ / "contact_0002.vtu");
  std::filesystem::remove(folder_ / "contact.pvd");
  EXPECT_THAT(warning(), HasSubstr("contact_0002.vtu and contact.pvd of the complete run in"));
}

TEST_F(Complete, OneThatWroteNoFieldsMissesNone) {
  summarise({});
  EXPECT_EQ(warning(), "");
}

TEST_F(Complete, ACheckpointThatIsStillThereSaysNothing) {
  save();
  EXPECT_TRUE(resumption(asked_, folder_).is_complete());
  EXPECT_FALSE(resumption(asked_, folder_).checkpoint);
}

TEST_F(Resuming, AMissingFileOnWhichTheCheckpointCountsIsNamed) {
  output::Checkpoint checkpoint;
  checkpoint.program = program_version();
  checkpoint.inputs = inputs_of(asked_);
  constexpr std::uint64_t sum = 0x261daee5;  // CRC-32 of 1234567890
  checkpoint.position = {{{"history.csv", {10, sum}}}, {{0., "result_0000.vtu"}}, 3};
  output::write_checkpoint(folder_ / output::checkpoint_name, checkpoint);
  EXPECT_THAT(asking(), ThrowsMessage<MachineError>(HasSubstr("result_0000.vtu, on which")));
  put("result_0000.vtu", "");
  EXPECT_THAT(asking(), ThrowsMessage<MachineError>(HasSubstr("do not have the 3 bytes")));
  put("result_0000.vtu", "123");
  put("history.csv.part", "123456789");
  EXPECT_THAT(asking(), ThrowsMessage<MachineError>(HasSubstr("history.csv.part is shorter")));
  put("history.csv.part", "1234567880");
  EXPECT_THAT(asking(), ThrowsMessage<MachineError>(HasSubstr("history.csv.part, on which")));
  put("history.csv.part", "1234567890");
  EXPECT_NO_THROW(asking()());
}

}  // namespace
}  // namespace tourmaline::run
