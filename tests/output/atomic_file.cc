#include "output/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <stdexcept>

#include "temporary_folder.h"
#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// For its lifetime no file of this process grows beyond `bytes`: a full disk without the privilege
/// to make one.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_action_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_action_);
  }

 private:
  void (*old_action_)(int);
  rlimit old_{};
};

TEST(AtomicFile, ATableAppearsOnlyWhenFinished) {
  TemporaryFolder folder;
  AtomicFile table(folder / "table.csv");
  table.append("a,b\n");
  table.append("1,2\n");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"table.csv.part"});
  table.finish();
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"table.csv"});
  EXPECT_EQ(content_of(folder / "table.csv"), "a,b\n1,2\n");
}

TEST(AtomicFile, ARowCanBeReadBesideItsPlaceAsSoonAsItIsAppended) {
  TemporaryFolder folder;
  AtomicFile table(folder / "table.csv");
  table.append("1,2\n");
  EXPECT_EQ(content_of(folder / "table.csv.part"), "1,2\n");
}

TEST(AtomicFile, AnUnfinishedFileLeavesWhatStoodThereBefore) {
  TemporaryFolder folder;
  write_file(folder / "table.csv", "old");
  { AtomicFile(folder / "table.csv").append("new"); }
  EXPECT_EQ(content_of(folder / "table.csv"), "old");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"table.csv"});
}

TEST(AtomicFile, FinishingTwiceIsFinishingOnce) {
  TemporaryFolder folder;
  AtomicFile table(folder / "table.csv");
  table.append("1\n");
  table.finish();
  EXPECT_NO_THROW(table.finish());
  EXPECT_THROW(table.append("2\n"), std::logic_error);
  EXPECT_EQ(content_of(folder / "table.csv"), "1\n");
}

TEST(AtomicFile, AWholeFileReplacesTheOldOne) {
  TemporaryFolder folder;
  write_file(folder / "a.txt", "a long old content");
  write_file(folder / "a.txt", "new");
  EXPECT_EQ(content_of(folder / "a.txt"), "new");
}

TEST(AtomicFile, AMissingFolderIsNamedWithTheReason) {
  TemporaryFolder folder;
  EXPECT_THAT([&] { write_file(folder / "none/a.txt", "x"); },
              ThrowsMessage<MachineError>(
                  AllOf(HasSubstr((folder / "none/a.txt").string()), HasSubstr("No such file"))));
}

TEST(AtomicFile, AFolderInThePlaceOfTheFileIsAnErrorAndLeavesNoPart) {
  TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.txt");
  EXPECT_THAT([&] { write_file(folder / "a.txt", "x"); },
              ThrowsMessage<MachineError>(HasSubstr("directory")));
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.txt"});
}

TEST(AtomicFile, AFullDeviceIsReportedWhenItHappens) {
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full here";
  TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "a.csv.part");
  EXPECT_THAT(
      [&] { write_file(folder / "a.csv", "row\n"); },
      ThrowsMessage<MachineError>(AllOf(HasSubstr("a.csv"), HasSubstr("No space left on device"))));
  EXPECT_TRUE(names_in(folder.path()).empty());
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

TEST(AtomicFile, WhenTheDiskIsFullTheWholeRowsBeforeCanBeKept) {
  TemporaryFolder folder;
  const std::string row(99, 'x');
  AtomicFile table(folder / "table.csv");
  {
    const FileSizeLimit limit(250);
    table.append(row + "\n");
    table.append(row + "\n");
    EXPECT_THROW(table.append(row + "\n"), MachineError);
  }
  table.finish();
  EXPECT_EQ(content_of(folder / "table.csv"), row + "\n" + row + "\n");
}

TEST(AtomicFile, AFullFileSystemLeavesTheOldFileWhole) {
  TemporaryFolder folder;
  // The mount is seen by this process alone and ends with it.
  if (::unshare(CLONE_NEWNS) != 0 || ::mount("", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      ::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "mounting a small file system takes privileges";
  write_file(folder / "a.txt", "old");
  EXPECT_THAT([&] { write_file(folder / "a.txt", std::string(1 << 20, 'x')); },
              ThrowsMessage<MachineError>(HasSubstr("No space left on device")));
  EXPECT_EQ(content_of(folder / "a.txt"), "old");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.txt"});
  ::umount(folder.path().c_str());
}

}  // namespace
}  // namespace tourmaline::output
