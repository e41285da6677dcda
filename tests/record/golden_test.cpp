#include <gtest/gtest.h>

#include <cmath>

#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/run_log.h"
#include "sim/record/replay.h"
#include "test_paths.h"
#include "tests/record/made_run.h"

namespace reachlab::record {
namespace {

// Logs of every released version stay readable, number for number. They were written by `record_bench log FILE 3 01 01 1`, whose
// content is a formula, so that nothing has to be kept beside them (its sine may differ by a rounding between mathematical
// libraries).
TEST(GoldenLogs, OfEveryVersionReadBackAsTheyWereWritten) {
  int versions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(REACHLAB_SOURCE_DIR "/tests/record/golden")) {
    SCOPED_TRACE(entry.path().string());
    const RunLog log = RunLog::open(entry.path().string());
    EXPECT_TRUE(log.healthy());
    EXPECT_EQ(log.configuration().seed, 18446744073709551615ull);
    EXPECT_EQ(log.configuration().experimentName, "made");
    ASSERT_EQ(log.trials().size(), 3u);
    // What was not asked for then is not asked for when it is computed again.
    EXPECT_EQ(log.configuration().rest.seconds, 0);
    EXPECT_GT(log.configuration().rest.speed, 100);
    EXPECT_EQ(log.trials()[1].result.reason, trial::Reason::Velocity);
    EXPECT_EQ(log.trials()[1].result.by, 0.002);
    const std::size_t x = log.configuration().table.indexOf("hand_pos_x");
    const SampleRows rows = log.allRows();
    ASSERT_EQ(rows.size(), 3 * MadeRun::kTicksPerTrial / 10 + 1);
    for (std::size_t row = 0; row < rows.size(); ++row) EXPECT_DOUBLE_EQ(rows.at(row, x), MadeRun::valueAt(rows.ticks[row]));
    for (const RecordedTick& tick : log.ticks()) EXPECT_DOUBLE_EQ(tick.device.position.x, MadeRun::valueAt(tick.tick));
    ++versions;
  }
  EXPECT_EQ(versions, static_cast<int>(kLogSchemaVersion)) << "one log a version";
}

// A simulated hand's run in each version that can be written (golden_runs/make_runs.py): what a recording says of itself is computed again,
// bit for bit, by every later program.
TEST(GoldenLogs, OfEveryVersionAreReplayedBitForBit) {
  for (std::uint32_t version = 1; version <= kLogSchemaVersion; ++version) {
    SCOPED_TRACE(version);
    const std::string path = REACHLAB_SOURCE_DIR "/tests/record/golden_runs/run-version-" + std::to_string(version) + "_log.reach";
    EXPECT_EQ(LogReader(path).schemaVersion(), version);
    const RunLog log = RunLog::open(path);
    EXPECT_TRUE(log.healthy());
    ASSERT_EQ(log.trials().size(), 2u);
    for (const RecordedTrial& trial : log.trials()) {
      EXPECT_GT(trial.result.onsetTick, 0u);
      EXPECT_EQ(std::isfinite(trial.elapsed), version >= 2) << "kept since version 2";
    }
    ASSERT_EQ(RunLog::open(path, LogCheck::Trials).trials().size(), 2u) << "by the chain of trial records as well";
    const Replay replay = replayRun(log);
    EXPECT_TRUE(replay.identical()) << replay.firstDifference;
    EXPECT_GT(replay.rows, 50u);
  }
}

}  // namespace
}  // namespace reachlab::record
