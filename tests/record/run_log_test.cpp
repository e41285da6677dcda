#include "sim/record/configuration/limits.h"
#include "sim/record/log/run_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/fault.h"
#include "sim/record/log/append_file.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/whole_file.h"
#include "sim/record/recover.h"
#include "tests/in_a_folder.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

void writeBytes(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes; }

class RunLogs : public InAFolder {};

TEST_F(RunLogs, GivesBackWhatWasRecorded) {
  writeMadeRun(log_, 3);
  const RunLog log = RunLog::open(log_);
  EXPECT_TRUE(log.healthy());
  EXPECT_EQ(log.configuration().seed, 18446744073709551615ull);
  ASSERT_EQ(log.trials().size(), 3u);
  const RecordedTrial& second = log.trials()[1];
  EXPECT_EQ(second.trial, 2);
  EXPECT_EQ(second.planned.foreperiodTicks, 10);
  EXPECT_EQ(second.result.reason, trial::Reason::Velocity);
  EXPECT_EQ(second.result.by, 0.002);
  EXPECT_EQ(second.startTick, MadeRun::kTicksPerTrial);
  EXPECT_EQ(second.armedTick, MadeRun::kTicksPerTrial + MadeRun::kWaiting);
  EXPECT_EQ(second.goTick, second.armedTick + 10);

  const SampleRows rows = log.rows(second);
  const std::size_t x = log.configuration().table.indexOf("hand_pos_x");
  ASSERT_GT(rows.size(), 20u);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    EXPECT_EQ(rows.ticks[row] % 10, 0u);
    EXPECT_EQ(rows.at(row, x), MadeRun::valueAt(rows.ticks[row]));
  }
  EXPECT_EQ(log.allRows().size(), 3 * MadeRun::kTicksPerTrial / 10 + 1);

  const std::vector<RecordedTick> ticks = log.ticks();
  ASSERT_EQ(ticks.size(), 3 * MadeRun::kTicksPerTrial);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_EQ(ticks[i].tick, i);
    EXPECT_EQ(ticks[i].device.position.x, MadeRun::valueAt(i));
    EXPECT_EQ(ticks[i].measuredNs, static_cast<std::int64_t>(i) * 1000003);
    EXPECT_EQ(ticks[i].command == trial::Command::NextTrial, i % MadeRun::kTicksPerTrial == 0);
  }
}

TEST_F(RunLogs, ListsTheSameTrialsByTheChainAsByReadingEverything) {
  for (const bool closed : {true, false}) {
    const std::string path = folder_ / (closed ? "closed_log.reach" : "open_log.reach");
    writeMadeRun(path, 12);
    if (!closed) {  // cut in the last trial, as a kill leaves it
      const RunLog whole = RunLog::open(path);
      std::filesystem::resize_file(path, whole.trials().back().offset + 400);
    }
    const RunLog everything = RunLog::open(path, LogCheck::Everything);
    const RunLog quick = RunLog::open(path, LogCheck::Trials);
    ASSERT_EQ(everything.trials().size(), quick.trials().size());
    for (std::size_t i = 0; i < quick.trials().size(); ++i) EXPECT_EQ(bytesOf(quick.trials()[i]), bytesOf(everything.trials()[i]));
    EXPECT_EQ(quick.rows(quick.trials()[7]).values, everything.rows(everything.trials()[7]).values);
  }
}

class RecoverLog : public InAFolder {};

TEST_F(RecoverLog, LeavesAHealthyLogAlone) {
  writeMadeRun(log_, 2);
  const std::string before = readWholeFile(log_);
  EXPECT_FALSE(recoverLog(log_).mended);
  EXPECT_EQ(readWholeFile(log_), before);
  EXPECT_FALSE(std::filesystem::exists(log_ + ".damaged"));
}

TEST_F(RecoverLog, KeepsEverythingBeforeTheDamageAndEachOriginalUnderANameOfItsOwn) {
  const std::string link = folder_ / "link_log.reach";  // the log behind it is repaired
  std::filesystem::create_symlink(log_, link);
  for (const char* name : {".damaged", ".damaged-2", ".damaged-3"}) {
    SCOPED_TRACE(name);
    std::filesystem::remove(log_);
    writeMadeRun(log_, 4);
    const RunLog whole = RunLog::open(log_);
    std::string bytes = readWholeFile(log_);
    bytes[whole.trials()[2].offset + 500] ^= 1;
    writeBytes(log_, bytes);
    const Recovery recovery = recoverLog(link);
    EXPECT_TRUE(recovery.mended);
    EXPECT_EQ(recovery.damagedOriginal, log_ + name);
    EXPECT_EQ(readWholeFile(log_ + name), bytes);
    const RunLog mended = RunLog::open(log_);
    EXPECT_TRUE(mended.healthy());
    ASSERT_GE(mended.trials().size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(bytesOf(mended.trials()[i]), bytesOf(whole.trials()[i]));
    EXPECT_FALSE(recoverLog(log_).mended) << "a mended log is healthy";
    EXPECT_FALSE(std::filesystem::exists(log_ + ".mended"));
  }
}

TEST_F(RecoverLog, ClosesTheTrialThatWasUnderWayAndEndsTheLogInOrder) {
  writeMadeRun(log_, 3);
  const RunLog whole = RunLog::open(log_);
  const std::size_t rows = whole.rows(whole.trials()[2]).size();
  cutInTheLastTrialsRecord(log_);
  const RunLog cut = RunLog::open(log_);
  const Recovery recovery = recoverLog(log_);
  EXPECT_TRUE(recovery.mended);
  EXPECT_EQ(recovery.trials, 3);
  EXPECT_TRUE(recovery.interruptedTrial);
  EXPECT_EQ(recovery.keptBytes, cut.goodBytes());
  EXPECT_EQ(recovery.lostBytes, cut.fileBytes() - cut.goodBytes());
  EXPECT_GT(recovery.lostBytes, 0u);
  for (const LogCheck check : {LogCheck::Everything, LogCheck::Trials}) {
    const RunLog mended = RunLog::open(log_, check);
    EXPECT_TRUE(mended.closed());
    EXPECT_TRUE(mended.healthy());
    ASSERT_EQ(mended.trials().size(), 3u);
    EXPECT_EQ(bytesOf(mended.trials()[1]), bytesOf(whole.trials()[1]));
    EXPECT_EQ(mended.trials()[2].result.outcome, trial::Outcome::Interrupted);
    EXPECT_EQ(mended.trials()[2].startTick, whole.trials()[2].startTick);
    EXPECT_EQ(mended.rows(mended.trials()[2]).size(), rows);
  }
  EXPECT_FALSE(std::filesystem::exists(log_ + ".mended"));
}

TEST_F(RecoverLog, WhatIsCutBetweenTwoTrialsHasNoneThatIsInterrupted) {
  writeMadeRun(log_, 2);
  std::filesystem::resize_file(log_, std::filesystem::file_size(log_) - 1);
  const Recovery recovery = recoverLog(log_);
  EXPECT_TRUE(recovery.mended);
  EXPECT_FALSE(recovery.interruptedTrial);
  EXPECT_EQ(recovery.trials, 2);
  EXPECT_EQ(recovery.lostBytes, 27u) << "of the closing record of 28 bytes";
  EXPECT_TRUE(RunLog::open(log_, LogCheck::Trials).healthy());
}

TEST_F(RecoverLog, RefusesALogWithoutItsConfiguration) {
  writeMadeRun(log_, 1);
  std::string bytes = readWholeFile(log_);
  bytes[100] ^= 1;
  writeBytes(log_, bytes);
  EXPECT_THROW(recoverLog(log_), FaultError);
}

// As an earlier program wrote them, which no reader took.
TEST_F(RecoverLog, ShortensALabelThatFileNamesDoNotHold) {
  const std::string good = folder_ / "good_log.reach", path = log_;
  RunConfiguration configuration = madeConfiguration();
  configuration.task = std::string(60, 'a');
  writeMadeRun(good, 3, configuration);
  configuration.task += "bcd";
  copyLogAs(good, path, toJson(configuration));
  const std::string before = readWholeFile(path);
  EXPECT_THROW(RunLog::open(path), FaultError);
  const Recovery recovery = recoverLog(path);
  EXPECT_TRUE(recovery.mended);
  EXPECT_EQ(recovery.trials, 3);
  EXPECT_EQ(readWholeFile(recovery.damagedOriginal), before);
  const RunLog log = RunLog::open(path);
  EXPECT_EQ(log.configuration().task, std::string(60, 'a'));
  EXPECT_EQ(log.allRows().size(), RunLog::open(good).allRows().size());
  EXPECT_FALSE(recoverLog(path).mended);
}

TEST(Recorder, CreatesNothingThatNobodyCouldRead) {
  const TemporaryFolder folder;
  RunConfiguration configuration = madeConfiguration();
  configuration.run = kMaxRun + 1;
  EXPECT_THROW(Recorder(folder / "a_log.reach", configuration, {.threaded = false}), FaultError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a_log.reach"));
}

TEST_F(RecoverLog, RefusesALogThatIsBeingWritten) {
  Recorder recorder(log_, madeConfiguration(), {.threaded = false});
  EXPECT_THROW(recoverLog(log_), ResourceError);
}

// One seeded random damage: a flipped bit, a cut, a duplicated or a zero-filled stretch.
std::string damaged(const std::string& good, std::mt19937_64& random, std::size_t& firstTouched) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::string bytes = good;
  const std::size_t at = below(good.size());
  const std::size_t length = std::min(good.size() - at, 1 + below(4000));
  switch (random() % 5) {
    case 0: bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8))); break;
    case 1: bytes.resize(at); break;
    case 2: bytes.erase(at, length); break;
    case 3: bytes.insert(at, good.substr(at, length)); break;
    default: std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
  }
  firstTouched = std::min(bytes.size(), good.size());
  for (std::size_t i = 0; i < firstTouched; ++i)
    if (bytes[i] != good[i]) firstTouched = i;
  return bytes;
}

// Whatever happens to the bytes: no crash, no changed number, and every trial that was finished before the damage is there.
TEST_F(RunLogs, SurvivesTenThousandRandomDamagesWithoutOneWrongNumber) {
  RunConfiguration configuration = madeConfiguration(1);
  configuration.sampleEveryTicks = 50;
  const std::string whole = folder_ / "whole_log.reach", hurt = folder_ / "hurt_log.reach";
  writeMadeRun(whole, 5, configuration);
  const RunLog good = RunLog::open(whole);
  const std::string bytes = readWholeFile(whole);
  const std::size_t x = configuration.table.indexOf("hand_pos_x");
  std::mt19937_64 random(20261121);
  int refused = 0, shortened = 0;
  for (int k = 0; k < 10000; ++k) {
    std::size_t firstTouched = 0;
    writeBytes(hurt, damaged(bytes, random, firstTouched));
    try {
      for (const LogCheck check : {LogCheck::Everything, LogCheck::Trials}) {
        const RunLog log = RunLog::open(hurt, check);
        ASSERT_LE(log.trials().size(), good.trials().size());
        std::size_t finished = 0;
        for (const RecordedTrial& trial : log.trials()) {
          if (!trial.complete) continue;
          EXPECT_EQ(bytesOf(trial), bytesOf(good.trials()[finished]));
          ++finished;
        }
        std::size_t before = 0;
        while (before + 1 < good.trials().size() && good.trials()[before + 1].offset <= firstTouched) ++before;
        EXPECT_GE(finished, before) << "damage " << k << " at " << firstTouched;
        shortened += finished < good.trials().size();
        if (check == LogCheck::Trials) continue;
        const SampleRows rows = log.allRows();
        for (std::size_t row = 0; row < rows.size(); ++row) ASSERT_EQ(rows.at(row, x), MadeRun::valueAt(rows.ticks[row]));
        for (const RecordedTick& tick : log.ticks()) ASSERT_EQ(tick.device.position.x, MadeRun::valueAt(tick.tick));
      }
    } catch (const FaultError&) {
      // Only damage to the header or the configuration makes a log unreadable as a whole.
      EXPECT_LT(firstTouched, good.trials()[0].offset) << "damage " << k;
      ++refused;
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(shortened, 1000);
}

// Every reader of a part gives what is in the whole.
TEST_F(RunLogs, GivesTheRowsBetweenAnyTwoTicks) {
  writeMadeRun(log_, 4);
  const RunLog log = RunLog::open(log_);
  const SampleRows all = log.allRows();
  const auto end = 4 * MadeRun::kTicksPerTrial;
  for (const auto& [first, last] : std::vector<std::pair<std::uint64_t, std::uint64_t>>{
           {0, 0}, {0, end}, {1, 9}, {10, 10}, {270, 280}, {274, 275}, {275, 549}, {280, 820}, {551, 559}, {end, end + 100}, {30, 20}}) {
    std::vector<std::uint64_t> expected;
    for (const std::uint64_t tick : all.ticks)
      if (tick >= first && tick <= last) expected.push_back(tick);
    EXPECT_EQ(log.rows(first, last).ticks, expected) << first << " to " << last;
  }
  std::vector<double> blocks;
  log.eachBlock([&](const SampleRows& block) { blocks.insert(blocks.end(), block.values.begin(), block.values.end()); });
  EXPECT_EQ(blocks, all.values);
}

TEST_F(RunLogs, GivesSetupsAndEventsOfTheWholeRun) {
  writeMadeRun(log_, 6);
  const std::vector<TrialSetup> setups = RunLog::open(log_).setups();
  ASSERT_EQ(setups.size(), 6u);
  for (int i = 0; i < 6; ++i) {
    const TrialSetup& setup = setups[static_cast<std::size_t>(i)];
    EXPECT_EQ(setup.trial, i + 1);
    EXPECT_EQ(setup.planned.index, i);
    EXPECT_EQ(setup.planned.foreperiodTicks, 5 * (i + 1));
    EXPECT_EQ(setup.planned.catchTrial, i == 4);
  }
  std::map<EventKind, int> kinds;
  for (const RecordedEvent& event : RunLog::open(log_).events()) ++kinds[event.kind];
  EXPECT_EQ(kinds[EventKind::TrialStart], 6);
  EXPECT_EQ(kinds[EventKind::Go], 5) << "but in the catch trial";
  EXPECT_EQ(kinds[EventKind::TrialEnd], 6);
}

TEST_F(RunLogs, OfABrokenOffTrialKnowsWhatWasLoggedOfIt) {
  {
    MadeRecording recording(folder_ / "whole_log.reach");
    recording.recorder.announce(1, {4, 12, false});
    recording.until(150);
    recording.recorder.note("coffee spilt");  // hands everything to the kernel
    std::filesystem::copy_file(folder_ / "whole_log.reach", log_);
  }
  for (const LogCheck check : {LogCheck::Everything, LogCheck::Trials}) {
    const RunLog log = RunLog::open(log_, check);
    EXPECT_FALSE(log.closed());
    if (check == LogCheck::Everything) {
      EXPECT_FALSE(log.healthy());
    }
    EXPECT_EQ(log.events().back().text, "coffee spilt");
    ASSERT_EQ(log.trials().size(), 1u);
    const RecordedTrial& t = log.trials()[0];
    EXPECT_EQ(t.trial, 1);
    EXPECT_EQ(t.planned.index, 4);
    EXPECT_EQ(t.planned.foreperiodTicks, 12);
    EXPECT_EQ(t.armedTick, 20u);
    EXPECT_EQ(t.goTick, 32u);
    EXPECT_EQ(t.lastTick, 149u);
    EXPECT_EQ(t.result.outcome, trial::Outcome::Interrupted);
    EXPECT_EQ(t.result.reason, trial::Reason::Program);
    EXPECT_EQ(t.result.onsetTick, 50u);
    EXPECT_EQ(t.result.endTick, 149u);
    EXPECT_EQ(t.result.movementTime, 0.099);
    EXPECT_FALSE(t.complete);
    for (const double unknown : {t.peakHandSpeed, t.handPathLength, t.peakForce, t.meanForce}) EXPECT_TRUE(std::isnan(unknown));
    EXPECT_EQ(log.rows(t).size(), 15u);
  }
}

TEST(FindLogs, OfADatasetASessionASubjectOrAFile) {
  const TemporaryFolder folder;
  const auto put = [&](const char* name) { writeFileAtomically(folder / name, ""); };
  for (const char* name : {"data/sourcedata/sub-01_ses-01_task-a_run-01_log.reach", "data/sourcedata/sub-01_ses-02_task-a_run-01_log.reach",
                           "data/sourcedata/sub-02_ses-01_task-a_run-01_log.reach", "data/sourcedata/notes.txt", "data/sub-01/ses-01/x",
                           "data/sub-01/ses-09/x", "plain/b_log.reach", "plain/a_log.reach", "plain/a_log.reach.damaged",
                           "sub-pilot/sourcedata/c_log.reach", "sub-pilot/ses-old/sourcedata/d_log.reach"})
    put(name);
  const auto found = [&](const std::string& path) {
    std::vector<std::string> names;
    for (const std::string& log : findLogs(folder / path)) names.push_back(std::filesystem::path(log).filename().string());
    return names;
  };
  const auto run = [](const char* subject, const char* session) {
    return std::string("sub-") + subject + "_ses-" + session + "_task-a_run-01_log.reach";
  };
  EXPECT_EQ(found("data"), (std::vector<std::string>{run("01", "01"), run("01", "02"), run("02", "01")}));
  EXPECT_EQ(found("data/"), found("data"));
  EXPECT_EQ(found("data/sourcedata"), found("data"));
  EXPECT_EQ(found("data/sub-01"), (std::vector<std::string>{run("01", "01"), run("01", "02")}));
  EXPECT_EQ(found("data/sub-01/ses-01"), (std::vector<std::string>{run("01", "01")}));
  EXPECT_EQ(found("data/sub-01/ses-01/"), (std::vector<std::string>{run("01", "01")}));
  EXPECT_EQ(found("sub-pilot"), (std::vector<std::string>{"c_log.reach"})) << "a dataset of that name";
  EXPECT_EQ(found("sub-pilot/ses-old"), (std::vector<std::string>{"d_log.reach"}));
  EXPECT_EQ(found("plain"), (std::vector<std::string>{"a_log.reach", "b_log.reach"})) << "sorted";
  EXPECT_EQ(found("data/sourcedata/notes.txt"), (std::vector<std::string>{"notes.txt"})) << "a file is taken as it is";
  const auto refusal = [&](const std::string& path) {
    return refusalOf<FaultError>([&] { findLogs(folder / path); }, (folder / path).string() + "found")
        .substr((folder / path).string().size());
  };
  EXPECT_EQ(refusal("data/sub-01/ses-09"), ": no logs (…_log.reach) in this folder");
  EXPECT_EQ(refusal("nothing"), ": no such log or folder");
}

}  // namespace
}  // namespace reachlab::record
