#include "analysis/trials/run_trials.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constraints/constraint.h"
#include "sim/experiment/experiment.h"
#include "tests/analysis/synthetic.h"

namespace reachlab::analysis {
namespace {

constexpr std::uint64_t kEvery = 10;

/// A value for each column that grows by another amount with each tick, and faster from 1050 on: between rows it is straight.
double valueOf(std::size_t column, std::uint64_t tick) {
  const double t = static_cast<double>(tick) + (tick > 1050 ? 2 * static_cast<double>(tick - 1050) : 0);
  return static_cast<double>(column) + 0.001 * static_cast<double>(column + 1) * t;
}

record::SampleRows rowsAt(const record::ChannelTable& table, const std::vector<std::uint64_t>& ticks) {
  record::SampleRows rows;
  rows.columns = table.size();
  rows.ticks = ticks;
  for (const std::uint64_t tick : ticks)
    for (std::size_t column = 0; column < table.size(); ++column) rows.values.push_back(valueOf(column, tick));
  return rows;
}
Vec3 vectorOf(const record::ChannelTable& table, const std::string& name, std::uint64_t tick) {
  const std::size_t at = table.indexOf(name);
  return {valueOf(at, tick), valueOf(at + 1, tick), valueOf(at + 2, tick)};
}
record::RecordedTrial recordedTrial() {
  record::RecordedTrial trial;
  trial.armedTick = 1003;
  trial.goTick = 1103;
  trial.result.onsetTick = 1023;
  trial.result.endTick = 1071;
  trial.result.outcome = trial::Outcome::Success;
  trial.peakForce = 4, trial.meanForce = 2;
  trial.planned.catchTrial = true;
  return trial;
}

/// The readers of a chain's trials on a line.
struct ChainTrials {
  experiment::Experiment experiment = chainExperiment(1.35);
  experiment::CompiledExperiment compiled{experiment};
  record::ChannelTable table = record::makeChannelTable(experiment, compiled.constraint().parameterCount());
  RunTrials trials{table, kEvery, {compiled.constraint(), experiment.task->start, experiment.task->target}, {}};
};

// Three rows are missing: they lie on the straight line between their neighbours.
TEST(RunTrials, InterpolateRowsThatAreMissing) {
  const ChainTrials chain;
  const record::ChannelTable& table = chain.table;
  std::pair<std::uint64_t, std::uint64_t> asked;
  const TrialData trial = chain.trials.read(recordedTrial(), [&](std::uint64_t first, std::uint64_t last) {
    asked = {first, last};
    return rowsAt(table, {1010, 1020, 1050, 1070});
  });
  EXPECT_EQ(asked, (std::pair<std::uint64_t, std::uint64_t>{1003, 1071}));
  ASSERT_EQ(trial.hand.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    const std::uint64_t tick = 1010 + kEvery * i;
    EXPECT_LT(norm(trial.hand[i] - vectorOf(table, "hand_pos_x", tick)), 1e-9) << i;
    EXPECT_LT(norm(trial.object[i] - vectorOf(table, "mass5_pos_x", tick)), 1e-9) << i;
    EXPECT_LT(norm(trial.objectVelocity[i] - vectorOf(table, "mass5_vel_x", tick)), 1e-9) << i;
    EXPECT_NEAR(trial.force[i], norm(vectorOf(table, "coupling_force_x", tick)), 1e-9) << i;
  }
  EXPECT_DOUBLE_EQ(trial.rate, 100);
  EXPECT_NEAR(trial.first, 0.007, 1e-12);
  EXPECT_NEAR(trial.goTime, 0.1, 1e-12);
  EXPECT_NEAR(trial.taskOnset, 0.02, 1e-12);
  EXPECT_NEAR(trial.taskEnd, 0.068, 1e-12);
  EXPECT_TRUE(trial.catchTrial && !trial.closed);
  EXPECT_EQ(trial.peakForce, 4);
  EXPECT_EQ(trial.meanForce, 2);
  ASSERT_EQ(trial.along.size(), 1u) << "a straight task has one direction";
  EXPECT_LT(norm(trial.along[0] - Vec3{1, 0, 0}), 1e-12);
  EXPECT_LT(norm(trial.target - trial.start - Vec3{0.2, 0, 0}), 1e-12);
}

TEST(RunTrials, OfACurveHaveADirectionForEachSample) {
  experiment::Experiment e = experiment::readExperiment("ellipse");
  const experiment::CompiledExperiment compiled(e);
  const record::ChannelTable table = record::makeChannelTable(e, compiled.constraint().parameterCount());
  const constraints::TaskPath path(compiled.constraint(), e.task->start, e.task->target);
  const TrialData trial = RunTrials(table, kEvery, path, {}).read(recordedTrial(), [&](std::uint64_t, std::uint64_t) {
    return rowsAt(table, {1010, 1030});
  });
  EXPECT_TRUE(trial.closed);
  ASSERT_EQ(trial.along.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(norm(trial.along[i] - path.directionAt(valueOf(table.indexOf("mass1_q1"), 1010 + kEvery * i))), 1e-9) << i;
}

TEST(RunTrials, OfATrialThatWasNeverArmedOrNeverLeftHaveNoMoments) {
  const ChainTrials chain;
  const record::ChannelTable& table = chain.table;
  const auto rows = [&](std::uint64_t, std::uint64_t) { return rowsAt(table, {1010, 1020}); };
  record::RecordedTrial recorded = recordedTrial();
  recorded.armedTick = 0;
  EXPECT_TRUE(chain.trials.read(recorded, rows).hand.empty());
  recorded = recordedTrial();
  recorded.result.onsetTick = 0, recorded.goTick = 0;
  const TrialData still = chain.trials.read(recorded, rows);
  EXPECT_TRUE(std::isnan(still.taskOnset) && std::isnan(still.taskEnd) && std::isnan(still.goTime) && std::isnan(still.peakForce));
  EXPECT_EQ(still.hand.size(), 2u);
  recorded = recordedTrial();
  recorded.peakForce = 0;
  EXPECT_TRUE(std::isnan(chain.trials.read(recorded, rows).peakForce)) << "an older log has none";
  recorded = recordedTrial();
  recorded.result.endTick = 0, recorded.lastTick = 1040;
  EXPECT_NEAR(chain.trials.read(recorded, rows).taskEnd, 0.037, 1e-12) << "broken off there";
  EXPECT_TRUE(chain.trials.read(recorded, [&](std::uint64_t, std::uint64_t) { return rowsAt(table, {}); }).hand.empty());
}

}  // namespace
}  // namespace reachlab::analysis
