#include "output/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <limits>

#include "temporary_folder.h"
#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Checkpoint example() {
  Checkpoint checkpoint;
  checkpoint.program = "1.2.3";
  checkpoint.inputs = "title = \"a\"\n";
  checkpoint.ranks = 2;
  checkpoint.step = 7;
  checkpoint.position = {{12, 3}, {34, 4}, {{0, "result_0000.vtu"}, {0.1, "result_0001.vtu"}}, 56};
  checkpoint.position.probes = {{"probe-tip.csv", {78, 5}}, {"probe-a.csv", {9, 6}}};
  checkpoint.numbers.put("state", {1. / 3, -0., std::numeric_limits<double>::denorm_min()});
  checkpoint.numbers.put("nothing", {});
  return checkpoint;
}

TEST(Checkpoint, EveryNumberReadsBackToTheLastBit) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "c", example());
  const Checkpoint read = read_checkpoint(folder / "c");
  EXPECT_EQ(read.program, "1.2.3");
  EXPECT_EQ(read.inputs, "title = \"a\"\n");
  EXPECT_EQ(read.ranks, 2u);
  EXPECT_EQ(read.step, 7u);
  EXPECT_EQ(read.position.contact.bytes, 12u);
  EXPECT_EQ(read.position.contact.checksum, 3u);
  EXPECT_EQ(read.position.history.bytes, 34u);
  EXPECT_EQ(read.position.history.checksum, 4u);
  EXPECT_EQ(read.position.field_bytes, 56u);
  ASSERT_EQ(read.position.probes.size(), 2u);
  EXPECT_EQ(read.position.probes.at("probe-tip.csv").bytes, 78u);
  EXPECT_EQ(read.position.probes.at("probe-tip.csv").checksum, 5u);
  ASSERT_EQ(read.position.series.size(), 2u);
  EXPECT_EQ(read.position.series[1].time, 0.1);
  EXPECT_EQ(read.position.series[1].file, "result_0001.vtu");
  const auto state = read.numbers.get("state", 3);
  EXPECT_EQ(state[0], 1. / 3);
  EXPECT_TRUE(std::signbit(state[1]));
  EXPECT_EQ(state[2], std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(read.numbers.get("nothing", 0).size(), 0u);
}

TEST(Checkpoint, EveryShorterFileAndEveryFlippedBitIsRefused) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "c", example());
  const std::string whole = content_of(folder / "c");
  const auto expect_refused = [&](const std::string &bytes) {
    std::ofstream(folder / "c", std::ios::binary) << bytes;
    EXPECT_THROW(read_checkpoint(folder / "c"), MachineError);
  };
  for (std::size_t size = 0; size < whole.size(); ++size)
    expect_refused(whole.substr(0, size));
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    expect_refused(flipped);
  }
  expect_refused(whole + "more");
}

TEST(Checkpoint, WhatIsNoFileIsNotWaitedFor) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const std::filesystem::path &path : {folder / "pipe", folder.path()})
    EXPECT_THAT([&] { read_checkpoint(path); },
                testing::ThrowsMessage<MachineError>(testing::HasSubstr("is no checkpoint")));
}

TEST(Checkpoint, NumbersThatAreNotThereAreNamed) {
  const auto refused = ThrowsMessage<MachineError>(HasSubstr("\"state\""));
  EXPECT_THAT([] { example().numbers.get("state", 4); }, refused);
  EXPECT_THROW(example().numbers.get("sate", 3), MachineError);
}

TEST(Checkpoint, OneThatCannotBeWrittenLeavesTheOneBefore) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "c", example());
  std::filesystem::create_directory(folder / "c.part");  // in the way
  EXPECT_THROW(write_checkpoint(folder / "c", {}), MachineError);
  EXPECT_EQ(read_checkpoint(folder / "c").step, 7u);
}

}  // namespace
}  // namespace tourmaline::output
