#include "base/system/utc.h"

#include <gtest/gtest.h>

namespace reachlab {
namespace {

using std::chrono::milliseconds;
using std::chrono::system_clock;

TEST(Utc, IsRightBeforeAndAfter1970) {
  EXPECT_EQ(utcText(system_clock::time_point(milliseconds(0))), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(utcText(system_clock::time_point(milliseconds(-1))), "1969-12-31T23:59:59.999Z");
  EXPECT_EQ(utcText(system_clock::time_point(milliseconds(-86'400'000 - 500))), "1969-12-30T23:59:59.500Z");
  EXPECT_EQ(utcText(system_clock::time_point(milliseconds(1'709'209'845'678))), "2024-02-29T12:30:45.678Z");
}

}  // namespace
}  // namespace reachlab
