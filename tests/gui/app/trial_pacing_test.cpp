#include "gui/session/trial_pacing.h"

#include <gtest/gtest.h>

namespace reachlab::gui::app {
namespace {

using namespace std::chrono_literals;

TEST(TrialPacing, IsDueOnceWhenThePauseIsOver) {
  const TrialPacing::Time begin{};
  TrialPacing pacing;
  EXPECT_FALSE(pacing.takeDue(begin + 1h)) << "nothing is planned";
  pacing.plan(begin, 1.5);
  EXPECT_FALSE(pacing.takeDue(begin + 1499ms));
  EXPECT_TRUE(pacing.takeDue(begin + 1500ms));
  EXPECT_FALSE(pacing.takeDue(begin + 2s));
}

TEST(TrialPacing, AKeyThatComesFirstCancelsIt) {
  const TrialPacing::Time begin{};
  TrialPacing pacing;
  pacing.plan(begin, 1);
  pacing.cancel();
  EXPECT_FALSE(pacing.planned());
  EXPECT_FALSE(pacing.takeDue(begin + 1h));
}

}  // namespace
}  // namespace reachlab::gui::app
