#include "network/link_check/simulated_link.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace reachlab::network {
namespace {

std::vector<double> delaysOver(const LinkConditions& conditions, int count) {
  SimulatedLink<double> link(conditions, 3);
  std::vector<double> delays;
  for (int i = 0; i < count; ++i) link.send(0.1 * i, 0.1 * i);
  for (double now = 0; now < 0.1 * count + 1; now += 1e-3) link.receive(now, [&](double sent) { delays.push_back(now - sent); });
  return delays;
}

// Uniform either way: within the jitter, as often early as late, with a standard deviation of jitter / sqrt(3).
TEST(SimulatedLink, DelaysAreUniformAboutTheDelay) {
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

TEST(SimulatedLink, LosesItsShare) {
  EXPECT_NEAR(static_cast<double>(delaysOver({.delay = 0.04, .jitter = 0, .loss = 0.3}, 2000).size()), 1400, 60);
}

TEST(SimulatedLink, WithoutJitterASampleComesAfterItsDelayAndOnce) {
  SimulatedLink<int> link({.delay = 0.04, .jitter = 0, .loss = 0}, 1);
  std::vector<int> came;
  const auto look = [&](double now) { link.receive(now, [&](int sample) { came.push_back(sample); }); };
  link.send(7, 1);
  link.send(8, 1.01);
  look(1.0399);
  EXPECT_TRUE(came.empty());
  look(1.04);
  look(1.045);
  EXPECT_EQ(came, std::vector<int>{7});
  link.send(9, 1.045);
  look(2);
  EXPECT_EQ(came, (std::vector<int>{7, 8, 9})) << "in the order of sending";
}

// A sample may overtake those before it, which still come, each once.
TEST(SimulatedLink, WhatIsOvertakenComesLater) {
  SimulatedLink<int> link({.delay = 0.04, .jitter = 0.03, .loss = 0}, 5);
  std::vector<int> came;
  for (int i = 0; i < 400; ++i) {
    link.send(i, 1e-3 * i);
    link.receive(1e-3 * i, [&](int sample) { came.push_back(sample); });
  }
  link.receive(10, [&](int sample) { came.push_back(sample); });
  EXPECT_FALSE(std::is_sorted(came.begin(), came.end()));
  std::sort(came.begin(), came.end());
  ASSERT_EQ(came.size(), 400u);
  for (int i = 0; i < 400; ++i) EXPECT_EQ(came[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace reachlab::network
