#include "network/simulated_line.h"

#include <gtest/gtest.h>

#include <vector>

namespace reachlab::network {
namespace {

std::vector<double> delaysOver(const LineConditions& conditions, int count) {
  SimulatedLine<double> line(conditions, 3);
  std::vector<double> delays;
  for (int i = 0; i < count; ++i) line.send(0.1 * i, 0.1 * i);
  for (double now = 0; now < 0.1 * count + 1; now += 1e-3) line.receive(now, [&](double sent) { delays.push_back(now - sent); });
  return delays;
}

// Uniform either way: within the jitter, as often early as late, with a standard deviation of jitter / sqrt(3).
TEST(SimulatedLine, DelaysAreUniformAboutTheDelay) {
  const std::vector<double> delays = delaysOver({.delay = 0.04, .jitter = 0.02, .loss = 0}, 2000);
  ASSERT_EQ(delays.size(), 2000u);
  double sum = 0, squares = 0;
  for (const double delay : delays) {
    EXPECT_GE(delay, 0.02 - 1e-9);
    EXPECT_LE(delay, 0.06 + 1.1e-3) << "a look a millisecond";
    sum += delay, squares += (delay - 0.04) * (delay - 0.04);
  }
  EXPECT_NEAR(sum / 2000, 0.0405, 1e-3);
  EXPECT_NEAR(squares / 2000, 0.02 * 0.02 / 3, 1e-5);
}

TEST(SimulatedLine, LosesItsShare) {
  EXPECT_NEAR(static_cast<double>(delaysOver({.delay = 0.04, .jitter = 0, .loss = 0.3}, 2000).size()), 1400, 60);
}

// What overtakes another arrives before it; a tick's rounding makes nothing late.
TEST(SimulatedLine, GivesWhatHasArrivedByNowOnceAndInTheOrderOfSending) {
  SimulatedLine<int> line({.delay = 0.02, .jitter = 0, .loss = 0}, 1);
  std::vector<int> got;
  const auto receive = [&](double now) {
    got.clear();
    line.receive(now, [&](int sample) { got.push_back(sample); });
    return got;
  };
  for (int i = 0; i < 3; ++i) line.send(i, 0.001 * i);
  EXPECT_EQ(receive(0.0199), std::vector<int>{});
  EXPECT_EQ(receive(0.1 * 3 - 0.28 - 1e-16), std::vector<int>{0});
  EXPECT_EQ(receive(0.03), (std::vector{1, 2}));
  EXPECT_EQ(receive(1), std::vector<int>{});
}

TEST(SimulatedLine, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto lost = [](std::uint64_t seed) {
    SimulatedLine<int> line({.delay = 0, .jitter = 0, .loss = 0.5}, seed);
    std::vector<int> came;
    for (int i = 0; i < 64; ++i) line.send(i, 0);
    line.receive(0, [&](int sample) { came.push_back(sample); });
    return came;
  };
  EXPECT_EQ(lost(5), lost(5));
  EXPECT_NE(lost(5), lost(6));
}

}  // namespace
}  // namespace reachlab::network
