#include "output/folder_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <optional>
#include <thread>
#include <vector>

#include "temporary_folder.h"
#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(FolderLock, ASecondOneIsRefusedWithTheProcessOfTheFirst) {
  const TemporaryFolder folder;
  const FolderLock first(folder.path());
  const auto refused = ThrowsMessage<MachineError>(
      AllOf(HasSubstr("process " + std::to_string(::getpid())), HasSubstr(folder.path().string())));
  EXPECT_THAT([&] { FolderLock(folder.path()); }, refused);
  EXPECT_THAT([&] { require_unused(folder.path()); }, refused);
}

TEST(FolderLock, ItsEndFreesTheFolderAndLeavesNothing) {
  const TemporaryFolder folder;
  std::optional<FolderLock> lock(folder.path());
  lock.reset();
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{});
  EXPECT_NO_THROW(require_unused(folder.path()));
  EXPECT_NO_THROW(lock.emplace(folder.path()));
}

TEST(FolderLock, AFileThatAKilledProcessLeftLocksNothing) {
  const TemporaryFolder folder;
  std::ofstream(folder / std::string(lock_name)) << "12345\n";
  EXPECT_NO_THROW(require_unused(folder.path()));
  EXPECT_NO_THROW(FolderLock(folder.path()));
}

TEST(FolderLock, FoldersThatItMadeGoWithItWhenNothingIsInThem) {
  const TemporaryFolder folder;
  { FolderLock(folder / "a/b/c/"); }
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{});
  {
    const FolderLock lock(folder / "a/b");
    std::ofstream(folder / "a/b/result") << "1\n";
  }
  EXPECT_EQ(names_in(folder / "a/b"), std::set<std::string>{"result"});
  { const FolderLock lock(folder / "a/b"); }
  EXPECT_EQ(names_in(folder / "a/b"), std::set<std::string>{"result"});
}

TEST(FolderLock, WhoOnlyAsksKeepsNobodyOut) {
  const TemporaryFolder folder;
  std::ofstream(folder / std::string(lock_name)) << "12345\n";
  std::atomic<bool> over = false;
  std::thread asking([&] {
    while (!over)
      try {
        require_unused(folder.path());
      } catch (const MachineError &) {
      }
  });
  for (int i = 0; i < 300; ++i)
    EXPECT_NO_THROW(FolderLock(folder.path()));
  over = true;
  asking.join();
}

TEST(FolderLock, OfManyThatWantItOneHasItAtATime) {
  const TemporaryFolder folder;
  std::atomic<int> inside = 0, most = 0, entered = 0;
  const auto want = [&] {
    for (int i = 0; i < 100; ++i)
      try {
        const FolderLock lock(folder / "study");
        most = std::max(most.load(), ++inside);
        ++entered;
        --inside;
      } catch (const MachineError &) {
      }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back(want);
  for (std::thread &thread : threads)
    thread.join();
  EXPECT_EQ(most, 1);
  EXPECT_GE(entered, 100);
}

TEST(FolderLock, AFolderThatIsNotThereIsUnused) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(require_unused(folder / "later"));
}

}  // namespace
}  // namespace tourmaline::output
