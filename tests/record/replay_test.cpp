// What a replay says of a recording in which something was changed.
#include "sim/record/replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/records.h"
#include "tests/in_a_folder.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

using Bytes = std::vector<std::uint8_t>;

const std::string kRecorded = REACHLAB_SOURCE_DIR "/tests/record/golden/0.2.0/run_log.reach";

// A copy of the recorded run, whose records `edit` may change, or leave out by false.
template <typename Edit>
RunLog edited(const TemporaryFolder& folder, Edit edit) {
  const std::string path = folder / "edited_log.reach";
  copyLog(kRecorded, path, edit);
  return RunLog::open(path);
}

// The number in a row of the first record of samples that is long enough, times 1 + 1e-9.
auto changeOf(std::size_t row, std::size_t column, std::size_t columns) {
  return [=, done = false](RecordType type, Bytes& payload) mutable {
    const std::size_t at = 8 + row * 8 * (columns + 1) + 8 * (column + 1);
    if (done || type != RecordType::Samples || payload.size() < at + 8) return true;
    double value = 0;
    std::memcpy(&value, payload.data() + at, 8);
    value = value * (1 + 1e-9) + 1e-12;
    std::memcpy(payload.data() + at, &value, 8);
    done = true;
    return true;
  };
}

class Replayed : public InAFolder {};

TEST_F(Replayed, LooksAtEveryTickRowAndTrial) {
  const RunLog log = edited(folder_, [](RecordType, Bytes&) { return true; });
  const Replay replay = replayRun(log);
  EXPECT_TRUE(replay.identical());
  EXPECT_EQ(replay.ticks, log.ticks().size());
  EXPECT_EQ(replay.rows, log.allRows().size());
  EXPECT_EQ(replay.rowsThatDiffer, 0u);
  EXPECT_EQ(replay.firstDifference, "");
  ASSERT_EQ(replay.trials.size(), log.trials().size());
  for (std::size_t i = 0; i < replay.trials.size(); ++i) EXPECT_EQ(bytesOf(replay.trials[i]), bytesOf(log.trials()[i])) << "trial " << i;
}

TEST_F(Replayed, OneNumberThatDiffersIsNamedWithItsTickAndChannel) {
  const ChannelTable table = RunLog::open(kRecorded).configuration().table;
  for (const std::size_t column : {std::size_t{0}, table.indexOf("mass1_pos_x"), table.size() - 1}) {
    const RunLog log = edited(folder_, changeOf(3, column, table.size()));
    const Replay replay = replayRun(log);
    EXPECT_FALSE(replay.identical());
    EXPECT_EQ(replay.rowsThatDiffer, 1u);
    EXPECT_EQ(replay.trialsThatDiffer, 0);
    const std::string what = "tick " + std::to_string(log.allRows().ticks[3]) + ", " + table.channels[column].name + ": recorded ";
    EXPECT_EQ(replay.firstDifference.find(what), 0u) << replay.firstDifference;
  }
  EXPECT_TRUE(replayRun(edited(folder_, changeOf(3, table.indexOf("measured_time"), table.size()))).identical())
      << "the computer's clock is not simulated";
}

TEST_F(Replayed, ATrialThatDiffersInAnythingIsCounted) {
  const auto withSecond = [&](const std::function<void(trial::TrialResult&)>& change) {
    int trials = 0;
    return replayRun(edited(folder_, [&](RecordType type, Bytes& payload) {
      if (type != RecordType::Trial || ++trials != 2) return true;
      TrialLink link;
      RecordedTrial t = decodeTrial(payload, link);
      change(t.result);
      ByteWriter out;
      encode(t, link, out);
      payload.assign(out.bytes().begin(), out.bytes().end());
      return true;
    }));
  };
  using trial::TrialResult;
  const std::vector<std::function<void(TrialResult&)>> changes{
      [](TrialResult& r) { r.outcome = r.outcome == trial::Outcome::Success ? trial::Outcome::Failure : trial::Outcome::Success; },
      [](TrialResult& r) { r.reason = trial::Reason::Timing; },
      [](TrialResult& r) { ++r.mass; },
      [](TrialResult& r) { r.by += 1e-12; },
      [](TrialResult& r) { r.movementTime += 1e-12; },
      [](TrialResult& r) { ++r.onsetTick; },
      [](TrialResult& r) { ++r.endTick; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Replay replay = withSecond(changes[i]);
    EXPECT_EQ(replay.trialsThatDiffer, 1) << i;
    EXPECT_FALSE(replay.identical());
    EXPECT_EQ(replay.firstDifference, "trial 2: the result differs");
    EXPECT_EQ(replay.rowsThatDiffer, 0u);
  }
  const Replay broken = withSecond([](TrialResult& r) { r.reason = trial::Reason::Program, r.mass = 9; });
  EXPECT_EQ(broken.trialsThatDiffer, 0) << "what the program's end broke off has no result to compare";
}

TEST_F(Replayed, StopsWhereATickIsMissing) {
  int blocks = 0;
  std::uint64_t missing = 0;
  const RunLog log = edited(folder_, [&](RecordType type, Bytes& payload) {
    if (type != RecordType::Ticks || ++blocks != 3) return true;
    std::vector<RecordedTick> ticks;
    decodeTicks(payload, ticks);
    missing = ticks.front().tick;
    return false;
  });
  ASSERT_GT(missing, 0u);
  EXPECT_EQ(
      reachlab::refusalOf([&] { replayRun(log); }),
      log.path() + ": tick " + std::to_string(missing) + " is missing (dropped while recording), so the run cannot be simulated past it");
}

TEST_F(Replayed, ATrialThatNobodyAnnouncedIsSimulatedAsAPlainOne) {
  const Replay replay = replayRun(edited(folder_, [](RecordType type, Bytes&) { return type != RecordType::TrialSetup; }));
  EXPECT_EQ(replay.trials.size(), 2u);
}

TEST_F(Replayed, ATableOfOtherMassesOrHandsIsRefused) {
  const RunConfiguration recorded = RunLog::open(kRecorded).configuration();
  const auto refusalOf = [&](int masses, int parameters, int hands, bool body) {
    experiment::Experiment scene;
    scene.object.kind = body ? experiment::ObjectKind::Body : experiment::ObjectKind::Chain;
    scene.object.masses.assign(static_cast<std::size_t>(masses), 1);
    if (hands > 1) scene.hands.resize(static_cast<std::size_t>(hands));
    RunConfiguration c = recorded;
    c.table = makeChannelTable(scene, parameters);
    c.otherHands.resize(static_cast<std::size_t>(hands - 1));
    const std::string path = folder_ / "table_log.reach";
    std::filesystem::remove(path);
    LogWriter::create(path).append(RecordType::Configuration, asBytes(toJson(c)));
    return reachlab::refusalOf<FaultError>([&] { replayRun(RunLog::open(path)); }, path + "replayed").substr(path.size());
  };
  const ChannelTable& t = recorded.table;
  const std::string words = ": table: has not the masses, hands, forces and cursor of its experiment, so the run cannot be simulated again";
  EXPECT_EQ(refusalOf(t.massCount, t.parameterCount, 1, t.body), "replayed");
  EXPECT_EQ(refusalOf(t.massCount + 1, t.parameterCount, 1, t.body), words);
  EXPECT_EQ(refusalOf(t.massCount, t.parameterCount + 1, 1, t.body), words);
  EXPECT_NE(refusalOf(t.massCount, t.parameterCount, 2, t.body), "replayed");
  EXPECT_EQ(refusalOf(t.massCount, t.parameterCount, 1, !t.body), words);
}

}  // namespace
}  // namespace reachlab::record
