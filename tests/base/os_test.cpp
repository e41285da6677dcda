#include "base/system/os.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace reachlab::os {
namespace {

TEST(Clock, IsTheMonotonicOne) {
  const auto steady = [] {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  const std::int64_t before = steady(), between = now(), after = steady();
  EXPECT_LE(before, between);
  EXPECT_LE(between, after);
}

TEST(Clock, SleepsToItsDeadlineAndNotAtAllWhereItIsPast) {
  const std::int64_t deadline = now() + 3'000'000;
  sleepUntil(deadline);
  EXPECT_GE(now(), deadline);
  sleepUntil(1);
}

TEST(Clock, ProcessorTimeIsThatOfTheThread) {
  const std::int64_t begin = now(), spent = threadProcessorTime();
  while (threadProcessorTime() - spent < 2'000'000) {}
  const std::int64_t worked = threadProcessorTime() - spent;
  EXPECT_LE(worked, now() - begin) << "no thread works for longer than the time that passes";
  std::jthread([] { EXPECT_LT(threadProcessorTime(), 2'000'000) << "a new thread has done nothing yet"; });
}

TEST(Scheduling, RefusesInWordsAPriorityThatIsNone) { EXPECT_EQ(requestRealTime(100), "no real-time priority (Invalid argument)"); }

TEST(Scheduling, ExactSleepIsToTheNanosecond) {
  std::jthread([] {
    requestExactSleep();
    EXPECT_EQ(::prctl(PR_GET_TIMERSLACK), 1);
  });
}

TEST(Memory, IsLockedOrSaidNotToBe) {
  const auto locked = [] {
    const std::string refusal = lockMemory();
    std::ifstream status("/proc/self/status");
    std::string line;
    while (std::getline(status, line))
      if (line.starts_with("VmLck:")) {
        const bool any = line.find_first_of("123456789") != std::string::npos;
        ::_exit(any == refusal.empty() && (any || refusal.starts_with("memory not locked (")) ? 9 : 1);
      }
  };
  EXPECT_EXIT(locked(), testing::ExitedWithCode(9), "");
}

TEST(Disk, SyncsWhatIsThere) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  const auto lowestFree = [] {
    const int next = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::close(next);
    return next;
  };
  const int before = lowestFree();
  EXPECT_TRUE(syncFolder(folder));
  EXPECT_EQ(lowestFree(), before) << "a folder that was synced is closed again";
  EXPECT_FALSE(syncFolder(folder + "/there is none such"));
  EXPECT_FALSE(syncFile(-1));
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  EXPECT_TRUE(syncFile(::fileno(file)));
  std::fclose(file);
}

TEST(Descriptors, ThatAreClosedAreHeld) {
  const auto held = [](int closed) {
    const int next = ::open("/dev/null", O_RDONLY);
    ::close(next);
    ::close(closed);
    holdStandardDescriptors();
    if (::fcntl(closed, F_GETFD) < 0) ::_exit(1);
    const int after = ::open("/dev/null", O_RDONLY);
    ::_exit(after == next && std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(closed)) == "/dev/null" ? 9 : 2);
  };
  for (const int closed : {0, 1, 2}) EXPECT_EXIT(held(closed), testing::ExitedWithCode(9), "") << closed;
}

TEST(Descriptors, AboveTheStandardOnesStayAndAnErrorKeepsItsReason) {
  const int high = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ASSERT_GT(high, STDERR_FILENO);
  EXPECT_EQ(aboveStandardDescriptors(high), high);
  EXPECT_EQ(::close(high), 0);
  errno = ENOENT;
  EXPECT_EQ(aboveStandardDescriptors(-1), -1);
  EXPECT_EQ(errno, ENOENT);
}

TEST(Descriptors, OfTheStandardOnesAreLeft) {
  const int kept = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::close(STDIN_FILENO);
  ASSERT_EQ(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  const int moved = aboveStandardDescriptors(STDIN_FILENO);
  EXPECT_GT(moved, STDERR_FILENO);
  EXPECT_EQ(::fcntl(STDIN_FILENO, F_GETFD), -1) << "and is free again";
  ::close(moved);
  if (kept >= 0) ::dup2(kept, STDIN_FILENO), ::close(kept);
}

}  // namespace
}  // namespace reachlab::os
