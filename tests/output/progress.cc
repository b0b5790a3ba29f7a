#include "output/progress.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace tourmaline::output {
namespace {

using testing::HasSubstr;

HistoryRow row(int step) {
  return {step, 0.01 * step, 2, 0, 30, 3, 0, {}};
}

/// All that is written to a terminal until its last writer has closed it. The system passes it on
/// with a delay: a single read may find only the beginning.
std::string everything_from(int master) {
  std::string text;
  char piece[4096];
  for (ssize_t n = 0; (n = ::read(master, piece, sizeof piece)) > 0;)
    text.append(piece, static_cast<std::size_t>(n));
  return text;
}

/// What `work` writes when stderr is a terminal of that width.
std::string on_a_terminal(unsigned short width, const std::function<void()> &work) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0)
    throw std::runtime_error("no pseudo-terminal");
  const int slave = ::open(::ptsname(master), O_RDWR | O_NOCTTY);
  const winsize size{24, width, 0, 0};
  ::ioctl(slave, TIOCSWINSZ, &size);
  const int saved = ::dup(STDERR_FILENO);
  ::dup2(slave, STDERR_FILENO);
  ::close(slave);
  work();
  ::dup2(saved, STDERR_FILENO);
  ::close(saved);
  const std::string text = everything_from(master);
  ::close(master);
  return text;
}

TEST(ProgressText, ItNamesStepTimeIterationsAndTheStateOfTheContact) {
  EXPECT_EQ(progress_text(row(3), 20, -1), "step 3/20  t = 0.03 s  Newton 2  stick 30  slip 3");
}

TEST(ProgressText, TheTimeLeftIsSaidInTheUnitsOfAPerson) {
  EXPECT_THAT(progress_text(row(3), 20, 12.4), HasSubstr("  12 s left"));
  EXPECT_THAT(progress_text(row(3), 20, 125), HasSubstr("  2 min 05 s left"));
  EXPECT_THAT(progress_text(row(3), 20, 7500), HasSubstr("  2 h 05 min left"));
}

TEST(ProgressBar, ItFillsFromTheLeft) {
  EXPECT_EQ(progress_bar(0, 20, 12), "[----------]");
  EXPECT_EQ(progress_bar(5, 20, 12), "[##--------]");
  EXPECT_EQ(progress_bar(20, 20, 12), "[##########]");
}

TEST(ProgressLine, InAPipeAShortRunSaysNothing) {
  testing::internal::CaptureStderr();
  {
    Progress progress(20, 1, false);
    progress.stage("mesh");
    progress.step(row(1));
    progress.done();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ProgressLine, InAPipeALineFollowsEveryPause) {
  testing::internal::CaptureStderr();
  {
    Progress progress(20, 1, false, std::chrono::milliseconds(100));
    for (int i = 1; i <= 3; ++i) {
      progress.step(row(2 * i - 1));
      ::usleep(120000);
      progress.step(row(2 * i));
    }
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_THAT(text, testing::StartsWith("step 2/20  t = 0.02 s  Newton 2  stick 30  slip 3  "));
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(ProgressLine, WhenQuietNothingIsSaidInAPipe) {
  testing::internal::CaptureStderr();
  {
    Progress progress(20, 1, true, std::chrono::milliseconds(0));
    progress.stage("mesh");
    progress.step(row(1));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ProgressLine, WhenQuietNothingIsSaidOnATerminal) {
  EXPECT_EQ(on_a_terminal(80,
                          [] {
                            Progress progress(20, 1, true);
                            progress.stage("mesh");
                            progress.step(row(1));
                          }),
            "");
}

TEST(ProgressLine, ItIsRewrittenInPlaceAndClearedInTheEnd) {
  const std::string text = on_a_terminal(80, [] {
    Progress progress(20, 1, false);
    progress.stage("factorise");
    progress.step(row(1));
    progress.done();
    progress.done();
  });
  const std::string clear = "\r\033[K";
  EXPECT_EQ(text, clear + "factorise ..." + clear + progress_bar(1, 20, 24) + " " +
                      progress_text(row(1), 20, -1) + clear);
}

TEST(ProgressLine, ItIsClearedWhenAnErrorEndsTheRun) {
  const std::string text = on_a_terminal(80, [] {
    try {
      Progress progress(20, 1, false);
      progress.stage("factorise");
      throw std::runtime_error("out of memory");
    } catch (const std::runtime_error &) {
    }
  });
  EXPECT_TRUE(text.ends_with("...\r\033[K"));
}

TEST(ProgressLine, APartOfAStepFillsABarOfItsOwn) {
  const std::string text = on_a_terminal(80, [] {
    Progress progress(20, 1, false);
    ::usleep(120000);
    progress.part("matrix", 5, 20);
    progress.part("matrix", 6, 20);  // at once, so not drawn
  });
  const std::string clear = "\r\033[K";
  EXPECT_EQ(text, clear + progress_bar(5, 20, 24) + " matrix  5/20" + clear);
}

TEST(ProgressLine, WhenQuietNothingIsSaidOfParts) {
  EXPECT_EQ(on_a_terminal(80,
                          [] {
                            Progress progress(20, 1, true, std::chrono::milliseconds(0));
                            ::usleep(120000);
                            progress.part("matrix", 5, 20);
                          }),
            "");
}

TEST(ProgressLine, FastStepsAreNotAllDrawn) {
  const std::string text = on_a_terminal(80, [] {
    Progress progress(1000, 1, false);
    for (int i = 1; i <= 1000; ++i)
      progress.step(row(i));
  });
  // The loop takes well under a second: at most the first and ten more, and the clearing.
  EXPECT_LE(std::count(text.begin(), text.end(), '\r'), 12);
  EXPECT_THAT(text, HasSubstr("step 1/1000"));
}

TEST(ProgressLine, TheTimeLeftIsKnownFromTheSecondStepOn) {
  const std::string text = on_a_terminal(80, [] {
    Progress progress(3, 1, false);
    progress.step(row(1));
    ::usleep(150000);
    progress.step(row(2));
  });
  const std::size_t second = text.find("step 2/3");
  ASSERT_NE(second, std::string::npos);
  EXPECT_EQ(text.substr(0, second).find("left"), std::string::npos);
  EXPECT_THAT(text.substr(second), HasSubstr(" s left"));
}

TEST(ProgressLine, ItNeverWrapsOnANarrowTerminal) {
  const std::string text = on_a_terminal(20, [] { Progress(20, 1, false).step(row(1)); });
  EXPECT_EQ(text, "\r\033[K" + progress_text(row(1), 20, -1).substr(0, 19) + "\r\033[K");
}

}  // namespace
}  // namespace tourmaline::output
