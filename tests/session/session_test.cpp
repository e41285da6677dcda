#include "sim/session/session.h"

#include <gtest/gtest.h>

#include <limits>

#include "constraints/error.h"
#include "sim/session/trial_order.h"
#include "tests/record/made_run.h"

namespace reachlab {
namespace {

std::vector<int> indicesOf(const BlockToRun& block) {
  std::vector<int> indices;
  for (const PlannedTrial& planned : block.trials) indices.push_back(planned.index);
  return indices;
}

// Does the first `count` trials of the block and half of one more, and breaks off without closing, as a killed program does.
void recordAndBreakOff(const BlockToRun& block, int count) {
  RunConfiguration configuration = block.configuration;
  configuration.table = makeChannelTable(block.experiment, 1);
  const std::string whole = block.logPath + ".whole";
  {
    Recorder recorder(whole, configuration, {.threaded = false});
    MadeRun run(configuration.table.massCount);
    for (std::uint64_t tick = 0; tick < MadeRun::kTicksPerTrial * count + MadeRun::kTicksPerTrial / 2; ++tick) {
      const std::size_t trial = tick / MadeRun::kTicksPerTrial;
      if (tick % MadeRun::kTicksPerTrial == 0 && trial < block.trials.size())
        recorder.announce(static_cast<std::int32_t>(trial) + 1, block.trials[trial]);
      recorder.onTick(run.next(), Command::None, 0);
    }
    recorder.note("");
    std::filesystem::copy_file(whole, block.logPath);
  }
  std::filesystem::remove(whole);
}

class PlannedSession : public testing::Test {
 protected:
  SessionRequest request(const std::string& what) const {
    SessionRequest r;
    r.what = what;
    r.place.data = folder_ / "data";
    r.device = "made";
    return r;
  }
  std::string write(const std::string& name, const std::string& text) const {
    writeFileAtomically(folder_ / name, text);
    return folder_ / name;
  }
  TemporaryFolder folder_{"session"};
};

TEST_F(PlannedSession, RefusesAnAgeThatTheRecordCouldNotHold) {
  SessionRequest r = request("chain-moderate");
  for (const double age : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -4.0, 131.0}) {
    r.participant.age = age;
    EXPECT_THROW(planSession(r), UsageError) << age;
  }
  r.participant.age = 24;
  EXPECT_NO_THROW(planSession(r));
}

TEST_F(PlannedSession, TakesTheNextNumberWhenAnotherProgramHasTakenItsOwn) {
  SessionRequest r = request("chain-moderate");
  BlockToRun first = planSession(r).blocks.at(0), second = first;
  takeFreeRun(first, r);
  EXPECT_EQ(first.configuration.run, 1);
  writeMadeRun(first.logPath, 1, madeConfiguration());
  takeFreeRun(second, r);
  EXPECT_EQ(second.configuration.run, 2);
  EXPECT_EQ(second.configuration.firstRun, 2);
  EXPECT_NE(second.logPath, first.logPath);
  r.run = 2;
  BlockToRun asked = planSession(r).blocks.at(0);
  writeMadeRun(second.logPath, 1, madeConfiguration());
  EXPECT_THROW(takeFreeRun(asked, r), UsageError) << "a number that was asked for is not exchanged";
}

TEST_F(PlannedSession, OfAnExperimentIsOneBlockWithItsTrialsInOrder) {
  SessionRequest r = request("chain-moderate");
  r.trials = 4;
  r.seed = 9;
  const SessionToRun session = planSession(r);
  ASSERT_EQ(session.blocks.size(), 1u);
  EXPECT_EQ(indicesOf(session.blocks[0]), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(session.blocks[0].configuration.seed, 9u);
  EXPECT_EQ(session.blocks[0].configuration.run, 1);
  EXPECT_TRUE(session.blocks[0].logPath.ends_with("sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach"))
      << session.blocks[0].logPath;
  EXPECT_FALSE(session.seedDrawn);
}

TEST_F(PlannedSession, DrawsASeedWhenNoneIsGiven) {
  const SessionToRun a = planSession(request("chain-moderate")), b = planSession(request("chain-moderate"));
  EXPECT_TRUE(a.seedDrawn);
  EXPECT_NE(a.seed, b.seed);
}

TEST_F(PlannedSession, GoesOnWithTheTrialThatWasBrokenOffAndWithTheSameOrder) {
  const std::string plan = write("p.json", R"({ "schema_version": 1, "order_seed": 3, "counterbalance": "permute", "trials": 6,
      "foreperiod_s": [0.1, 0.9], "catch_share": 0.34, "blocks": [ { "experiment": "chain-slow" }, { "experiment": "chain-fast" } ] })");
  SessionRequest r = request(plan);
  r.place.subject = "02";
  const SessionToRun first = planSession(r);
  ASSERT_EQ(first.blocks.size(), 2u);
  recordAndBreakOff(first.blocks[0], 2);

  r.resume = true;
  const SessionToRun second = planSession(r);
  ASSERT_EQ(second.blocks.size(), 2u);
  EXPECT_EQ(second.seed, first.seed);
  EXPECT_FALSE(second.seedDrawn);
  EXPECT_EQ(indicesOf(second.blocks[0]), (std::vector<int>{2, 3, 4, 5}));
  EXPECT_EQ(second.blocks[0].configuration.run, 2);
  EXPECT_EQ(second.blocks[0].configuration.firstRun, 1);
  EXPECT_EQ(second.blocks[0].configuration.firstTrial, 3) << "trial numbers go on";
  EXPECT_EQ(second.blocks[0].configuration.seed, first.blocks[0].configuration.seed);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(second.blocks[0].trials[i].foreperiodTicks, first.blocks[0].trials[i + 2].foreperiodTicks);
    EXPECT_EQ(second.blocks[0].trials[i].catchTrial, first.blocks[0].trials[i + 2].catchTrial);
  }
  EXPECT_EQ(second.blocks[1].configuration.seed, first.blocks[1].configuration.seed);

  recordAndBreakOff(second.blocks[0], 1);  // and once more
  const SessionToRun third = planSession(r);
  EXPECT_EQ(indicesOf(third.blocks[0]), (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(third.blocks[0].configuration.firstRun, 1);
  EXPECT_EQ(third.blocks[0].configuration.run, 3);
}

TEST_F(PlannedSession, ThatIsCompleteHasNothingLeftToResume) {
  SessionRequest r = request("chain-moderate");
  r.trials = 3;
  r.seed = 1;
  const SessionToRun first = planSession(r);
  recordAndBreakOff(first.blocks[0], 2);
  r.resume = true;
  recordAndBreakOff(planSession(r).blocks[0], 0);  // broke off again before it had finished a trial
  const SessionToRun third = planSession(r);
  EXPECT_EQ(indicesOf(third.blocks[0]), (std::vector<int>{2}));
  recordAndBreakOff(third.blocks[0], 1);
  EXPECT_TRUE(planSession(r).blocks.empty());
}

TEST_F(PlannedSession, RefusesToResumeWithOtherTrialsOrAnotherSeedThanRecorded) {
  SessionRequest r = request("chain-moderate");
  r.trials = 5;
  r.seed = 1;
  recordAndBreakOff(planSession(r).blocks[0], 2);
  r.resume = true;
  EXPECT_NO_THROW(planSession(r));
  r.trials = 6;
  EXPECT_THROW(planSession(r), UsageError);
  r.trials = 5;
  r.seed = 2;
  EXPECT_THROW(planSession(r), UsageError);
}

TEST_F(PlannedSession, RefusesToResumeAPlanThatWasChangedSince) {
  const std::string text = R"({ "schema_version": 1, "trials": 4, "blocks": [ { "experiment": "chain-slow" } ] })";
  SessionRequest r = request(write("p.json", text));
  recordAndBreakOff(planSession(r).blocks[0], 1);
  write("p.json", text + "\n");
  r.resume = true;
  EXPECT_THROW(planSession(r), UsageError);
}

TEST_F(PlannedSession, RefusesATakenRunNumberAndProposesAFreeOne) {
  SessionRequest r = request("chain-moderate");
  r.trials = 3;
  recordAndBreakOff(planSession(r).blocks[0], 1);
  EXPECT_EQ(planSession(r).blocks[0].configuration.run, 2) << "the next free number is taken";
  EXPECT_NE(planSession(r).hint, "") << "an unfinished run is worth a word";
  r.run = 1;
  try {
    planSession(r);
    FAIL() << "took run 1 twice";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("--run 2"), std::string::npos) << error.what();
  }
  r.what = "chain-fast";  // another task of the same session has the same run numbers
  EXPECT_THROW(planSession(r), UsageError);
}

TEST_F(PlannedSession, IsOneDayOfThePlan) {
  SessionRequest r = request("paper");
  r.place.subject = "03";
  for (const char* label : {"01", "02"}) {
    r.place.session = label;
    const SessionToRun session = planSession(r);
    ASSERT_EQ(session.blocks.size(), 3u);
    for (const BlockToRun& block : session.blocks) EXPECT_EQ(block.configuration.day, label[1] - '0');
  }
  r.place.session = "03";
  EXPECT_THROW(planSession(r), UsageError);
  r.place.session = "evening";
  EXPECT_THROW(planSession(r), UsageError);
  r.day = 2;
  EXPECT_EQ(planSession(r).blocks.size(), 3u);
}

TEST_F(PlannedSession, TakesLettersAndDigitsOnlyAsLabels) {
  SessionRequest r = request("chain-moderate");
  for (const char* label : {"", "a b", "a_b", "../x", "ü"}) {
    r.place.subject = label;
    EXPECT_THROW(planSession(r), UsageError) << label;
  }
}

}  // namespace
}  // namespace reachlab
