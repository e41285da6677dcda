#include <algorithm>
#include <filesystem>
#include <map>

#include "base/fault.h"
#include "base/table_text.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/bids.h"
#include "sim/record/export/run_tables.h"
#include "sim/record/recover.h"
#include "sim/record/replay.h"
#include "sim/record/trial_index.h"
#include "tests/session/kinds_block.h"
#include "tests/refusal.h"

// A block of several kinds of trials from the plan to log, replay, tables and analysis.
namespace reachlab::session {
namespace {

using test::Kinds;

TEST_F(Kinds, TheFirstRecordListsThemAndEachTrialIsDoneInItsOwn) {
  ASSERT_TRUE(record());
  const record::RunLog log = logs().at(0);
  const record::RunConfiguration& c = log.configuration();
  ASSERT_TRUE(c.scenes);
  ASSERT_EQ(c.scenes->size(), 3u);
  EXPECT_EQ(c.scenes->at(1).kind, "thick");
  EXPECT_EQ(c.scenes->at(1).condition, "thick");
  EXPECT_FALSE(c.scenes->at(1).method.empty());
  const std::vector<std::string> kinds = kindsOf(log);
  ASSERT_EQ(kinds.size(), 12u);
  std::map<std::string, double> peak;
  for (const record::RecordedTrial& trial : log.trials()) {
    const std::string& kind = record::sceneOf(c, trial.planned)->kind;
    const auto [known, fresh] = peak.emplace(kind, trial.peakForce);
    EXPECT_EQ(known->second, trial.peakForce) << "the scripted hand makes the same force in all trials of a kind: " << kind;
  }
  // The thick object is moved by more force: m a and 8 N s/m times up to 0.5 m/s more.
  EXPECT_GT(peak["thick"], peak["thin"] + 2);
  EXPECT_NE(peak["soft"], peak["thin"]);
  for (std::size_t cycle = 0; cycle < 2; ++cycle) {
    const auto begin = kinds.begin() + static_cast<std::ptrdiff_t>(6 * cycle);
    EXPECT_EQ(std::count(begin, begin + 6, "thin"), 3);
    EXPECT_EQ(std::count(begin, begin + 6, "thick"), 2);
  }
}

TEST_F(Kinds, AReplayChangesScenesAsTheRunDidAndGivesEveryBit) {
  ASSERT_TRUE(record());
  const record::RunLog log = logs().at(0);
  const record::Replay replay = record::replayRun(log);
  EXPECT_GT(replay.rows, 200u);
  EXPECT_TRUE(replay.identical()) << replay.firstDifference;
  record::RunConfiguration other = log.configuration();
  std::swap(other.scenes->at(0).experimentText, other.scenes->at(1).experimentText);
  const std::string path = folder_ / "other_log.reach";
  record::copyLogAs(log.path(), path, record::toJson(other));
  EXPECT_GT(record::replayRun(record::RunLog::open(path)).rowsThatDiffer, 100u) << "scenes in another order";
}

TEST_F(Kinds, AResumedBlockGoesOnInTheOrderThatItHad) {
  ASSERT_TRUE(record());
  const std::vector<std::string> whole = kindsOf(logs().at(0));
  std::filesystem::remove_all(request_.place.data);
  EXPECT_FALSE(record(5));
  request_.resume = true;
  EXPECT_FALSE(record(3));
  ASSERT_TRUE(record());
  std::vector<std::string> parts;
  for (const record::RunLog& log : logs())
    for (const std::string& kind : kindsOf(log)) parts.push_back(kind);
  EXPECT_EQ(parts, whole);
  EXPECT_EQ(logs().size(), 3u);
}

TEST_F(Kinds, ALogThatBrokeOffIsRecoveredWithItsScenesAndResumed) {
  ASSERT_TRUE(record());
  const std::vector<std::string> whole = kindsOf(logs().at(0));
  const std::string path = logs().at(0).path();
  std::filesystem::resize_file(path, std::filesystem::file_size(path) * 2 / 3);
  const record::Recovery recovered = record::recoverLog(path);
  EXPECT_TRUE(recovered.mended);
  const record::RunLog log = record::RunLog::open(path);
  ASSERT_FALSE(log.trials().empty());
  const std::vector<std::string> kept = kindsOf(log);
  EXPECT_TRUE(std::equal(kept.begin(), kept.end(), whole.begin()));
  EXPECT_EQ(record::replayRun(log).rowsThatDiffer, 0u);
  request_.resume = true;
  ASSERT_TRUE(record());
  const std::vector<std::string> rest = kindsOf(logs().at(1));
  EXPECT_EQ(rest, std::vector<std::string>(whole.end() - static_cast<std::ptrdiff_t>(rest.size()), whole.end()));
}

TEST_F(Kinds, AConfigurationOfScenesThatAreNotThereIsRefused) {
  ASSERT_TRUE(record());
  record::RunConfiguration c = logs().at(0).configuration();
  EXPECT_NO_THROW(record::configurationFromJson(record::toJson(c), "a.log"));
  c.trials[3].scene = 3;
  EXPECT_THROW(record::configurationFromJson(record::toJson(c), "a.log"), FaultError);
  c.trials[3].scene = 0;
  c.scenes->clear();
  EXPECT_THROW(record::configurationFromJson(record::toJson(c), "a.log"), FaultError);
}

TEST_F(Kinds, EveryTableNamesKindTargetAndCondition) {
  ASSERT_TRUE(record());
  const std::vector<record::RunLog> runs = logs();
  const std::vector<std::string> kinds = kindsOf(runs[0]);
  const TsvTable events = parseTsv(record::textOf(record::eventsTsv, runs[0]));
  const record::ColumnTable trials = record::trialTable(runs[0]);  // as every export has them
  const auto ofTrials = [&](const std::string& name) {
    return std::find_if(trials.columns().begin(), trials.columns().end(), [&](const auto& c) { return c.name == name; })->texts;
  };
  for (const char* name : {"kind", "condition"}) {
    EXPECT_EQ(ofTrials(name), kinds) << name;
    const auto column = std::find(events.columns.begin(), events.columns.end(), name) - events.columns.begin();
    ASSERT_EQ(events.rows.size(), kinds.size());
    for (std::size_t i = 0; i < kinds.size(); ++i) EXPECT_EQ(events.rows[i].at(static_cast<std::size_t>(column)), kinds[i]) << name;
  }
  EXPECT_EQ(ofTrials("target"), std::vector<std::string>(12, "1"));
  EXPECT_TRUE(holds(record::eventsJson(runs[0]), "\"kind\""));
  const record::TrialIndex index = record::openTrialIndex(request_.place.data, folder_ / "index");
  const record::TrialIndex again = record::openTrialIndex(request_.place.data, folder_ / "index");
  EXPECT_EQ(again.read, 0u);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    EXPECT_EQ(index.runs[0].conditionOf(index.runs[0].trials[i]), kinds[i]);
    EXPECT_EQ(again.runs[0].sceneOf(again.runs[0].trials[i])->kind, kinds[i]);
  }
}

}  // namespace
}  // namespace reachlab::session
