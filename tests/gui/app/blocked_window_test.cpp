#include "base/system/os.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/run_log.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::app {
namespace {

class BlockedWindow : public AtTheWindow {
 protected:
  BlockedWindow() {
    experiment::Experiment slow = experiment::readExperiment("chain-slow");
    slow.timing = experiment::kNoTimingLimits;
    request_.what = write("slow.json", experiment::toJson(slow));
    request_.device = "simulated:noise=0";
    request_.trials = 1;
    request_.timingCheckSeconds = 0;
  }
};

// The haptic loop has a thread of its own: whatever the window does for two seconds, the loop ticks and every tick is recorded. How many the
// computer itself misses meanwhile is not judged.
TEST_F(BlockedWindow, ThatStandsStillForTwoSecondsCostsNoTick) {
  MainWindow& window = open();
  QTest::keyClick(&window, Qt::Key_Space);
  ASSERT_TRUE(waitForPhase(trial::Phase::Moving));
  const haptics::LoopReport before = window.session().run()->report();
  constexpr std::int64_t kBlockNs = 2'000'000'000;
  os::sleepUntil(os::now() + kBlockNs);  // no event is taken, nothing is drawn
  const haptics::LoopReport after = window.session().run()->report();
  const std::uint64_t ticks = after.ticks - before.ticks, missed = after.faults.missedTicks - before.faults.missedTicks;
  EXPECT_GE(ticks + missed, 1990u) << "the loop went on";
  EXPECT_GT(ticks, missed);
  EXPECT_EQ(after.faults.droppedRecords, before.faults.droppedRecords);
  const std::string log = window.session().run()->logPath();
  ASSERT_TRUE(waitForTrialsEnd());
  window.session().endRun();
  const std::vector<record::RecordedTick> recorded = record::RunLog::open(log).ticks();
  ASSERT_GT(recorded.size(), ticks);
  for (std::size_t i = 1; i < recorded.size(); ++i) ASSERT_EQ(recorded[i].tick, recorded[i - 1].tick + 1) << "none is lost";
}

}  // namespace
}  // namespace reachlab::gui::app
