#include "cli/output/trial_profile.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/experiment/experiment.h"
#include "tests/record/made_run.h"

namespace reachlab::cli {
namespace {

// A trial of three masses whose speeds and force are multiples of the tick in three dimensions; onset at tick 40, or none.
ShownTrial shownOf(bool moves) {
  const TemporaryFolder folder;
  record::RunConfiguration configuration = record::madeConfiguration(3);
  const experiment::Experiment chain = experiment::readExperiment("chain-moderate");
  configuration.experimentText = chain.text;
  configuration.definitionText = experiment::definitionTextOf(chain);
  const std::string path = folder / "a_log.reach";
  record::MadeRecording recording(path, configuration);
  recording.until(101, [&](haptics::TickState& state) {
    const auto t = static_cast<double>(state.tick);
    state.trial = 1;
    state.phase = state.tick == 100 ? trial::Phase::Done : moves && state.tick >= 40 ? trial::Phase::Moving : trial::Phase::Waiting;
    state.result.onsetTick = moves ? 40 : 0;
    state.hands[0].hip.velocity = {2 * t, -3 * t, 6 * t};    // of size 7
    state.masses[0].v = {t, 4 * t, -8 * t};                  // of size 9
    state.masses[1].v = {1e3, 1e3, 1e3};                     // not looked at
    state.masses[2].v = {-2 * t, 6 * t, 9 * t};              // of size 11
    state.hands[0].couplingForce = {-1 * t, -2 * t, 2 * t};  // of size 3
    return state.tick >= 10;
  });
  const record::RunLog log = recording.closed();
  return profileOf(log, log.trials()[0]);
}

TEST(ShownTrial, IsOfTheSamplesSinceTheOnset) {
  const ShownTrial profile = shownOf(true);
  EXPECT_TRUE(profile.sinceOnset);
  ASSERT_EQ(profile.time.size(), 10u) << "ticks 10, 20 … 100";
  for (std::size_t i = 0; i < 10; ++i) {
    const double tick = 10.0 * static_cast<double>(i + 1);
    EXPECT_DOUBLE_EQ(profile.time[i], (tick - 40) / 1000);
    EXPECT_DOUBLE_EQ(profile.handSpeed[i], 7 * tick);
    EXPECT_DOUBLE_EQ(profile.firstSpeed[i], 9 * tick);
    EXPECT_DOUBLE_EQ(profile.lastSpeed[i], 11 * tick);
    EXPECT_DOUBLE_EQ(profile.force[i], 3 * tick);
  }
}

TEST(ShownTrial, OfAHandThatNeverSetOffIsSinceTheTrialWasPutUp) {
  const ShownTrial profile = shownOf(false);
  EXPECT_FALSE(profile.sinceOnset);
  EXPECT_EQ(profile.time.front(), 0);
  EXPECT_EQ(profile.time.back(), 0.09);
}

}  // namespace
}  // namespace reachlab::cli
