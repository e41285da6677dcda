#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "sim/record/log/run_log.h"
#include "sim/record/replay.h"
#include "test_paths.h"

namespace reachlab::record {
namespace {

/// The folders of the logs that releases wrote, a folder a release.
std::vector<std::string> releases() {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(REACHLAB_SOURCE_DIR "/tests/record/golden"))
    if (entry.is_directory()) found.push_back(entry.path().string());
  return found;
}

// A simulated hand's run of each release (golden/make_run.py): what a recording says of itself is computed again, bit for bit, by every
// later program.
TEST(GoldenLogs, OfEveryReleaseAreReplayedBitForBit) {
  ASSERT_FALSE(releases().empty());
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
