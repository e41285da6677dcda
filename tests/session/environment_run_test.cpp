// A run with forces on the hand and a cursor: its columns, marks and replay.
#include <cmath>

#include "sim/experiment/experiment.h"
#include "sim/record/replay.h"
#include "tests/session/recorded_runs.h"

namespace reachlab::session {
namespace {

using test::kNeverStop;
using test::Recorded;

/// A bare hand from -0.1 m to 0.1 m along x, under these further keys.
std::string bareReach(const std::string& keys) {
  return R"({ "schema_version": 1, "name": "bare", "constraint": { "name": "free" }, "object": { "kind": "none" },
  "task": { "start": [-0.1, 0, 0], "target": [0.1, 0, 0], "duration_s": 0.4, "timeout_s": 0.1, "rest_s": 0, "arm_radius_m": 0.06, "plane": "frontal",
            "tolerance": { "position_m": 0.05, "velocity_m_per_s": 5, "time_s": 0.3 } },
  "velocity_estimator": "difference", )" +
         keys + " }";
}

class Pushed : public Recorded {
 protected:
  /// Three trials of a hand that goes straight, or 5 cm beside the line.
  record::RunLog recorded(const std::string& keys, double beside = 0) {
    easy_ = programmeOf(experiment::openExperimentText(bareReach(keys), "bare.json"));
    return runOf(beside);
  }
  record::RunLog runOf(double beside) {
    auto hand = std::make_unique<haptics::test::ScriptedDevice>(-0.1, 0.1, 300);
    hand->beside = {0, beside, 0};
    RecordedRun run(block(), std::move(hand), options());
    while (run.runTrial(kNeverStop)) {}
    run.finish();
    return record::RunLog::open(run.logPath());
  }
};

TEST_F(Pushed, TheForceOfEveryRowIsTheLawOfTheHandInThatRow) {
  const record::RunLog log =
      recorded(R"("environment": [{ "kind": "viscous", "matrix_n_s_per_m": [[0, 13, 0], [-13, 0, 0], [0, 0, 0]] }])");
  const record::ChannelTable& table = log.configuration().table;
  EXPECT_EQ(table.massCount, 0);
  const record::SampleRows rows = log.allRows();
  const std::size_t force = table.indexOf("environment_force_x"), velocity = table.indexOf("hand_vel_x"), phase = table.indexOf("phase");
  std::size_t whole = 0;
  for (const record::RecordedTrial& trial : log.trials()) {
    EXPECT_EQ(trial.result.outcome, trial::Outcome::Success);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows.at(i, phase) != 3 || rows.ticks[i] < trial.result.onsetTick + 20 || rows.ticks[i] > trial.lastTick) continue;
      const Vec3 v = rows.vectorAt(i, velocity);
      EXPECT_NEAR(norm(rows.vectorAt(i, force) - Vec3{13 * v.y, -13 * v.x, 0}), 0, 1e-12);
      ++whole;
    }
  }
  EXPECT_GT(whole, 30u);
  const record::Replay replay = record::replayRun(log);
  EXPECT_TRUE(replay.identical()) << replay.firstDifference;
  EXPECT_GT(replay.rows, 50u);
}

TEST_F(Pushed, TheCursorOfEveryRowIsTheHandRotatedAboutTheStart) {
  const record::RunLog log = recorded(R"("cursor": { "rotation_deg": 90, "gain": 2, "judge": "hand" })");
  const record::ChannelTable& table = log.configuration().table;
  const record::SampleRows rows = log.allRows();
  const std::size_t cursor = table.indexOf("cursor_pos_x"), hand = table.indexOf("hand_pos_x");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec3 h = rows.vectorAt(i, hand), expected{-0.1 - 2 * h.y, 2 * (h.x + 0.1), 2 * h.z};
    EXPECT_NEAR(norm(rows.vectorAt(i, cursor) - expected), 0, 1e-15);
  }
  EXPECT_TRUE(record::replayRun(log).identical());
  EXPECT_THROW(table.indexOf("environment_force_x"), Error) << "columns are there only where the experiment has them";
}

TEST_F(Pushed, ABrokenChannelIsAnEventAndAMarkOfItsTrial) {
  const std::string channel = R"("environment": [{ "kind": "channel" }], "hand_mass_kg": 1)";
  const record::RunLog held = recorded(channel), left = recorded(channel, 0.049);
  EXPECT_TRUE(test::eventsOf(held, record::EventKind::ChannelBroken).empty());
  EXPECT_EQ(test::eventsOf(left, record::EventKind::ChannelBroken).size(), left.trials().size());
  for (const record::RecordedTrial& trial : held.trials()) EXPECT_FALSE(trial.channelBroken);
  for (const record::RecordedTrial& trial : left.trials()) EXPECT_TRUE(trial.channelBroken);
  EXPECT_TRUE(record::replayRun(left).identical());
}

// 1 mm from the place and 49 mm from it.
TEST_F(Pushed, AHandThatMissesAPlaceOnTheWayFailsByItsDistance) {
  const auto past = [&](double beside) {
    std::string text = bareReach(R"("hand_mass_kg": 1)");
    text.insert(text.find("\"plane\""), R"("via_m": [[0.01, 0.05, 0]], "via_radius_m": 0.002, )");
    easy_ = programmeOf(experiment::openExperimentText(text, "bare.json"));
    return runOf(beside);
  };
  const record::RunLog missed = past(0), passed = past(0.049);
  for (const record::RecordedTrial& trial : passed.trials()) EXPECT_EQ(trial.result.outcome, trial::Outcome::Success);
  for (const record::RecordedTrial& trial : missed.trials()) {
    EXPECT_EQ(trial.result.reason, trial::Reason::Via);
    EXPECT_NEAR(trial.result.by, 0.05 - 0.002, 1e-12);
  }
  EXPECT_TRUE(record::replayRun(missed).identical());
}

}  // namespace
}  // namespace reachlab::session
