#include "analysis/measures/recording_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/fault.h"
#include "tests/refusal.h"

namespace reachlab::analysis {
namespace {

TEST(RecordingFilter, WithoutACutOffLeavesTheSignalAsItIs) {
  const RecordingFilter none(0, 100);
  EXPECT_EQ(none.reach(), 0);
  EXPECT_EQ(none.apply(std::vector<double>{2, 3, 5}, 1, 2), (std::vector<double>{0, 0, 2, 3, 5, 0, 0}));
}

TEST(RecordingFilter, OfASingleInstantIsNothing) {
  EXPECT_EQ(RecordingFilter(10, 100).apply(std::vector<double>{7}, 1, 1), std::vector<double>(3, 0.0));
  EXPECT_EQ(RecordingFilter(0, 100).apply(std::vector<double>{7, 8}, 1, 0), (std::vector<double>{7, 8}));
}

TEST(RecordingFilter, RefusesWhatNoRecordingCanHave) {
  EXPECT_NO_THROW(RecordingFilter(49.9, 100));
  for (const auto& [cutoff, rate] : {std::pair{50.0, 100.0}, {-1.0, 100.0}, {10.0, 0.0}, {0.0, -100.0}, {10.0, INFINITY}})
    EXPECT_THROW(RecordingFilter(cutoff, rate), FaultError) << cutoff << " " << rate;
  EXPECT_THROW(RecordingFilter(std::nan(""), 100), FaultError);
  EXPECT_NE(refusalOf([&] { RecordingFilter(60, 110); }).find("is 60 Hz at 110 samples per second"), std::string::npos);
}

TEST(GregoryWeights, AreOfEighthOrderFromSixteenSamplesOnAndTheTrapezoidsBelow) {
  EXPECT_TRUE(gregoryWeights(0).empty());
  EXPECT_EQ(gregoryWeights(1), std::vector<double>{1});
  EXPECT_EQ(gregoryWeights(2), (std::vector<double>{0.5, 0.5}));
  std::vector<double> trapezoids(15, 1.0);
  trapezoids.front() = trapezoids.back() = 0.5;
  EXPECT_EQ(gregoryWeights(15), trapezoids);
  const std::vector<double> w = gregoryWeights(16);
  for (int degree = 0; degree <= 7; ++degree) {
    double sum = 0;
    for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * std::pow(static_cast<double>(i) / 15 - 0.3, degree) / 15;
    EXPECT_NEAR(sum, (std::pow(0.7, degree + 1) - std::pow(-0.3, degree + 1)) / (degree + 1), 1e-13) << degree;
  }
}

}  // namespace
}  // namespace reachlab::analysis
