#include "sim/subjects/hands_in_scenes.h"

#include <gtest/gtest.h>

#include "tests/haptics/set_device.h"

namespace reachlab::subjects {
namespace {

using haptics::test::SetDevice;

// A hand goes on being read until the next trial is placed, and learns from its trial even if another hand does the next one.
TEST(HandsInScenes, ChangeHandsWhenATrialIsPlacedAndPrepareTheHandBefore) {
  std::vector<std::unique_ptr<haptics::HapticDevice>> hands;
  std::vector<SetDevice*> told;
  for (const double x : {0.0, 1.0}) {
    auto hand = std::make_unique<SetDevice>(Vec3{x, 0, 0});
    hand->about.virtualHand = true;
    told.push_back(hand.get());
    hands.push_back(std::move(hand));
  }
  const auto joined = joinScenes(std::move(hands));
  EXPECT_TRUE(joined->info().virtualHand);
  EXPECT_EQ(joined->read().position.x, 0);
  joined->prepareTrial(0, 1);
  EXPECT_EQ(joined->read().position.x, 0) << "not placed yet";
  joined->cue(haptics::Cue::Place);
  joined->cue(haptics::Cue::Go);
  EXPECT_EQ(joined->read().position.x, 1);
  joined->write({});
  joined->prepareTrial(1, 0);
  EXPECT_EQ(joined->read().position.x, 1);
  joined->cue(haptics::Cue::Place);
  EXPECT_EQ(joined->read().position.x, 0);
  joined->prepareTrial(2, 0);
  EXPECT_EQ(told[0]->prepared, (std::vector<int>{1, 2}));
  EXPECT_EQ(told[1]->prepared, (std::vector<int>{0, 1}));
  EXPECT_EQ(told[0]->cues, (std::vector<haptics::Cue>{haptics::Cue::Place}));
  EXPECT_EQ(told[1]->cues, (std::vector<haptics::Cue>{haptics::Cue::Place, haptics::Cue::Go}));
  EXPECT_EQ(told[1]->written.size(), 1u);
  EXPECT_EQ(told[0]->written.size(), 0u);
}

}  // namespace
}  // namespace reachlab::subjects
