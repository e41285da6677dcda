#include <gtest/gtest.h>

#include "sim/record/run_log.h"
#include "sim/record/tidy_csv.h"
#include "tests/record/made_run.h"
#include "test_paths.h"

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
  EXPECT_EQ(versions, 1) << "one log a version";
}

}  // namespace
}  // namespace reachlab::record
