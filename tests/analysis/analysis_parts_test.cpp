#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <sstream>

#include "analysis/conclusions/candidates.h"
#include "analysis/steps.h"
#include "analysis/measures/paper_error.h"
#include "analysis/recovery.h"
#include "analysis/report/alternatives.h"
#include "analysis/tables.h"
#include "analysis/trials/experiment_difference.h"
#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "tests/analysis/made_analysis.h"
#include "tests/analysis/synthetic.h"
#include "tests/analysis/written_tables.h"
#include "tests/refusal.h"

// What a study is made of, each by itself: counts, options, differences, candidates, signals of predictions, recovery.
namespace reachlab::analysis {
namespace {

using predict::Criterion;

TEST(Counts, PutEachTrialWhereItBelongs) {
  ConditionResult r;
  const auto count = [&](trial::Outcome outcome, trial::Reason reason, const std::string& exclusion, bool practice = false,
                         bool caught = false) {
    AnalyzedTrial t;
    t.result.outcome = outcome, t.result.reason = reason, t.exclusion = exclusion, t.practice = practice, t.catchTrial = caught;
    countTrial(t, r);
  };
  count(trial::Outcome::Success, trial::Reason::None, "");
  count(trial::Outcome::Success, trial::Reason::Position, "");  // no reason of a success is counted
  count(trial::Outcome::Failure, trial::Reason::Velocity, "failure");
  count(trial::Outcome::Aborted, trial::Reason::NoOnset, "aborted");
  count(trial::Outcome::Interrupted, trial::Reason::Timing, "invalid timing");
  count(trial::Outcome::Interrupted, trial::Reason::DeviceLost, "interrupted");
  count(trial::Outcome::Aborted, trial::Reason::Timing, "aborted");  // not an interruption
  count(trial::Outcome::Success, trial::Reason::None, "practice", true);
  count(trial::Outcome::Success, trial::Reason::None, "", true);  // practice that is included
  count(trial::Outcome::Failure, trial::Reason::Velocity, "excluded: talked");
  count(trial::Outcome::Success, trial::Reason::None, "catch trial", true, true);
  AnalyzedTrial odd;
  odd.result.outcome = trial::Outcome::Success, odd.measures.beforeGo = odd.otherWay = true;
  countTrial(odd, r);
  const ConditionCounts& n = r.counts;
  EXPECT_EQ(
      (std::vector{n.success, n.failure, n.aborted, n.interrupted, n.invalidTiming, n.practice, n.catchTrials, n.beforeGo, n.otherWay}),
      (std::vector<std::size_t>{4, 1, 2, 2, 1, 2, 1, 1, 1}));
  EXPECT_EQ(r.reasons, (std::map<std::string, std::size_t>{{"velocity", 1}, {"no_onset", 1}, {"timing", 2}, {"device_lost", 1}}));
  EXPECT_EQ(r.exclusions.at("excluded: talked"), 1u);
  EXPECT_EQ(r.exclusions.at("aborted"), 2u);
  EXPECT_EQ(r.exclusions.count(""), 0u);
}

// A later day comes later, whatever its session is called: learning, slopes and effects of days would change their sign.
TEST(Order, IsThatOfDaysThenOfNumbersOfSessions) {
  const std::vector<Condition> pace{{"moderate", compiledChain(1.35)}};
  for (const auto& [first, second, planned] : {std::tuple{"9", "10", false}, {"pre", "post", true}}) {
    AnalysisInput input = simulatedTrials(pace, predict::Criterion::MinHandJerk, 0, 1, 2, 10, 3);
    for (TrialData& trial : input.trials) {
      const bool early = trial.key.day == 1;
      trial.key.session = early ? first : second;
      if (!planned) trial.key.day = 0;
      trial.result.outcome = early ? trial::Outcome::Failure : trial::Outcome::Success;
    }
    std::reverse(input.trials.begin(), input.trials.end());
    AnalysisOptions options;
    options.criteria = {predict::Criterion::MinHandJerk};
    const Analysis analysis = analyzeTrials(std::move(input), options);
    EXPECT_EQ(analysis.trials.front().key.session, first);
    EXPECT_EQ(analysis.trials.front().key.day, 1);
    EXPECT_EQ(analysis.trials.back().key.day, 2);
    ASSERT_EQ(analysis.effects.size(), 1u);
    EXPECT_GT(analysis.effects[0].points.mean, 0) << first << " was before " << second;
  }
}

TEST(AnalysisBuilder, TakesBackTheTrialsOfARunAndNoOthers) {
  AnalysisInput input = simulatedTrials({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 1, 6, 3);
  AnalysisOptions options;
  options.criteria = {predict::Criterion::MinHandJerk};
  AnalysisBuilder builder(options);
  for (std::size_t i = 0; i < 6; ++i) {
    if (i == 0 || i == 4) builder.beginRun();
    builder.add(std::move(input.trials[i]), 0);
  }
  builder.takeBackRun();
  builder.beginRun();
  builder.takeBackRun();  // a run that failed before its first trial
  EXPECT_EQ(builder.finish(input.conditions).trials.size(), 4u);
}

TEST(AnalysisOptions, AreRefusedJustOutsideTheirBounds) {
  const auto refusal = [](const std::function<void(AnalysisOptions&)>& change) -> std::string {
    AnalysisOptions options;
    change(options);
    return refusalOf([&] { AnalysisBuilder builder(options); });
  };
  using O = AnalysisOptions;
  EXPECT_EQ(refusal([](O&) {}), "");
  for (const double percent : {1e-9, 99.9}) EXPECT_EQ(refusal([&](O& o) { o.measure.onset.percent = percent; }), "");
  for (const double percent : {0.0, 100.0, std::nan("")})
    EXPECT_NE(refusal([&](O& o) { o.measure.onset.percent = percent; }).find("onset_percent: is"), std::string::npos);
  for (const double speed : {0.0, -1.0})
    EXPECT_NE(refusal([&](O& o) { o.measure.onset.speed = speed; }).find("onset_speed"), std::string::npos);
  EXPECT_EQ(refusal([](O& o) { o.measure.cutoff = 0; }), "");
  EXPECT_NE(refusal([](O& o) { o.measure.cutoff = -1e-9; }).find("cutoff"), std::string::npos);
  EXPECT_EQ(refusal([](O& o) { o.learningBin = 1; }), "");
  EXPECT_NE(refusal([](O& o) { o.learningBin = 0; }).find("learning_bin: is 0"), std::string::npos);
  EXPECT_EQ(refusal([](O& o) { o.handMass = 0; }), "");
  EXPECT_NE(refusal([](O& o) { o.handMass = -0.1; }).find("hand_mass"), std::string::npos);
  EXPECT_EQ(refusal([](O& o) { o.handMasses = {0}; }), "");
  for (const double mass : {-0.1, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_NE(refusal([&](O& o) { o.handMasses = {1, mass}; }).find("hand_masses"), std::string::npos);
}

TEST(Differences, BetweenDirectionsAreNoneInFreeSpaceAtOneDistance) {
  experiment::Experiment ahead = experiment::readExperiment("centre-out"), aside = ahead;
  const double far = ahead.task->start[2] - ahead.task->target[2];
  aside.task->target = {ahead.task->start[0] + far, ahead.task->start[1], ahead.task->start[2]};
  EXPECT_TRUE(differInDirectionOnly(ahead, aside));
  experiment::Experiment farther = aside, slower = aside, heavy = aside;
  farther.task->target[0] += 0.01;
  EXPECT_FALSE(differInDirectionOnly(ahead, farther));
  slower.task->duration *= 2;
  EXPECT_FALSE(differInDirectionOnly(ahead, slower));
  heavy.object.kind = experiment::ObjectKind::Point;
  heavy.object.masses = {1};
  heavy.object.gravity = {0, -9.81, 0};
  EXPECT_FALSE(differInDirectionOnly(heavy, heavy)) << "a weight is carried up or down";
  EXPECT_FALSE(differInDirectionOnly(chainExperiment(1), chainExperiment(1))) << "on a line";
}

TEST(Differences, NameValuesThatFitIntoASentence) {
  const experiment::Experiment e = chainExperiment(1.35);
  const auto told = [&](const std::function<void(experiment::Experiment&)>& change) {
    experiment::Experiment other = e;
    change(other);
    return differences(e, other);
  };
  EXPECT_EQ(told([](auto& o) {
              o.object.masses = {0.5, 0.5};
            }),
            std::vector<std::string>{"masses 0.5 0.5 kg"})
      << "two alike are named apart";
  EXPECT_EQ(told([](auto& o) { o.object.masses = {0.5, 0.5, 0.5}; }), std::vector<std::string>{"masses 3 x 0.5 kg"});
  EXPECT_EQ(told([](auto& o) { o.object.masses = {0.5, 0.5, 1}; }), std::vector<std::string>{"masses 0.5 0.5 1.0 kg"});
  // 40 characters are named, 41 are not.
  EXPECT_EQ(told([](auto& o) { o.object.masses = {1.25, 1.125, 1.375, 1.625, 1.875, 2.125, 2.125}; }),
            std::vector<std::string>{"masses 1.25 1.125 1.375 1.625 1.875 2.125 2.125 kg"});
  EXPECT_EQ(told([](auto& o) { o.object.masses = {1.125, 1.125, 1.375, 1.625, 1.875, 2.125, 2.125}; }),
            std::vector<std::string>{"another masses"});
  EXPECT_EQ(told([](auto& o) { o.object.gravity = {0, 0, -9.5}; }), std::vector<std::string>{"gravity 0.0 0.0 -9.5 m/s²"});
}

// The prediction begins by the rule of the trials: at 5 % of the peak, or by the task's rule where the hand has moved a millimetre.
TEST(PredictedSignal, BeginsByTheRuleOfTheTrials) {
  const auto plan = predict::predict(chainExperiment(1.35), Criterion::MinHandJerk);
  const experiment::Task task = *chainExperiment(1.35).task;
  MeasureOptions options;
  options.cutoff = 0;
  const PredictedSignal signal = recordPrediction(*plan, options, task);
  EXPECT_NEAR(std::abs(plan->handAt(signal.onset - signal.begin).velocity), 0.05 * signal.peak, 1e-4);
  options.onset.rule = OnsetRule::Task;
  const double moved = recordPrediction(*plan, options, task).onset - signal.begin;
  EXPECT_GT(std::abs(plan->handAt(moved).position), task.onset);
  EXPECT_LE(std::abs(plan->handAt(moved - 1e-3).position), task.onset);
}

// A triangle: up to 2 in 4 samples from sample 2, down in 8.
PredictedSignal triangle() {
  PredictedSignal signal;
  signal.rate = 10, signal.onset = 0.3, signal.peak = 2;
  signal.hand = {0, 0, 0, 0.5, 1, 1.5, 2, 1.75, 1.5, 1.25, 1, 0.75, 0.5, 0.25, 0, 0, 0};
  signal.object = signal.hand;
  return signal;
}

TEST(PredictedSignal, LastsUntilItsSpeedFallsToAPartOfItsPeak) {
  EXPECT_NEAR(durationUntil(triangle(), 0.25), 1.2 - 0.3, 1e-12);
  EXPECT_NEAR(durationUntil(triangle(), 0.3), 1.16 - 0.3, 1e-12) << "between two samples";
  EXPECT_NEAR(durationUntil(triangle(), 0), 1.4 - 0.3, 1e-12);
  EXPECT_NEAR(durationUntil(triangle(), -1), 1.1, 1e-12);
  EXPECT_NEAR(durationUntil(triangle(), 5), 0.6 + (2 - 0.999 * 2) / 0.25 / 10 - 0.3, 1e-9) << "0.999 of the peak at most";
  PredictedSignal cut = triangle();
  cut.hand.resize(9);
  EXPECT_NEAR(durationUntil(cut, 0.25), 0.8 - 0.3, 1e-12) << "it ends while it still moves";
  cut.onset = 5;
  EXPECT_NEAR(durationUntil(cut, 0.25), 0.1, 1e-12) << "a sample at least";
}

TEST(PaperError, IsTheRootOfTheMeanSquareAtEqualPhases) {
  // A trial twice as long with half the velocity is the prediction itself.
  const PredictedSignal signal = triangle();
  const double duration = durationUntil(signal, 0.25);
  TrialProfile trial;
  trial.endLevel = 0.25, trial.duration = 2 * duration;
  trial.hand = normaliseTime(signal.hand, signal.rate, signal.onset, signal.onset + duration);
  for (double& v : trial.hand) v /= 2;
  trial.object = trial.hand;
  for (double& v : trial.object) v += 0.05;
  const PaperError error = computePaperError(trial, signal);
  EXPECT_NEAR(error.hand, 0, 1e-12);
  EXPECT_NEAR(error.object, 0.1, 1e-12) << "in the prediction's time";
  EXPECT_TRUE(std::isnan(computePaperError(TrialProfile{}, signal).hand));
  EXPECT_TRUE(std::isnan(computePaperError(TrialProfile{}, signal).object));
}

TEST(Candidates, AreOneWhereTheyPredictTheSameAndEndWithTheReference) {
  CandidateOptions options;
  options.criteria = {Criterion::MinHandJerk, Criterion::MinHandForce, Criterion::MinComAcceleration};
  options.handMasses = {0, 1.5};
  const CandidateSet set = makeCandidates(experiment::CompiledExperiment(parallelExperiment(2.5)), options);
  ASSERT_EQ(set.candidates.size(), 3u);
  EXPECT_EQ(set.candidates[0].criteria, std::vector<Criterion>{Criterion::MinHandJerk});
  EXPECT_TRUE(set.candidates[0].masses.empty()) << "its hand's mass changes nothing";
  EXPECT_EQ(set.candidates[0].families.size(), 1u);
  EXPECT_EQ(set.candidates[1].criteria, (std::vector<Criterion>{Criterion::MinHandForce, Criterion::MinComAcceleration}));
  EXPECT_EQ(set.candidates[1].masses, (std::vector<double>{0, 1.5}));
  EXPECT_EQ(set.candidates[1].families.size(), 2u);
  EXPECT_TRUE(set.candidates[2].reference());
  EXPECT_FALSE(set.massGiven);
  EXPECT_EQ(set.masses, (std::vector<double>{0, 1.5}));
  const ProfileFamily::Grid& grid = set.candidates[0].families[0]->grid();
  EXPECT_LE(grid.spacing, 2.5 / 45);
  EXPECT_NEAR(grid.shortest, std::max(0.35 * 2.5, 5 * grid.spacing), 1e-12);
  EXPECT_GE(grid.parts, 240u);
  EXPECT_LE(grid.parts, 1600u);
  // The reference is 30 s^2 (1 - s)^2 for any duration, before the filter.
  options.cutoff = 0;
  options.handMass = 0.75;
  const CandidateSet given = makeCandidates(experiment::CompiledExperiment(parallelExperiment(2.5)), options);
  EXPECT_TRUE(given.massGiven);
  EXPECT_EQ(given.masses, std::vector<double>{0.75});
  Profile profile;
  ASSERT_TRUE(given.candidates.back().families[0]->at(1.7, profile));
  for (const double s : {0.1, 0.25, 0.5, 0.8}) EXPECT_NEAR(profile.at(s), 30 * s * s * (1 - s) * (1 - s), 1e-6) << s;
  experiment::Experiment heavy = parallelExperiment(2.5);
  heavy.handMass = 1.25;
  options.handMass.reset();
  EXPECT_EQ(makeCandidates(experiment::CompiledExperiment(heavy), options).masses, std::vector<double>{1.25}) << "the experiment's own";
}

// People planned by minimum hand jerk, with a little scatter: each truth is named by most studies of it, by any number of threads.
TEST(TruthRecovery, NamesTheTruthsAndDoesNotHangOnTheThreads) {
  AnalysisOptions options;
  options.criteria = {Criterion::MinHandJerk, Criterion::MinCrackle};
  options.keepScatter = true;
  AnalysisInput input = simulatedTrials({{"moderate", compiledChain(1.35)}}, Criterion::MinHandJerk, 0, 1, 1, 20, 3);
  input.trials.front().excluded = "sneezed";  // a first trial that is not used has no window
  const Analysis analysis = analyzeTrials(input, options);
  std::size_t told = 0;
  const TruthRecovery one = recover(analysis, 3, 7, 1, [&](std::size_t done, std::size_t of) {
    EXPECT_EQ(done, ++told);
    EXPECT_EQ(of, 27u);
  });
  EXPECT_EQ(told, 27u);
  EXPECT_EQ(one.trials, 15u) << "those that succeeded";
  EXPECT_EQ(one.studies, 3);
  EXPECT_EQ(one.seed, 7u);
  ASSERT_EQ(one.counts.size(), 3u);
  for (std::size_t t = 0; t < 3; ++t) {
    ASSERT_EQ(one.counts[t].size(), 4u);
    EXPECT_EQ(one.counts[t][0] + one.counts[t][1] + one.counts[t][2] + one.counts[t][3], 3u) << t;
  }
  EXPECT_EQ(one.counts[0][0], 3u);
  EXPECT_EQ(one.counts[1][1], 3u);
  EXPECT_EQ(one.counts[2][3], 3u) << "the reference is never named";
  EXPECT_EQ(recover(analysis, 3, 7, 3).counts, one.counts);
  const auto fail = [](std::size_t, std::size_t) { throw ResourceError("no more"); };
  EXPECT_EQ(refusalOf([&] { recover(analysis, 3, 7, 3, fail); }), "no more") << "of whichever thread";
  std::vector<std::string_view> names;
  for (const OtherTruth& other : one.others) names.push_back(other.name);
  EXPECT_EQ(names, (std::vector<std::string_view>{"own-skew", "own-warp", "mean-of-two", "two-in-turn", "hand-snap", "two-submovements"}))
      << "no candidate here has a hand's mass";
  for (const OtherTruth& other : one.others) {
    EXPECT_EQ(other.right + other.wrong + other.undecided, 3u);
    EXPECT_EQ(other.wrong, 0u) << other.name;
  }
  for (std::size_t k = 2; k < one.others.size(); ++k) EXPECT_EQ(one.others[k].right, 0u) << "no name is right for " << one.others[k].name;
  EXPECT_NE(recoveryTable(one).find("mean-of-two,undecided,3\n"), std::string::npos);
  EXPECT_EQ(recoveryTable(one).substr(0, 54), "truth,named,studies\nmin-hand-jerk,min-hand-jerk,3\nmin-");
  EXPECT_NE(recoveryTable(one).find("reference,undecided,3\n"), std::string::npos);
  for (const auto& row : recover(analysis, 1, 7, 1).counts) EXPECT_EQ(row[0] + row[1] + row[2] + row[3], 1u) << "one study is enough";
  for (const int none : {0, -1}) EXPECT_EQ(recover(analysis, none, 7, 1).counts, std::vector<std::vector<std::size_t>>(3, {0, 0, 0, 0}));
}

// One person who plans by minimum hand jerk: no other choice changes the name, unless this criterion is left out.
TEST(Alternatives, ChangeTheConclusionOnlyWhereTheTruthIsLeftOut) {
  AnalysisOptions asked;
  asked.criteria = {Criterion::MinHandJerk, Criterion::MinCrackle, Criterion::MinComAcceleration};
  const auto analyzed = [](const AnalysisOptions& options) {
    return analyzeTrials(simulatedTrials({{"moderate", compiledChain(1.35)}}, Criterion::MinHandJerk, 0, 1, 1, 20, 3), options);
  };
  Analysis analysis = analyzed(asked);
  EXPECT_EQ(describeAlternatives(analysis), "") << "they were not asked for";
  std::vector<AlternativeConclusion> rows;
  for (const Alternative& other : alternativesTo(asked))
    for (const AlternativeConclusion& row : conclusionsOf(analyzed(other.options), other.choice)) rows.push_back(row);
  addAlternatives(analysis, rows);
  EXPECT_EQ(analysis.alternatives.front().criterion(), "min-hand-jerk");
  EXPECT_GE(analysis.alternatives.size(), 10u);
  for (const AlternativeConclusion& row : analysis.alternatives)
    EXPECT_EQ(row.changed, row.choice == "without min-hand-jerk") << row.choice;
  EXPECT_NE(describeAlternatives(analysis).find(" The others are: without min-hand-jerk: "), std::string::npos);
  // Each choice has the scores of its candidates; those as asked are the conclusions'.
  std::map<std::string, std::string> files = tablesOf(analysis);
  const auto linesOf = [&](const std::string& file, const std::string& start) {
    std::vector<std::string> out;
    std::istringstream lines(files[file]);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(start)) out.push_back(line.substr(start.size()));
    return out;
  };
  const std::vector<std::string> asAsked = linesOf("alternative_scores.csv", "as asked,all,");
  EXPECT_EQ(asAsked, linesOf("conclusions.csv", "all,"));
  EXPECT_EQ(asAsked.size(), 4u);
  for (const std::string& line : asAsked)
    EXPECT_EQ(line.find(",yes,") != std::string::npos, line.find(",min-hand-jerk,") != std::string::npos) << line << ": only one is best";
  EXPECT_EQ(linesOf("alternative_scores.csv", "with failed trials,all,").size(), 4u);
  EXPECT_EQ(linesOf("alternative_scores.csv", "without min-crackle,all,").size(), 3u);
}

// What the fits try is what the options say, and each condition tells it.
TEST(AnalysisOptions, GoToTheCandidates) {
  AnalysisOptions options;
  options.criteria = {Criterion::MinHandJerk, Criterion::MinHandForce};
  options.handMasses = {0.25, 3};
  options.measure.cutoff = 8;
  const AnalysisInput input = simulatedTrials({{"m", compiledChain(1.35)}}, Criterion::MinHandJerk, 0, 1, 1, 13, 3);
  Analysis analysis = analyzeTrials(input, options);
  EXPECT_EQ(analysis.results[0].candidates.masses, (std::vector<double>{0.25, 3}));
  EXPECT_FALSE(analysis.results[0].candidates.massGiven);
  EXPECT_EQ(analysis.results[0].signals.size(), 2u);
  EXPECT_EQ(analysis.people.at(0).rest.size(), analysis.people[0].trials);
  EXPECT_GT(analysis.people[0].fit.candidates[0].r2, 0.99) << "predictions are filtered as the recording is";
  options.handMass = 0.5;
  analysis = analyzeTrials(input, options);
  EXPECT_EQ(analysis.results[0].candidates.masses, std::vector<double>{0.5});
  EXPECT_TRUE(analysis.results[0].candidates.massGiven);
}

}  // namespace
}  // namespace reachlab::analysis
