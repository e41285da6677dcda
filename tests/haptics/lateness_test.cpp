#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "sim/haptics/lateness.h"

namespace reachlab::haptics {
namespace {

TEST(LatenessHistogram, TakesAnyDuration) {
  LatenessHistogram histogram;
  histogram.add(-5);
  histogram.add(0);
  histogram.add(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(histogram.percentile(0.5), 0);
  EXPECT_EQ(histogram.max(), static_cast<double>(std::numeric_limits<std::int64_t>::max()));
}

// Sixteen buckets an octave: of a duration and one far above it, the half is told by the upper edge of its bucket.
TEST(LatenessHistogram, ADurationIsToldByTheUpperEdgeOfItsBucket) {
  constexpr std::int64_t kDurations[] = {0, 1, 15, 16, 31, 32, 33, 34, 63, 64, 67, 68, 1000, 1024, 1'000'000};
  constexpr double kEdges[] = {0, 1, 15, 16, 31, 33, 33, 35, 63, 67, 67, 71, 1023, 1087, 1'015'807};
  for (std::size_t i = 0; i < std::size(kEdges); ++i) {
    const std::int64_t duration = kDurations[i];
    LatenessHistogram histogram;
    histogram.add(duration);
    EXPECT_EQ(histogram.percentile(0.5), static_cast<double>(duration)) << "never above the longest";
    histogram.add(10'000'000'000);
    EXPECT_EQ(histogram.percentile(0.5), kEdges[i]) << duration;
    EXPECT_EQ(histogram.percentile(0), 0) << "nothing is below the shortest";
    EXPECT_EQ(histogram.percentile(0.51), 1e10);
    EXPECT_EQ(histogram.max(), 1e10);
  }
}

TEST(LatenessHistogram, APercentileCountsEveryDuration) {
  LatenessHistogram histogram;
  for (const int duration : {3, 9, 1, 5, 7, 3, 3, 3, 2, 14}) histogram.add(duration);
  EXPECT_EQ(histogram.percentile(0.1), 1);
  EXPECT_EQ(histogram.percentile(0.2), 2);
  EXPECT_EQ(histogram.percentile(0.21), 3);
  EXPECT_EQ(histogram.percentile(0.6), 3);
  EXPECT_EQ(histogram.percentile(0.61), 5);
  EXPECT_EQ(histogram.percentile(0.9), 9);
  EXPECT_EQ(histogram.percentile(1), 14);
  EXPECT_EQ(histogram.max(), 14) << "also where the longest was not the last";
  histogram.add(4);
  EXPECT_EQ(histogram.max(), 14);
}

}  // namespace
}  // namespace reachlab::haptics
