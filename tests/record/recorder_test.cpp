#include "sim/record/recorder.h"

#include <gtest/gtest.h>

#include <thread>

#include "base/error.h"
#include "tests/record/made_run.h"

namespace reachlab::record {
namespace {

// One thread pushes as the haptic thread does, the recorder's writes: nothing is lost, torn or out of order. Run under TSan as
// well.
TEST(Recorder, KeepsEveryTickThatAnotherThreadPushes) {
  const TemporaryFolder folder("recorder");
  const std::string path = folder / "a_log.reach";
  RunConfiguration configuration = madeConfiguration();
  configuration.sampleEveryTicks = 1;
  constexpr std::uint64_t kTicks = 20 * MadeRun::kTicksPerTrial;
  {
    Recorder recorder(path, configuration);
    std::jthread haptic([&] {
      MadeRun run;
      for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
        const haptics::TickState& state = run.next();
        while (!recorder.onTick(state, trial::Command::None, 0)) std::this_thread::yield();
      }
    });
    recorder.awaitTrial(20);
    haptic.join();
    recorder.close();
    EXPECT_EQ(recorder.fault(), "");
    EXPECT_GT(recorder.processorSeconds(), 0);
  }
  const RunLog log = RunLog::open(path);
  EXPECT_EQ(log.trials().size(), 20u);
  const SampleRows rows = log.allRows();
  ASSERT_EQ(rows.size(), kTicks);
  const std::size_t x = configuration.table.indexOf("hand_pos_x");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    ASSERT_EQ(rows.ticks[row], row);
    ASSERT_EQ(rows.at(row, x), MadeRun::valueAt(row));
  }
  EXPECT_EQ(log.ticks().size(), kTicks);
}

TEST(Recorder, SaysWhenItsQueueIsFullInsteadOfWaiting) {
  const TemporaryFolder folder("queue");
  Recorder recorder(folder / "a_log.reach", madeConfiguration(), {.threaded = true, .queueTicks = 8});
  MadeRun run;
  std::uint64_t lost = 0;
  for (int tick = 0; tick < 20000; ++tick) lost += !recorder.onTick(run.next(), trial::Command::None, 0);
  recorder.close();
  EXPECT_GT(lost, 0u);
  EXPECT_EQ(RunLog::open(folder / "a_log.reach").ticks().size() + lost, 20000u);
}

TEST(Recorder, GoesOnCountingTrialsInAResumedBlock) {
  const TemporaryFolder folder("count");
  RunConfiguration configuration = madeConfiguration();
  configuration.firstTrial = 8;
  writeMadeRun(folder / "a_log.reach", 2, configuration);
  const RunLog log = RunLog::open(folder / "a_log.reach");
  EXPECT_EQ(log.trials()[0].trial, 8);
  EXPECT_EQ(log.trials()[1].trial, 9);
  EXPECT_EQ(log.trials()[1].planned.index, 1) << "announced by the engine's count";
  const std::size_t column = configuration.table.indexOf("trial");
  const SampleRows rows = log.rows(log.trials()[1]);
  for (std::size_t row = 0; row < rows.size(); ++row) EXPECT_EQ(rows.at(row, column), 9);
}

TEST(Recorder, ATrialThatNobodyAnnouncedHasThePlaceOfItsNumber) {
  const TemporaryFolder folder("unannounced");
  Recorder recorder(folder / "a_log.reach", madeConfiguration(), {.threaded = false});
  MadeRun run;
  for (std::uint64_t tick = 0; tick < 2 * MadeRun::kTicksPerTrial; ++tick)
    recorder.onTick(run.next(), tick % MadeRun::kTicksPerTrial == 0 ? trial::Command::NextTrial : trial::Command::None, 0);
  recorder.close();
  const RunLog log = RunLog::open(folder / "a_log.reach");
  ASSERT_EQ(log.trials().size(), 2u);
  for (const RecordedTrial& trial : log.trials()) EXPECT_EQ(trial.planned.index, trial.trial - 1);
}

TEST(Recorder, NoticesThatItsFileWasTakenAway) {
  const TemporaryFolder folder("gone");
  Recorder recorder(folder / "a_log.reach", madeConfiguration(), {.threaded = false});
  std::filesystem::remove(folder / "a_log.reach");
  MadeRun run;
  for (std::uint64_t tick = 0; tick < MadeRun::kTicksPerTrial; ++tick) recorder.onTick(run.next(), trial::Command::None, 0);
  EXPECT_THROW(recorder.awaitTrial(1), ResourceError);
  EXPECT_NE(recorder.fault(), "");
}

}  // namespace
}  // namespace reachlab::record
