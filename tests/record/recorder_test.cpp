#include "sim/record/log/recorder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "sim/record/log/records.h"
#include "tests/in_a_folder.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

class Recording : public InAFolder {};

// One thread pushes as the haptic thread does, the recorder's writes: nothing is lost, torn or out of order. Run under TSan as
// well.
TEST_F(Recording, KeepsEveryTickThatAnotherThreadPushes) {
  RunConfiguration configuration = madeConfiguration();
  configuration.sampleEveryTicks = 1;
  constexpr std::uint64_t kTicks = 20 * MadeRun::kTicksPerTrial;
  {
    Recorder recorder(log_, configuration);
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
  const RunLog log = RunLog::open(log_);
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

TEST_F(Recording, SaysWhenItsQueueIsFullInsteadOfWaiting) {
  Recorder recorder(log_, madeConfiguration(), {.threaded = true, .queueTicks = 8});
  MadeRun run;
  std::uint64_t lost = 0;
  for (int tick = 0; tick < 20000; ++tick) lost += !recorder.onTick(run.next(), trial::Command::None, 0);
  recorder.close();
  EXPECT_GT(lost, 0u);
  EXPECT_EQ(RunLog::open(log_).ticks().size() + lost, 20000u);
}

TEST_F(Recording, GoesOnCountingTrialsInAResumedBlock) {
  RunConfiguration configuration = madeConfiguration();
  configuration.firstTrial = 8;
  writeMadeRun(log_, 2, configuration);
  const RunLog log = RunLog::open(log_);
  EXPECT_EQ(log.trials()[0].trial, 8);
  EXPECT_EQ(log.trials()[1].trial, 9);
  EXPECT_EQ(log.trials()[1].planned.index, 1) << "announced by the engine's count";
  const std::size_t column = configuration.table.indexOf("trial");
  const SampleRows rows = log.rows(log.trials()[1]);
  for (std::size_t row = 0; row < rows.size(); ++row) EXPECT_EQ(rows.at(row, column), 9);
}

// Two further hands, over several blocks of a thousand ticks.
TEST_F(Recording, KeepsEveryHandsRawSamples) {
  const RunConfiguration configuration = madeConfiguration(2, 3);
  constexpr std::uint64_t kTicks = 2500;
  const auto placeOf = [](std::uint64_t tick, std::size_t hand) {
    return Vec3{0.25 * static_cast<double>(tick / 3), 0, static_cast<double>(hand)};
  };
  MadeRecording recording(log_, configuration);
  recording.until(kTicks, [&](haptics::TickState& state) {
    state.handCount = 3;
    state.trial = 0, state.phase = trial::Phase::Idle;
    for (std::size_t hand = 0; hand < 2; ++hand) {
      state.hands[hand + 1].device.position = placeOf(state.tick, hand);
      state.hands[hand + 1].device.buttons = static_cast<std::uint32_t>(state.tick % 7 * hand);
    }
    return true;
  });
  const auto hands = recording.closed().otherTicks();
  ASSERT_EQ(hands.size(), 2u);
  for (std::size_t hand = 0; hand < 2; ++hand) {
    ASSERT_EQ(hands[hand].size(), kTicks);
    for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
      ASSERT_EQ(hands[hand][tick].position, placeOf(tick, hand)) << tick;
      ASSERT_EQ(hands[hand][tick].buttons, tick % 7 * hand);
    }
  }
  std::size_t blocks = 0;
  LogReader reader(log_);
  for (RecordView record; reader.next(record);) blocks += record.type == RecordType::HandTicks;
  EXPECT_EQ(blocks, 2 * 3u) << "a block for each hand with every thousand ticks, and the rest";
}

TEST_F(Recording, TimeIsCountedFromItsFirstTick) {
  RunConfiguration configuration = madeConfiguration();
  configuration.sampleEveryTicks = 4;
  MadeRecording recording(log_, configuration);
  EXPECT_EQ(recording.recorder.massesEvery(), 2u) << "for its rows and for a picture every hundredth of a second";
  recording.until(40, [](const haptics::TickState& state) { return state.tick >= 5; });
  const SampleRows rows = recording.closed().allRows();
  EXPECT_EQ(recording.recorder.processorSeconds(), 0) << "of a thread that is not there";
  ASSERT_EQ(rows.ticks, (std::vector<std::uint64_t>{8, 12, 16, 20, 24, 28, 32, 36}));
  for (std::size_t row = 0; row < rows.size(); ++row)
    EXPECT_DOUBLE_EQ(rows.at(row, 1), static_cast<double>(rows.ticks[row] - 5) * 1.000003e-3);
}

TEST_F(Recording, TellsTheDiskOnceAndForAll) {
  for (const bool threaded : {false, true}) {
    Recorder recorder(log_, madeConfiguration(), {.threaded = threaded});
    EXPECT_EQ(recorder.fault(), "");
    std::filesystem::remove(log_);
    MadeRun run;
    for (std::uint64_t tick = 0; tick < MadeRun::kTicksPerTrial; ++tick)
      EXPECT_TRUE(recorder.onTick(run.next(), trial::Command::None, 0)) << "the hand goes on";
    EXPECT_THROW(recorder.awaitTrial(1), ResourceError) << "which never waits for a trial that cannot come";
    const std::string first = recorder.fault();
    EXPECT_TRUE(holds(first, "is no longer there"));
    EXPECT_THROW(recorder.announce(2, {}), ResourceError);
    EXPECT_THROW(recorder.note("too late"), ResourceError);
    EXPECT_THROW(recorder.add(std::vector<RecordedEvent>(1)), ResourceError);
    EXPECT_NO_THROW(recorder.add({})) << "nothing is asked of it";
    EXPECT_THROW(recorder.close(), ResourceError);
    EXPECT_NO_THROW(recorder.close()) << "closed is closed";
    EXPECT_EQ(recorder.fault(), first);
  }
}

TEST_F(Recording, NotesAndEventsOfOthersStandWhereTheyCame) {
  MadeRecording recording(log_);
  Recorder& recorder = recording.recorder;
  recorder.note("before");
  recording.until(100);
  recorder.note("in the trial");
  recording.until(MadeRun::kTicksPerTrial);
  EXPECT_NO_THROW(recorder.awaitTrial(1));
  EXPECT_EQ(recorder.lastTrial().trial, 1);
  recorder.note("after");
  recorder.add({{77, EventKind::Instrument, 1, 0.5, "lamp"}});
  recorder.append(RecordType::PeerTicks, {});
  const RunLog log = recording.closed();
  EXPECT_TRUE(log.healthy());
  std::vector<std::tuple<std::uint64_t, std::int32_t, std::string>> notes;
  for (const RecordedEvent& event : log.events())
    if (event.kind == EventKind::Note || event.kind == EventKind::Instrument) notes.emplace_back(event.tick, event.trial, event.text);
  EXPECT_EQ(notes, (std::vector<std::tuple<std::uint64_t, std::int32_t, std::string>>{
                       {0, 0, "before"}, {99, 1, "in the trial"}, {274, 0, "after"}, {77, 1, "lamp"}}));
}

TEST_F(Recording, ARunThatIsClosedInATrialInterruptsIt) {
  MadeRecording recording(log_);
  recording.until(120);
  recording.recorder.close();
  const RunLog log = RunLog::open(log_, LogCheck::Trials);
  EXPECT_TRUE(log.healthy());
  ASSERT_EQ(log.trials().size(), 1u);
  EXPECT_EQ(log.trials()[0].result.outcome, trial::Outcome::Interrupted);
  EXPECT_EQ(log.trials()[0].lastTick, 119u);
}

// A thousand ticks are a block, whatever the clock says; a trial begins one of its own.
TEST_F(Recording, OnAVirtualClockBlocksAreCutByTicksAlone) {
  MadeRecording recording(log_);
  recording.until(3300, [](haptics::TickState& state) {
    state.trial = state.tick < 2300 ? 0 : 1;
    state.phase = state.tick < 2300 ? trial::Phase::Idle : trial::Phase::Waiting;
    return true;
  });
  recording.recorder.close();
  std::vector<std::size_t> sizes;
  LogReader reader(log_);
  for (RecordView record; reader.next(record);) {
    if (record.type != RecordType::Ticks) continue;
    std::vector<RecordedTick> ticks;
    decodeTicks(record.payload, ticks);
    sizes.push_back(ticks.size());
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{1000, 1000, 300, 1000}));
}

TEST_F(Recording, FurtherColumnsStandBehindTheScenes) {
  class Counted : public FurtherColumns {
   public:
    void fill(double* columns) const noexcept override { columns[0] = 12.5, columns[1] = -3; }
  };
  const Counted further;
  RunConfiguration configuration = madeConfiguration();
  const std::size_t scene = configuration.table.size();
  for (const char* name : {"station_a", "station_b"}) {
    configuration.table.channels.push_back(configuration.table.channels.back());
    configuration.table.channels.back().name = name;
  }
  MadeRecording recording(log_, configuration, {.threaded = false, .further = &further});
  recording.until(30);
  const SampleRows rows = recording.closed().allRows();
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_EQ(rows.at(row, scene), 12.5);
    EXPECT_EQ(rows.at(row, scene + 1), -3);
    EXPECT_EQ(rows.at(row, configuration.table.indexOf("mass2_pos_x")), MadeRun::valueAt(10 * row) + 1);
  }
}

}  // namespace
}  // namespace reachlab::record
