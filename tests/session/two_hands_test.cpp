#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/hands.h"
#include "base/fault.h"
#include "sim/record/replay.h"
#include "sim/record/trial_marks.h"
#include "tests/analysis/whole_dataset.h"
#include "tests/analysis/written_tables.h"
#include "tests/refusal.h"
#include "tests/session/recorded_runs.h"

// Two hands on one object, recorded: from two devices to the tables.
namespace reachlab::session {
namespace {

using haptics::test::ScriptedDevice;

constexpr const char* kChain = R"({ "schema_version": 1, "name": "both", "constraint": { "name": "line", "shape": { "length_m": 0.2 } },
  "object": { "kind": "chain", "masses_kg": [0.2, 0.2, 0.2], "stiffness_n_per_m": [600, 600], "damping_n_s_per_m": [5, 5] },
  "coupling": { "stiffness_n_per_m": 600, "damping_n_s_per_m": 10 }, "hands": [{ "mass": 1 }, { "mass": 3 }],
  "task": { "start": [0], "target": [6.283185307179586], "duration_s": 0.6, "timeout_s": 0.3, "rest_s": 0,
            "tolerance": { "position_m": 0.02, "velocity_m_per_s": 0.5, "time_s": 0.4 } } })";

/// Two scripted devices as one, of which the second takes so many ticks.
std::unique_ptr<ScriptedDevice> pair(int otherTicks = 400) {
  auto first = std::make_unique<ScriptedDevice>(-0.1, 0.1, 400);
  first->other = std::make_unique<ScriptedDevice>(-0.1, 0.1, otherTicks);
  return first;
}

class TwoHands : public test::Recorded {
 protected:
  TwoHands() {
    request_.device = "scripted + scripted";
    request_.trials = 2;
    request_.everyTick = true;
    easy_ = programmeOf(experiment::openExperimentText(kChain, "both.json"));
  }
  record::RunLog record(std::unique_ptr<haptics::HapticDevice> device, int most = 2) {
    RecordedRun run(block(), std::move(device), options());
    for (int i = 0; i < most; ++i) {
      const auto trial = run.runTrial(test::kNeverStop);
      if (!trial) break;
      results_.push_back(trial->result);
      said_ = run.fault().value_or("");
    }
    run.finish();
    return record::RunLog::open(run.logPath());
  }
  std::vector<trial::TrialResult> results_;
  std::string said_;  // of the devices, after the last trial
};

TEST_F(TwoHands, AreRecordedAndReplayedToTheBit) {
  const record::RunLog log = record(pair(300));
  ASSERT_EQ(results_.size(), 2u);
  EXPECT_EQ(results_[0].outcome, trial::Outcome::Success) << trial::nameOf(results_[0].reason) << " " << results_[0].by;
  EXPECT_EQ(log.configuration().table.hands, 2);
  ASSERT_EQ(log.otherTicks().size(), 1u);
  EXPECT_EQ(log.otherTicks()[0].size(), log.ticks().size());
  const record::Replay replay = record::replayRun(log);
  EXPECT_TRUE(replay.identical()) << replay.firstDifference;
  EXPECT_EQ(replay.trials.size(), 2u);
  // The second hand is the second device's, and its force its own.
  const record::ChannelTable& table = log.configuration().table;
  const record::SampleRows rows = log.allRows();
  double apart = 0, work = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    apart = std::max(apart, std::abs(rows.at(i, table.indexOf("hand_pos_x")) - rows.at(i, table.indexOf("hand2_pos_x"))));
    work = std::max(work, rows.at(i, table.indexOf("hand2_work")));
    EXPECT_EQ(rows.at(i, table.indexOf("hand2_feedback_force_x")), -rows.at(i, table.indexOf("hand2_coupling_force_x")));
  }
  EXPECT_GT(apart, 0.01);
  EXPECT_GT(work, 0.001);
}

TEST_F(TwoHands, AResumedBlockHasTheSameHands) {
  record(pair(), 1);
  request_.resume = true;
  EXPECT_EQ(record(pair()).configuration().otherHands.size(), 1u);
}

// Its device says that it is well: what the loop has found is of that hand all the same.
TEST_F(TwoHands, AFaultThatTheLoopFindsNamesTheHandThatHasIt) {
  request_.trials = 1;
  auto device = pair(1);
  device->about.name = "left", device->other->about.name = "right";
  device->about.rendersForce = device->other->about.rendersForce = true;  // the loop looks after such hands
  record(std::move(device));
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_EQ(results_[0].reason, trial::Reason::DeviceLost);
  EXPECT_TRUE(holds(said_, "right jumped"));
  EXPECT_FALSE(holds(said_, "left"));
}

TEST_F(TwoHands, NeedADeviceEach) {
  EXPECT_TRUE(holds(refusalOf([&] { record(std::make_unique<ScriptedDevice>(-0.1, 0.1, 400)); }), "2 hands"));
}

TEST_F(TwoHands, TheTrialWaitsForBothAtTheStart) {
  auto device = pair();
  device->other->beside = {0, 0.05, 0};  // 5 cm beside the start
  record(std::move(device));
  EXPECT_EQ(results_.at(0).reason, trial::Reason::NoStart);
}

TEST_F(TwoHands, TheSecondHandMakesTheOnsetToo) {
  record(pair(200));
  const std::uint64_t early = results_.at(0).onsetTick;
  results_.clear();
  request_.place.data = folder_ / "late";
  record(pair(4000));
  EXPECT_LT(early, results_.at(0).onsetTick);
}

TEST_F(TwoHands, EachHasARowForEveryTrialInTheAnalysis) {
  const record::RunLog run = record(pair(300));
  const std::vector<analysis::Row> table = analysis::rowsOf(analysis::handsTable(analysis::openDataset(request_.place.data)));
  ASSERT_EQ(table.size(), 2 * results_.size());
  // From the onset to the last tick before the end, at which no force acts any more.
  const record::SampleRows rows = run.rows(run.trials().at(0));
  double sum = 0, ticks = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows.ticks[i] >= results_[0].onsetTick && rows.ticks[i] < results_[0].endTick)
      sum += norm(rows.vectorAt(i, run.configuration().table.indexOf("coupling_force_x"))), ++ticks;
  EXPECT_NEAR(std::stod(table[0].at("sampled_mean_force_n")), sum / ticks, 1e-12);
  const std::string log = recordedRuns(request_.place).at(0).path;
  record::writeMarks(log, {{{.trial = 1, .excluded = "coughed"}}});
  EXPECT_TRUE(holds(analysis::handsTable(analysis::openDataset(request_.place.data)), "recorded,0,coughed,"))
      << "rows of excluded trials say so";
}

}  // namespace
}  // namespace reachlab::session
