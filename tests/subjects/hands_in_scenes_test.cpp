#include "sim/subjects/hands_in_scenes.h"

#include <gtest/gtest.h>

#include <string>

namespace reachlab::subjects {
namespace {

struct Told {
  std::string prepared, cued;
  int written = 0;
};

class TellingHand final : public haptics::HapticDevice {
 public:
  TellingHand(double x, Told& told) : x_(x), told_(told) {}
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info;
    info.virtualHand = true;
    return info;
  }
  void prepareTrial(int index, int /*scene*/ = 0) override { told_.prepared += std::to_string(index) + " "; }
  void cue(haptics::Cue cue) noexcept override { told_.cued += cue == haptics::Cue::Place ? 'P' : 'G'; }
  haptics::DeviceSample read() noexcept override {
    haptics::DeviceSample sample;
    sample.position.x = x_;
    return sample;
  }
  void write(const Vec3&) noexcept override { ++told_.written; }

 private:
  double x_;
  Told& told_;
};

// A hand goes on being read until the next trial is placed, and learns from its trial even if another hand does the next one.
TEST(HandsInScenes, ChangeHandsWhenATrialIsPlacedAndPrepareTheHandBefore) {
  Told told[2];
  std::vector<std::unique_ptr<haptics::HapticDevice>> hands;
  for (int i = 0; i < 2; ++i) hands.push_back(std::make_unique<TellingHand>(i, told[i]));
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
  EXPECT_EQ(told[0].prepared, "1 2 ");
  EXPECT_EQ(told[1].prepared, "0 1 ");
  EXPECT_EQ(told[0].cued, "P");
  EXPECT_EQ(told[1].cued, "PG");
  EXPECT_EQ(told[1].written, 1);
  EXPECT_EQ(told[0].written, 0);
}

}  // namespace
}  // namespace reachlab::subjects
