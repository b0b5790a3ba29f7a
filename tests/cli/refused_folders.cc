// Folders that a run cannot go on in, that another one has, or that cannot hold it.

#include <sys/mount.h>

#include <random>

#include "interrupted.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

class RefusedFolder : public Interrupted {};

TEST_F(RefusedFolder, WhatResumeHasReadNoOtherRunChanges) {
  interrupt_a_run();
  const auto process = start(slow + " -o results --resume");
  while (process->is_at_work() &&
         content_of(folder_ / "stderr").find("going on in") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process->send(SIGSTOP);
  EXPECT_TRUE(fs::exists(here() / "results/run.lock"));
  EXPECT_EQ(run("run " + paper + " --set time.steps=1 -q -o results"), 4);
  EXPECT_THAT(complained_,
              HasSubstr("another run (process " + std::to_string(process->id()) + ")"));
  process->send(SIGCONT);
  process->send(SIGKILL);
}

TEST_F(RefusedFolder, ThePageOfARunAtWorkIsMadeElsewhereOnly) {
  const auto process = start(slow + " -q -o results");
  ASSERT_TRUE(process->leaves(here() / "results/checkpoint.bin"));
  EXPECT_EQ(run("report results"), 4);
  EXPECT_THAT(complained_, HasSubstr("another run"));
  EXPECT_EQ(run("report results -o page.html"), 0) << complained_;
  EXPECT_TRUE(process->is_at_work());
}

TEST_F(RefusedFolder, ARefusedRunLeavesNoFolder) {
  for (const std::string resume : {"", " --resume"}) {
    EXPECT_EQ(
        run("run " + paper + " --set 'contact.friction.bound=\"15/(t-t)\"' -o a/b/c" + resume), 2);
    EXPECT_FALSE(fs::exists(here() / "a")) << complained_;
  }
}

TEST_F(RefusedFolder, AFormulaThatFailsLaterIsFoundBeforeACompleteRunIsReplaced) {
  const std::string all = "run " + paper + " --set mesh.box.cells=[8,8] -q -o results";
  ASSERT_EQ(run(all), 0) << complained_;
  const auto before = files_below(here());
  EXPECT_EQ(run(all + " --set 'contact.friction.bound=\"15*(t<0.1)-1\"'"), 2);
  EXPECT_THAT(complained_, HasSubstr("contact.friction.bound"));
  EXPECT_EQ(files_below(here()), before);
}

TEST_F(RefusedFolder, AChangedCaseIsRefusedWithTheKeysThatDiffer) {
  interrupt_a_run();
  const auto before = files_below(here());
  EXPECT_EQ(run(slow + " --set contact.friction.bound=30 --set boundary[2].traction=[0,1]"
                       " -o results --resume"),
            2);
  EXPECT_THAT(complained_, AllOf(HasSubstr("contact.friction.bound was 15, is 30"),
                                 HasSubstr("boundary[2].traction was"), HasSubstr("results")));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
  EXPECT_EQ(files_below(here()), before);
}

TEST_F(RefusedFolder, AnotherIntervalOfCheckpointsIsNoOtherCase) {
  interrupt_a_run();
  const auto process = start(slow + " --set output.checkpoint=7steps -q -o results --resume");
  const fs::path checkpoint = here() / "results/checkpoint.bin";
  const auto before = fs::last_write_time(checkpoint);
  while (process->is_at_work() && fs::last_write_time(checkpoint) == before)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process->send(SIGTERM);
  EXPECT_EQ(process->wait(), 128 + SIGTERM) << content_of(folder_ / "stderr");
}

class Damaged : public Interrupted {
 protected:
  void expect_refusal(const std::string &reason) {
    const auto before = files_below(here());
    EXPECT_EQ(run(slow + " -o results --resume"), 4);
    EXPECT_THAT(complained_, AllOf(HasSubstr("results/checkpoint.bin"), HasSubstr(reason),
                                   HasSubstr("without --resume")));
    EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
    EXPECT_EQ(files_below(here()), before);
  }
  void put(const std::string &bytes) const {
    std::ofstream(here() / "results/checkpoint.bin", std::ios::binary) << bytes;
  }
};

TEST_F(Damaged, ACheckpointIsRefusedAndTheFilesStay) {
  interrupt_a_run();
  const std::string whole = content_of(here() / "results/checkpoint.bin");
  ASSERT_GT(whole.size(), 1000u);
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{40}}) {
    put(whole.substr(0, size));
    expect_refusal("is damaged");
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}}) {
    put(whole.substr(0, size));
    expect_refusal("is no checkpoint");
  }
  std::mt19937 random(2);
  for (int flip = 0; flip < 5; ++flip) {
    std::string bytes = whole;
    bytes[30 + random() % (bytes.size() - 30)] ^= static_cast<char>(1 << random() % 8);
    put(bytes);
    expect_refusal("checksum");
  }
  std::string newer = whole;
  newer[22] = 9;  // behind the magic line
  put(newer);
  expect_refusal("version 9 of the format");
}

TEST_F(Damaged, AMissingOrEditedTableOrFieldFileIsNamed) {
  interrupt_a_run();
  const auto expect_named = [&](const std::string &name) {
    EXPECT_EQ(run(slow + " -o results --resume"), 4);
    EXPECT_THAT(complained_, HasSubstr(name));
    EXPECT_TRUE(fs::exists(here() / "results/checkpoint.bin"));
  };
  fs::rename(here() / "results/result_0000.vtu", here() / "away");
  expect_named("result_0000.vtu");
  fs::rename(here() / "away", here() / "results/result_0000.vtu");
  std::fstream(here() / "results/history.csv.part") << "Step";  // was: step
  expect_named("of results/history.csv.part, on which the checkpoint counts, are not those");
  fs::resize_file(here() / "results/history.csv.part", 10);
  expect_named("history.csv.part is shorter");
}

TEST_F(RefusedFolder, ASecondRunInTheFolderIsRefusedByTheNumberOfTheFirst) {
  const auto first = start(slow + " -q -o results");
  ASSERT_TRUE(first->leaves(here() / "results/checkpoint.bin"));
  for (const std::string resume : {"", " --resume"}) {
    EXPECT_EQ(run(slow + " -q -o results" + resume), 4);
    EXPECT_THAT(complained_,
                HasSubstr("another run (process " + std::to_string(first->id()) + ")"));
  }
  EXPECT_TRUE(first->is_at_work());
  first->send(SIGKILL);
  first->wait();
  EXPECT_TRUE(fs::exists(here() / "results/run.lock"));
  EXPECT_EQ(run("run " + paper + " --set time.steps=1 -q -o results"), 0) << complained_;
  EXPECT_FALSE(fs::exists(here() / "results/run.lock"));
}

/// A file system of the test's own, where it may mount one.
class Mounted : public Interrupted {
 protected:
  void TearDown() override { umount((here() / "results").c_str()); }
  bool mounts(const char *options) const {
    fs::create_directory(here() / "results");
    return mount("none", (here() / "results").c_str(), "tmpfs", 0, options) == 0;
  }
  bool make_read_only() const {
    return mount("none", (here() / "results").c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "") == 0;
  }
};

TEST_F(Mounted, AFullDiskEndsTheRunAndWithRoomItGoesOn) {
  if (!mounts("size=4m"))
    GTEST_SKIP() << "only root may mount a small file system";
  const std::string all = "run " + paper +
                          " --set time.steps=60 --set output.every=60"
                          " --set output.checkpoint=5steps -q -o ";
  ASSERT_EQ(run(all + "one/results"), 0) << complained_;
  const auto used = fs::file_size(here() / "one/results/contact.csv") / 2 +
                    fs::file_size(here() / "one/results/history.csv") / 2;
  std::ofstream(here() / "results/ballast") << std::string((4 << 20) - used - 120000, 'x');
  EXPECT_EQ(run(all + "results"), 4);
  EXPECT_THAT(complained_, AllOf(HasSubstr("results/"), HasSubstr("No space left on device")));
  ASSERT_TRUE(fs::exists(here() / "results/checkpoint.bin"));
  fs::remove(here() / "results/ballast");
  ASSERT_EQ(run(all + "results --resume"), 0) << complained_;
  expect_same_results(here() / "one/results", here() / "results");
}

TEST_F(Mounted, AReadOnlyFolderIsRefusedAndKeepsItsCheckpoint) {
  if (!mounts("size=32m"))
    GTEST_SKIP() << "only root may mount a file system";
  interrupt_a_run();
  const auto before = files_below(here());
  ASSERT_TRUE(make_read_only());
  EXPECT_EQ(run(slow + " -o results --resume"), 4);
  EXPECT_THAT(complained_, AllOf(HasSubstr("results/"), HasSubstr("Read-only file system")));
  EXPECT_EQ(files_below(here()), before);
}

TEST_F(RefusedFolder, AFileSizeLimitEndsTheRunLikeAFullDisk) {
  // Of the shell's blocks of 512 or 1024 bytes.
  const std::string all = "run " + paper +
                          " --set time.steps=60 --set output.every=60"
                          " --set output.checkpoint=2steps -q -o results";
  EXPECT_EQ(run(all, "ulimit -f 60;"), 4);
  EXPECT_THAT(complained_, AllOf(HasSubstr("results/"), HasSubstr("File too large")));
  EXPECT_TRUE(fs::exists(here() / "results/checkpoint.bin"));
  EXPECT_EQ(run(all + " --resume"), 0) << complained_;
  EXPECT_FALSE(fs::exists(here() / "results/checkpoint.bin"));
}

}  // namespace
