#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>

#include "base/system/os.h"

namespace reachlab::os {
namespace {

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
