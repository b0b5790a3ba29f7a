#include "parallel/team.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "tourmaline/error.h"

namespace tourmaline {
namespace {

using parallel::Team;

TEST(Team, DoesEachTaskOnceForAnyNumberOfThreads) {
  for (const int members : {1, 2, 3, 8}) {
    Team team(members);
    for (const int tasks : {0, 1, 2, 7, 1000}) {
      std::vector<int> done(tasks, 0);
      team.share_out(tasks, [&](int task, int) { ++done[task]; });
      EXPECT_EQ(done, std::vector<int>(tasks, 1)) << members << " members";
    }
  }
}

TEST(Team, MembersOfItsOwnNeverMeetForAnyNumberOfThreads) {
  for (const int members : {1, 2, 5}) {
    Team team(members);
    std::vector<long> sums(team.members(), 0);  // each written to by one member, without a lock
    for (int round = 0; round < 50; ++round)
      team.share_out(100, [&](int task, int member) { sums.at(member) += task; });
    EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0L), 50 * 4950);
  }
}

TEST(Team, ThrowsWhatATaskThrowsOnceAllHaveEndedAndGoesOn) {
  Team team(3);
  std::vector<int> done(100, 0);
  EXPECT_THROW(team.share_out(100,
                              [&](int task, int) {
                                if (task == 40)
                                  throw std::runtime_error("this one");
                                ++done[task];
                              }),
               std::runtime_error);
  EXPECT_EQ(done[40], 0);
  team.share_out(100, [&](int task, int) { done[task] = 2; });
  EXPECT_EQ(done, std::vector<int>(100, 2));
}

#ifndef TOURMALINE_SANITIZED  // which take more address space than this
[[noreturn]] void ask_for_more_threads_than_fit() {
  const rlimit limit{1UL << 31, 1UL << 31};
  setrlimit(RLIMIT_AS, &limit);
  try {
    Team(1024);
  } catch (const MachineError &error) {
    std::fputs(error.what(), stderr);
    std::exit(3);
  }
  std::exit(0);
}

TEST(Team, SaysHowManyThreadsThereCanBe) {
  EXPECT_EXIT(ask_for_more_threads_than_fit(), testing::ExitedWithCode(3),
              "only [0-9]+ of the 1024 threads that it needs .*; lower solver.threads");
}
#endif

}  // namespace
}  // namespace tourmaline
