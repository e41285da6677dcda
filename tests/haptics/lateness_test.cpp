#include <gtest/gtest.h>

#include "sim/haptics/lateness.h"

namespace reachlab::haptics {
namespace {

TEST(LatenessHistogram, PercentilesAreRightToABucketsWidth) {
  LatenessHistogram histogram;
  EXPECT_EQ(histogram.percentile(0.5), 0);
  for (int i = 1; i <= 100'000; ++i) histogram.add(i);
  constexpr double kBucket = 1.0 / 16;  // of the value: sixteen buckets an octave
  EXPECT_NEAR(histogram.percentile(0.50), 50'000, 50'000 * kBucket);
  EXPECT_NEAR(histogram.percentile(0.99), 99'000, 99'000 * kBucket);
  EXPECT_EQ(histogram.percentile(1), 100'000);
  EXPECT_EQ(histogram.max(), 100'000);
}

TEST(LatenessHistogram, TakesAnyDuration) {
  LatenessHistogram histogram;
  histogram.add(-5);
  histogram.add(0);
  histogram.add(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(histogram.percentile(0.5), 0);
  EXPECT_EQ(histogram.max(), static_cast<double>(std::numeric_limits<std::int64_t>::max()));
}

}  // namespace
}  // namespace reachlab::haptics
