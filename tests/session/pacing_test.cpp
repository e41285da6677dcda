#include "sim/session/pacing.h"

#include <gtest/gtest.h>

namespace reachlab::session {
namespace {

using namespace std::chrono_literals;

TEST(Pacing, TheNextTrialComesOnceWhenThePauseIsOver) {
  const Pacing::Time begin{};
  Pacing pacing;
  EXPECT_FALSE(pacing.takeNextTrial(begin + 1h)) << "no pause was begun";
  pacing.pauseFor(1.5, begin);
  EXPECT_FALSE(pacing.takeNextTrial(begin + 1499ms));
  EXPECT_TRUE(pacing.takeNextTrial(begin + 1500ms));
  EXPECT_FALSE(pacing.takeNextTrial(begin + 2s));
  pacing.pauseFor(1, begin);
  pacing.cancelPause();
  EXPECT_FALSE(pacing.takeNextTrial(begin + 1h)) << "somebody asked for the trial before";
}

TEST(Pacing, ARestLastsItsTime) {
  const Pacing::Time begin = Pacing::Time{} + 1h;
  Pacing pacing;
  EXPECT_EQ(pacing.restLeft(begin), 0);
  EXPECT_FALSE(pacing.rests());
  pacing.restFor(2.5, begin);
  EXPECT_DOUBLE_EQ(pacing.restLeft(begin + 500ms), 2);
  EXPECT_EQ(pacing.restLeft(begin + 2500ms), 0);
  EXPECT_TRUE(pacing.rests());
}

}  // namespace
}  // namespace reachlab::session
