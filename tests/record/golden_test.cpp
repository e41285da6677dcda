#include <gtest/gtest.h>

#include <cmath>

#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/run_log.h"
#include "sim/record/replay.h"
#include "test_paths.h"
#include "tests/record/made_run.h"

namespace reachlab::record {
namespace {

/// The folders of the logs that releases wrote, a folder a release.
std::vector<std::string> releases() {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(REACHLAB_SOURCE_DIR "/tests/record/golden"))
    if (entry.is_directory()) found.push_back(entry.path().string());
  return found;
}

// Logs of every release stay readable, number for number. They were written by `record_bench log FILE 3 01 01 1`, whose
// content is a formula, so that nothing has to be kept beside them (its sine may differ by a rounding between mathematical
// libraries).
TEST(GoldenLogs, OfEveryReleaseReadBackAsTheyWereWritten) {
  ASSERT_FALSE(releases().empty());
  for (const std::string& release : releases()) {
    SCOPED_TRACE(release);
    const RunLog log = RunLog::open(release + "/made_log.reach");
    EXPECT_TRUE(log.healthy());
    EXPECT_EQ(log.configuration().seed, 18446744073709551615ull);
    EXPECT_EQ(log.configuration().experimentName, "made");
    ASSERT_EQ(log.trials().size(), 3u);
    EXPECT_EQ(log.trials()[1].result.reason, trial::Reason::Velocity);
    EXPECT_EQ(log.trials()[1].result.by, 0.002);
    const std::size_t x = log.configuration().table.indexOf("hand_pos_x");
    const SampleRows rows = log.allRows();
    ASSERT_EQ(rows.size(), 3 * MadeRun::kTicksPerTrial / 10 + 1);
    for (std::size_t row = 0; row < rows.size(); ++row) EXPECT_DOUBLE_EQ(rows.at(row, x), MadeRun::valueAt(rows.ticks[row]));
    for (const RecordedTick& tick : log.ticks()) EXPECT_DOUBLE_EQ(tick.device.position.x, MadeRun::valueAt(tick.tick));
  }
}

// A simulated hand's run of each release (golden/make_run.py): what a recording says of itself is computed again, bit for bit, by every
// later program.
TEST(GoldenLogs, OfEveryReleaseAreReplayedBitForBit) {
  for (const std::string& release : releases()) {
    SCOPED_TRACE(release);
    const std::string path = release + "/run_log.reach";
    const RunLog log = RunLog::open(path);
    EXPECT_TRUE(log.healthy());
    ASSERT_EQ(log.trials().size(), 2u);
    for (const RecordedTrial& trial : log.trials()) {
      EXPECT_GT(trial.result.onsetTick, 0u);
      EXPECT_TRUE(std::isfinite(trial.elapsed));
    }
    ASSERT_EQ(RunLog::open(path, LogCheck::Trials).trials().size(), 2u) << "by the chain of trial records as well";
    const Replay replay = replayRun(log);
    EXPECT_TRUE(replay.identical()) << replay.firstDifference;
    EXPECT_GT(replay.rows, 50u);
  }
}

}  // namespace
}  // namespace reachlab::record
