#include "tourmaline/output/folder_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>

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

TEST(FolderLock, AFolderThatIsNotThereIsUnused) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(require_unused(folder / "later"));
}

}  // namespace
}  // namespace tourmaline::output
