#include "sim/record/log/atomic_file.h"
#include "sim/record/log/folder_hold.h"
#include "sim/session/session.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <csignal>
#include <memory>
#include <thread>

#include "base/fault.h"
#include "base/json/json_tree.h"
#include "base/text_file.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/session/planned_trials.h"
#include "tests/record/configuration_keys.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::session {
namespace {

SessionToRun planSession(const SessionRequest& request) { return session::planSession(request, readProgramme(request.what)); }

std::vector<int> indicesOf(const BlockToRun& block) {
  std::vector<int> indices;
  for (const trial::PlannedTrial& planned : block.trials) indices.push_back(planned.index);
  return indices;
}

record::RunConfiguration configurationOf(const BlockToRun& block) {
  record::RunConfiguration configuration = block.configuration;
  configuration.table = record::makeChannelTable(block.experiment.experiment(), 1);
  return configuration;
}

// Goes on with the block's trials to the tick before `end`; `edit` may change a state.
template <typename Edit>
void recordTrials(record::MadeRecording& recording, const BlockToRun& block, std::uint64_t end, const Edit& edit) {
  constexpr std::uint64_t kTicks = record::MadeRun::kTicksPerTrial;
  for (std::uint64_t trial = 0; trial * kTicks < end; ++trial) {
    if (trial < block.trials.size()) recording.recorder.announce(static_cast<std::int32_t>(trial) + 1, block.trials[trial]);
    recording.until(std::min((trial + 1) * kTicks, end), edit);
  }
}

// Records the block's trials with these outcomes, and closes the log; what did not succeed was for `reason`.
void recordOutcomes(const BlockToRun& block, const std::vector<trial::Outcome>& outcomes,
                    trial::Reason reason = trial::Reason::Experimenter) {
  record::MadeRecording recording(block.logPath, configurationOf(block));
  recordTrials(recording, block, record::MadeRun::kTicksPerTrial * outcomes.size(), [&](haptics::TickState& state) {
    if (state.phase != trial::Phase::Done) return true;
    state.result = {};
    state.result.outcome = outcomes[static_cast<std::size_t>(state.trial - 1)];
    state.result.reason = state.result.outcome == trial::Outcome::Success ? trial::Reason::None : reason;
    return true;
  });
  recording.recorder.close();
}

// Does the first `count` trials of the block and half of one more, and breaks off without closing, as a killed program does.
void recordAndBreakOff(const BlockToRun& block, std::uint64_t count) {
  const std::string whole = block.logPath + ".whole";
  {
    record::MadeRecording recording(whole, configurationOf(block));
    recordTrials(recording, block, record::MadeRun::kTicksPerTrial * (2 * count + 1) / 2, [](const auto&) { return true; });
    recording.recorder.note("");
    std::filesystem::copy_file(whole, block.logPath);
  }
  std::filesystem::remove(whole);
}

// A plan of so many trials a block, with further keys of the plan; blocks as "experiment", "experiment".
std::string planOf(int trials, const std::vector<std::string>& experiments, const std::string& keys = {}) {
  std::string blocks;
  for (const std::string& name : experiments) blocks += (blocks.empty() ? "" : ", ") + (R"({ "experiment": ")" + name + R"(" })");
  return R"({ "schema_version": 1, "trials": )" + std::to_string(trials) + keys + R"(, "blocks": [ )" + blocks + " ] }";
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
    record::writeFileAtomically(folder_ / name, text);
    return folder_ / name;
  }
  TemporaryFolder folder_;
};

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
  EXPECT_FALSE(session.notice.seedDrawn);
  r.seed.reset();
  const SessionToRun drawn = planSession(r);
  EXPECT_TRUE(drawn.notice.seedDrawn);
  EXPECT_NE(drawn.seed, planSession(r).seed);
  r.participant.age = 131;
  EXPECT_THROW(planSession(r), FaultError) << "the record could not hold it";
}

TEST_F(PlannedSession, GoesOnWithTheTrialThatWasBrokenOffAndWithTheSameOrder) {
  SessionRequest r = request(write("p.json", planOf(6, {"chain-slow", "chain-fast"}, R"(, "order_seed": 3,
      "counterbalance": "permute", "foreperiod_s": [0.1, 0.9], "catch_share": 0.34)")));
  r.place.subject = "02";
  const SessionToRun first = planSession(r);
  ASSERT_EQ(first.blocks.size(), 2u);
  recordAndBreakOff(first.blocks[0], 2);

  r.resume = true;
  const SessionToRun second = planSession(r);
  ASSERT_EQ(second.blocks.size(), 2u);
  EXPECT_EQ(second.seed, first.seed);
  EXPECT_FALSE(second.notice.seedDrawn);
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

// A session that was done once before with the same labels is another one: its blocks are not taken for those of the one that broke off.
TEST_F(PlannedSession, ThatBrokeOffDoesItsOwnBlocksWhateverWasRecordedBefore) {
  SessionRequest r = request(write("p.json", planOf(2, {"chain-slow", "chain-moderate", "chain-fast"})));
  r.seed = 1;
  for (const BlockToRun& block : planSession(r).blocks) recordOutcomes(block, {trial::Outcome::Success, trial::Outcome::Success});
  r.seed = 2;
  recordAndBreakOff(planSession(r).blocks[0], 1);
  r.seed.reset();
  r.resume = true;
  const SessionToRun resumed = planSession(r);
  ASSERT_EQ(resumed.blocks.size(), 3u);
  EXPECT_EQ(resumed.seed, 2u);
  EXPECT_EQ(indicesOf(resumed.blocks[0]), std::vector<int>{1});
  EXPECT_EQ(indicesOf(resumed.blocks[2]), (std::vector<int>{0, 1}));
}

// Whichever number a run that goes on was given, and whether the first one can be read or not.
TEST_F(PlannedSession, CountsEveryRunOfABlockWhateverItsNumber) {
  SessionRequest r = request("chain-slow");
  r.trials = 6;
  r.run = 5;
  recordAndBreakOff(planSession(r).blocks[0], 2);
  r.resume = true;
  r.run = 8;
  recordAndBreakOff(planSession(r).blocks[0], 2);
  r.run.reset();
  EXPECT_EQ(indicesOf(planSession(r).blocks[0]), (std::vector<int>{4, 5}));
  write("data/sourcedata/sub-01_ses-01_task-chainslow_run-05_log.reach", "damaged");
  EXPECT_EQ(indicesOf(planSession(r).blocks[0]), (std::vector<int>{0, 1, 4, 5})) << "what the damaged run had is done again, and no more";
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
  EXPECT_THROW(planSession(r), FaultError);
  r.trials = 5;
  r.seed = 2;
  EXPECT_THROW(planSession(r), FaultError);
}

TEST_F(PlannedSession, RefusesATakenRunNumberAndProposesAFreeOne) {
  SessionRequest r = request("chain-moderate");
  r.trials = 3;
  recordAndBreakOff(planSession(r).blocks[0], 1);
  EXPECT_EQ(planSession(r).blocks[0].configuration.run, 2) << "the next free number is taken";
  EXPECT_TRUE(planSession(r).notice.unfinished) << "an unfinished run is worth a word";
  r.run = 1;
  const Fault fault = faultsToldBy([&] { planSession(r); }).at(0);
  EXPECT_EQ(fault.key, "run");
  EXPECT_EQ(fault.allowed, "2, the next free one, or none");
  r.what = "chain-fast";  // another task of the same session has the same run numbers
  EXPECT_THROW(planSession(r), FaultError);
  r.run = 7;
  recordAndBreakOff(planSession(r).blocks[0], 1);
  r.run = 3;  // resuming takes their order for that in time
  EXPECT_EQ(faultsToldBy([&] { planSession(r); }).at(0).allowed, "8 or more, or none");
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
  EXPECT_THROW(planSession(r), FaultError);
  r.place.session = "evening";
  EXPECT_THROW(planSession(r), FaultError);
  r.day = 1;
  r.seed = 1;
  for (const BlockToRun& block : planSession(r).blocks) recordOutcomes(block, {trial::Outcome::Success});
  r.seed.reset();
  r.day = 2;
  r.resume = true;
  const SessionToRun second = planSession(r);
  ASSERT_EQ(second.blocks.size(), 3u) << "one label for two days: each day is its own";
  EXPECT_TRUE(second.notice.nothingToResume);
  for (const BlockToRun& block : second.blocks) EXPECT_EQ(block.trials.size(), block.configuration.trials.size());
  r.resume = false;
  EXPECT_FALSE(planSession(r).notice.again);
  r.day = 1;
  EXPECT_TRUE(planSession(r).notice.unfinished);
}

TEST_F(PlannedSession, OfAPlanWithoutDaysMayHaveAnyName) {
  SessionRequest r = request(write("p.json", planOf(2, {"chain-slow", "chain-fast"})));
  for (const char* label : {"evening", "07"}) {
    r.place.session = label;
    const SessionToRun session = planSession(r);
    ASSERT_EQ(session.blocks.size(), 2u) << label;
    for (const BlockToRun& block : session.blocks) EXPECT_EQ(block.configuration.day, 0) << label;
  }
  r.day = 2;
  EXPECT_TRUE(holds(refusalOf([&] { planSession(r); }), "day: is 2, and the plan p has no days")) << "and is not ignored";
}

TEST_F(PlannedSession, GivesItsBlocksRunNumbersInTurn) {
  SessionRequest r = request(write("p.json", planOf(2, {"chain-slow", "chain-fast", "chain-slow"})));
  const auto runs = [](const SessionToRun& session) {
    std::vector<std::array<int, 3>> numbers;
    for (const BlockToRun& block : session.blocks)
      numbers.push_back({block.configuration.block, block.configuration.run, block.configuration.firstRun});
    return numbers;
  };
  const SessionToRun first = planSession(r);
  EXPECT_EQ(runs(first), (std::vector<std::array<int, 3>>{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));
  for (const BlockToRun& block : first.blocks)
    EXPECT_TRUE(holds(block.logPath, "_run-0" + std::to_string(block.configuration.run) + "_log"));
  for (const BlockToRun& block : first.blocks) EXPECT_EQ(block.configuration.seed, blockSeed(first.seed, block.configuration.block));

  EXPECT_FALSE(first.notice.again || first.notice.nothingToResume);
  r.resume = true;
  EXPECT_TRUE(planSession(r).notice.nothingToResume);
  recordOutcomes(first.blocks[0], {trial::Outcome::Success, trial::Outcome::Failure});
  recordAndBreakOff(first.blocks[1], 1);
  const SessionToRun second = planSession(r);
  EXPECT_FALSE(second.notice.again || second.notice.nothingToResume);
  EXPECT_EQ(runs(second), (std::vector<std::array<int, 3>>{{2, 3, 2}, {3, 4, 4}})) << "the block that is done is left out";
  r.resume = false;
  r.run = 7;
  EXPECT_TRUE(planSession(r).notice.again) << "the first block is recorded a second time";
  EXPECT_EQ(runs(planSession(r)), (std::vector<std::array<int, 3>>{{1, 7, 7}, {2, 8, 8}, {3, 9, 9}}));
}

TEST_F(PlannedSession, ResumesTheRunOfItsOwnExperimentAlone) {
  SessionRequest slow = request("chain-slow"), fast = request("chain-fast");
  slow.trials = fast.trials = 4;
  slow.seed = 5;
  recordAndBreakOff(planSession(slow).blocks[0], 2);
  slow.resume = fast.resume = true;
  slow.seed.reset();
  fast.seed = 6;
  fast.device = "another";
  const SessionToRun other = planSession(fast);
  EXPECT_TRUE(other.notice.nothingToResume);
  EXPECT_EQ(other.notice.deviceBefore, "") << "no trial of another experiment is gone on with";
  ASSERT_EQ(other.blocks.size(), 1u);
  EXPECT_EQ(other.seed, 6u);
  EXPECT_EQ(indicesOf(other.blocks[0]), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(other.blocks[0].configuration.experimentName, "chain-fast");
  EXPECT_EQ(other.blocks[0].configuration.firstRun, other.blocks[0].configuration.run);
  recordAndBreakOff(other.blocks[0], 3);
  const SessionToRun own = planSession(slow);  // though a later run is another's
  EXPECT_EQ(own.seed, 5u);
  EXPECT_EQ(indicesOf(own.blocks[0]), (std::vector<int>{2, 3}));
  EXPECT_EQ(own.blocks[0].configuration.firstRun, 1);

  // The same experiment as a block of a plan is that plan's.
  SessionRequest planned = request(write("p.json", planOf(4, {"chain-slow"})));
  planned.resume = true;
  EXPECT_EQ(planSession(planned).blocks[0].trials.size(), 4u);
  recordAndBreakOff(planSession(planned).blocks[0], 1);
  EXPECT_EQ(indicesOf(planSession(slow).blocks[0]), (std::vector<int>{2, 3}));
}

// The rest would be recorded under the text of the old file.
TEST_F(PlannedSession, RefusesToResumeWhatWasChangedSince) {
  const std::string experiment = readTextFile(experiment::resourceFolder() + "/experiments/chain-slow.json");
  const struct { const char *what, *changed; } cases[] = {{"p.json", "p.json"}, {"p.json", "mine.json"}, {"mine.json", "mine.json"}};
  for (const auto& [what, changed] : cases) {
    SCOPED_TRACE(std::string(what) + ", of which " + changed + " was changed");
    std::filesystem::remove_all(folder_ / "data");
    write("mine.json", experiment);
    SessionRequest r = request(write("p.json", planOf(2, {"mine.json", "chain-fast", "mine.json"})));
    r.what = folder_ / what;
    if (r.what.ends_with("mine.json")) r.trials = 3;
    recordAndBreakOff(planSession(r).blocks[0], 1);
    r.resume = true;
    EXPECT_NO_THROW(planSession(r));
    write(changed, readTextFile(folder_ / changed) + "\n");
    const Fault fault = faultsToldBy([&] { planSession(r); }).at(0);
    EXPECT_EQ(fault.key, "resume") << toText(fault);
    if (what != changed) {
      EXPECT_TRUE(holds(fault.what, "mine")) << toText(fault);
    }
  }
}

TEST_F(PlannedSession, RepeatsWhatWasInterruptedAndWhatWasAbortedOnlyIfThePlanSaysSo) {
  const std::vector<trial::Outcome> outcomes{trial::Outcome::Success, trial::Outcome::Aborted, trial::Outcome::Failure,
                                             trial::Outcome::Interrupted};
  for (const bool repeat : {false, true}) {
    SessionRequest r = request(write("again.json", planOf(5, {"chain-slow"}, repeat ? R"(, "repeat_aborted": true)" : "")));
    r.place.subject = repeat ? "01" : "02";
    const SessionToRun first = planSession(r);
    EXPECT_EQ(first.blocks[0].configuration.repeatAborted, repeat);
    recordOutcomes(first.blocks[0], outcomes);
    r.resume = true;
    const SessionToRun second = planSession(r);
    EXPECT_EQ(indicesOf(second.blocks[0]), (repeat ? std::vector<int>{3, 4, 1} : std::vector<int>{3, 4})) << "repeats are last";
    EXPECT_EQ(second.blocks[0].repeats, repeat ? 1u : 0u) << "and are not repeated again";
    // One stretch goes on with the number it broke off in; single trials get numbers that were not used.
    EXPECT_EQ(second.blocks[0].configuration.firstTrial, repeat ? 5 : 4);
  }
}

TEST_F(PlannedSession, DoesTheTrialAgainInWhichTheDeviceWasLostAndTheRunEnded) {
  using enum trial::Outcome;
  for (const bool repeat : {false, true}) {
    SessionRequest r = request(write("lost.json", planOf(4, {"chain-slow"}, repeat ? R"(, "repeat_aborted": true)" : "")));
    r.place.subject = repeat ? "01" : "02";
    recordOutcomes(planSession(r).blocks[0], {Success, Interrupted}, trial::Reason::DeviceLost);
    r.resume = true;
    for (int loss = 0; loss < 3; ++loss) {  // again and again, as often as it is lost
      const SessionToRun next = planSession(r);
      ASSERT_EQ(next.blocks.size(), 1u);
      EXPECT_EQ(indicesOf(next.blocks[0]), (std::vector<int>{1, 2, 3}));
      EXPECT_EQ(next.blocks[0].configuration.firstTrial, 2) << "its own number";
      recordOutcomes(next.blocks[0], {Interrupted}, trial::Reason::DeviceLost);
    }
    // A run that went on after a loss has done that trial, unless the plan puts it up again.
    recordOutcomes(planSession(r).blocks[0], {Interrupted, Success, Success}, trial::Reason::DeviceLost);
    const SessionToRun rest = planSession(r);
    EXPECT_EQ(rest.blocks.size(), repeat ? 1u : 0u);
    if (repeat) {
      EXPECT_EQ(indicesOf(rest.blocks.at(0)), (std::vector<int>{1}));
    }
  }
}

TEST_F(PlannedSession, KeepsWhatThePlanAndTheRequestSayInTheRecord) {
  const std::string text = R"({ "schema_version": 1, "order_seed": 12, "name": "mine", "blocks": [
      { "experiment": "chain-slow", "trials": 2, "practice": true, "condition": "warm up", "day": 4, "pause_s": 1.5 },
      { "experiment": "epitrochoid", "trials": 3 } ] })";
  SessionRequest r = request(write("p.json", text));
  r.place = {folder_ / "elsewhere", "s7", "b"};
  r.day = 4;
  r.everyTick = true;
  r.participant = {31, "F", "L"};
  r.notes = "cold";
  r.device = "simulated:noise=0";
  const SessionToRun session = planSession(r);
  ASSERT_EQ(session.blocks.size(), 2u);
  using record::expectRecorded;
  expectRecorded(session.blocks[0].configuration,
                 {{"practice", true}, {"condition", "warm up"}, {"day", 4}, {"pause_s", 1.5}, {"task", "chainslow"}});
  expectRecorded(session.blocks[1].configuration,
                 {{"practice", false}, {"condition", "epitrochoid"}, {"day", 4}, {"pause_s", 0.0}, {"task", "epitrochoid"}});
  EXPECT_EQ(session.blocks[1].logPath, r.place.data + "/sourcedata/sub-s7_ses-b_task-epitrochoid_run-02_log.reach");
  for (const BlockToRun& block : session.blocks) {
    const experiment::Experiment& planned = block.experiment.experiment();
    EXPECT_NE(experiment::definitionTextOf(planned), "");
    expectRecorded(block.configuration,
                   {{"subject", "s7"},
                    {"session", "b"},
                    {"plan_text", text},
                    {"plan_name", "mine"},
                    {"order_seed", 12},
                    {"session_seed", session.seed},
                    {"experiment_name", planned.name},
                    {"experiment_text", readTextFile(experiment::resourceFolder() + "/experiments/" + planned.name + ".json")},
                    {"definition_text", experiment::definitionTextOf(planned)},
                    {"sample_every_ticks", 1},
                    {"sampling_hz", 1000},
                    {"participant", {{"age_years", 31.0}, {"sex", "F"}, {"handedness", "L"}}},
                    {"notes", "cold"},
                    {"device", "simulated:noise=0"},
                    {"first_trial", 1}});
    EXPECT_EQ(block.configuration.trials.size(), block.trials.size());
  }
  r.everyTick = false;
  expectRecorded(planSession(r).blocks[0].configuration, {{"sample_every_ticks", 10}, {"sampling_hz", 100}});
}

TEST_F(PlannedSession, RefusesTrialsForAPlanAndAsksForTheTrialsOnOfferOtherwise) {
  SessionRequest r = request(write("p.json", planOf(4, {"chain-slow"})));
  r.trials = 4;
  EXPECT_THROW(planSession(r), FaultError);
  r.what = "chain-slow";
  EXPECT_EQ(planSession(r).blocks[0].trials.size(), 4u);
  r.trials.reset();
  r.trialsOnOffer = 19;
  EXPECT_EQ(planSession(r).blocks[0].trials.size(), 19u);
}

TEST_F(PlannedSession, LeavesALogThatCannotBeReadOutAndSaysSo) {
  SessionRequest r = request("chain-slow");
  r.trials = 3;
  recordAndBreakOff(planSession(r).blocks[0], 1);
  write("data/sourcedata/sub-01_ses-01_task-chainslow_run-02_log.reach", "no log");
  r.resume = true;
  const SessionToRun session = planSession(r);
  ASSERT_EQ(session.notice.leftOut.size(), 1u);
  EXPECT_TRUE(holds(session.notice.leftOut[0], "run-02"));
  EXPECT_EQ(session.blocks[0].configuration.run, 3);
  EXPECT_EQ(indicesOf(session.blocks[0]), (std::vector<int>{1, 2}));
}

TEST_F(PlannedSession, SaysWhichOfTheParticipantsValuesTheTableHasOtherwise) {
  SessionRequest r = request("chain-slow");
  r.participant = {31, "F", "R"};
  EXPECT_TRUE(planSession(r).notice.leftOut.empty()) << "there is no table yet";
  write("data/participants.tsv", "participant_id\tage\tsex\thandedness\nsub-01\t30\tF\tn/a\nsub-02\t50\tM\tL\n");
  const std::vector<std::string> told = planSession(r).notice.leftOut;
  ASSERT_EQ(told.size(), 1u) << "the sex is the same, and the handedness was unknown";
  EXPECT_TRUE(holds(told[0], "has the age 30 for sub-01 and keeps it: 31 is"));
}

TEST_F(PlannedSession, TellsTheFaultsOfAPlansExperimentOnce) {
  write("bad.json", R"({ "schema_version": 1, "masses": 3 })");
  const auto faultsOf = [&](const std::string& blocks) {
    return faultsToldBy(
        [&] { (void)readProgramme(write("p.json", R"({ "schema_version": 1, "trials": 1, "blocks": [ )" + blocks + " ] }")); });
  };
  const std::vector<Fault> once = faultsOf(R"({ "experiment": "bad.json" })");
  EXPECT_FALSE(once.empty());
  EXPECT_EQ(faultsOf(R"({ "experiment": "bad.json" }, { "experiment": "chain-slow" }, { "experiment": "bad.json" })"), once);
}

TEST(Seed, IsAnyNumberOf64BitsAndNothingElse) {
  for (const char* text : {"0", "1", "18446744073709551615"}) EXPECT_EQ(seedFault(text), "") << text;
  for (const char* text : {"", "-1", "1x", "1.5", "18446744073709551616"}) EXPECT_NE(seedFault(text), "") << text;
}

// The dataset's JSON holds it, and many readers of JSON know doubles alone.
TEST(Seed, ThatIsDrawnIsAWholeNumberThatADoubleHolds) {
  std::set<std::uint64_t> drawn;
  for (int i = 0; i < 64; ++i) drawn.insert(drawSeed());
  EXPECT_EQ(drawn.size(), 64u);
  EXPECT_LE(*drawn.rbegin(), std::uint64_t{1} << 53);
  EXPECT_GT(*drawn.rbegin(), std::uint64_t{1} << 52) << "all 53 bits are drawn";
}

TEST(Label, KeepsEveryLetterAndDigitAndNothingElse) {
  const std::string all = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  EXPECT_EQ(labelOf(all), all);
  EXPECT_EQ(labelOf("chain-moderate_2 (ü)/[`@{:"), "chainmoderate2");
  EXPECT_EQ(labelOf("--"), "reach");
}

// A window resized, a child ended: signals come at any time, and the lock is still waited for.
TEST(SessionFolder, IsWaitedForThroughSignals) {
  const TemporaryFolder folder;
  struct sigaction heard {
  }, before{};
  heard.sa_handler = [](int) {};  // without SA_RESTART: what waits is interrupted
  sigaction(SIGUSR1, &heard, &before);
  auto hold = std::make_unique<record::FolderHold>(folder / "data/sourcedata", record::FolderHold::WithoutLocks::Refuse);
  std::atomic<bool> held{false};
  std::string refused;
  std::thread other([&] {
    try {
      const record::FolderHold second = holdDataset(folder / "data");
      held = true;
    } catch (const Error& error) {
      refused = error.what();
    }
  });
  for (int i = 0; i < 100; ++i) {
    pthread_kill(other.native_handle(), SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_FALSE(held) << "one at a time";
  hold.reset();
  other.join();
  sigaction(SIGUSR1, &before, nullptr);
  EXPECT_TRUE(held) << refused;
}

TEST(SessionFolder, FindsTheRunsOfItsOwnSessionByNumber) {
  const TemporaryFolder folder;
  const SessionPlace place{folder / "data", "1", "2"};
  EXPECT_TRUE(recordedRuns(place).empty());
  EXPECT_EQ(chooseRun(place, {}), 1);
  for (const char* name :
       {"sub-1_ses-2_task-a_run-10_log.reach", "sub-1_ses-2_task-b_run-9_log.reach", "sub-1_ses-21_task-a_run-50_log.reach",
        "sub-11_ses-2_task-a_run-60_log.reach", "sub-1_ses-2_task-a_run-70_log.reach.damaged", "sub-1_ses-2_task-a_run-8x_log.reach"})
    record::writeFileAtomically(folder / (std::string("data/sourcedata/") + name), "");
  const std::vector<RunOnDisk> runs = recordedRuns(place);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].run, 9);
  EXPECT_EQ(runs[0].task, "b");
  EXPECT_EQ(runs[0].path, logPath(place, "b", 9).replace(logPath(place, "b", 9).find("run-09"), 6, "run-9"));
  EXPECT_EQ(runs[1].run, 10);
  EXPECT_EQ(chooseRun(place, {}), 11);
  EXPECT_EQ(chooseRun(place, 13), 13);
  for (const int taken : {10, 3}) EXPECT_THROW(chooseRun(place, taken), FaultError);
}

// The logs of a dataset that was passed on may be elsewhere.
TEST(SessionFolder, TakesNoNumberOfABidsFileWithoutALog) {
  const TemporaryFolder folder;
  const SessionPlace place{folder / "data", "1", "2"};
  const std::string motion = folder / "data/sub-1/ses-2/motion/";
  for (const char* name : {"sub-1_ses-2_task-a_tracksys-haptic_run-01_motion.tsv", "sub-1_ses-2_task-a_run-02_events.tsv"})
    record::writeFileAtomically(motion + name, "");
  EXPECT_TRUE(recordedRuns(place).empty());
  EXPECT_EQ(chooseRun(place, {}), 3);
  EXPECT_TRUE(holds(refusalOf([&] { (void)chooseRun(place, 2); }), "run-02_events.tsv"));
}

}  // namespace
}  // namespace reachlab::session
