#include "analysis/report/wording.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/analysis/made_study.h"

namespace reachlab::analysis {
namespace {

using predict::Criterion;

const std::vector<std::vector<Criterion>> kNames{
    {Criterion::MinHandJerk}, {Criterion::MinHandForce, Criterion::MinComAcceleration}, {Criterion::MinCrackle}, {}};

void expectIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in: " << text;
}
void expectNotIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_EQ(text.find(part), std::string::npos) << part << "\nis in: " << text;
}

Conclusion decided() {
  Conclusion c;
  c.best = c.follows = 1;
  c.rival = 0;
  c.subjects = 6, c.trials = 123;
  c.overSubjects = true;
  c.p = 0.0123, c.level = 0.05;
  c.r2 = 0.9514, c.ceiling = 0.9876;
  c.against.resize(4);
  return c;
}

TEST(Wording, OfNumbersHasThreeDigitsAndARealMinus) {
  EXPECT_EQ(shortNumber(1234.5), "1.23e+03");
  EXPECT_EQ(shortNumber(-0.12345), "−0.123");
  EXPECT_EQ(shortNumber(0), "0");
  EXPECT_EQ(shortNumber(INFINITY), "–");
  EXPECT_EQ(shortNumber(std::nan("")), "–");
  EXPECT_EQ(pText(0.01234), "p = 0.012");
  EXPECT_EQ(pText(1e-4), "p = 0.0001");
  EXPECT_EQ(pText(0.99e-4), "p < 0.0001");
}

TEST(Wording, OfACandidateNamesAllThatPredictTheSame) {
  EXPECT_EQ(describeCandidate(kNames[0]), "(1) min-hand-jerk");
  EXPECT_EQ(describeCandidate(kNames[1]), "(4) min-hand-force and (6) min-com-acceleration, which predict the same");
  EXPECT_EQ(describeCandidate({Criterion::MinHandJerk, Criterion::MinCrackle, Criterion::MinHandForce}),
            "(1) min-hand-jerk, (3) min-crackle and (4) min-hand-force, which predict the same");
  EXPECT_EQ(describeCandidate({}), "a minimum jerk that ignores the object");
  const StudyResult study = madeStudy();
  EXPECT_EQ(candidatesOf(study.results[0]), (std::vector<std::vector<Criterion>>{kNames[0], kNames[1], {}}));
}

TEST(Wording, OfAConclusionSaysWhomItIsAbout) {
  Conclusion c = decided();
  EXPECT_EQ(describeConclusion(c, kNames),
            "The movements of these 6 subjects (123 trials) follow (4) min-hand-force and (6) min-com-acceleration, which predict the same "
            "most closely among the candidates: it is nearer than every other, and than a minimum jerk that ignores the object.");
  c.overSubjects = false;
  c.trials = 1;
  expectIn(describeConclusion(c, kNames),
           {"This person's movements in these 1 trial follow", "; nothing follows about other people from one subject."});
}

TEST(Wording, OfNoConclusionSaysWhy) {
  Conclusion c = decided();
  c.follows.reset();
  c.reason = Obstacle::TooFewSubjects;
  c.subjects = 3;
  c.each = {0u, std::nullopt, 0u};
  EXPECT_EQ(describeConclusion(c, kNames),
            "Nothing can be concluded about people in general: 3 subjects are too few, 5 are needed. Each judged alone: 2 for (1) "
            "min-hand-jerk and 1 undecided.");
  c.reason = Obstacle::SubjectsDiffer;
  c.each = {2u, 0u};
  EXPECT_EQ(
      describeConclusion(c, kNames),
      "Nothing can be concluded: people differ. Closest over all is (4) min-hand-force and (6) min-com-acceleration, which predict the "
      "same; each judged alone: 1 for (1) min-hand-jerk and 1 for (3) min-crackle.");
  c.reason = Obstacle::Poor;
  c.best = 0;
  EXPECT_EQ(
      describeConclusion(c, kNames),
      "Nothing can be concluded: (1) min-hand-jerk is the closest of these, but describes the movements badly (R² 0.951; people's own "
      "means reach 0.988).");
  c.reason = Obstacle::NothingToCompare;
  expectIn(describeConclusion(c, kNames), {"Nothing can be concluded: fewer than two candidates"});
  c.reason = Obstacle::None;
  EXPECT_EQ(describeConclusion(c, kNames), "");
}

TEST(Wording, OfTheReferenceSaysHowNearItIs) {
  Conclusion c = decided();
  c.follows.reset();
  c.best = 0;
  c.reason = Obstacle::Reference;
  c.referenceP = 0.25;
  EXPECT_EQ(
      describeConclusion(c, kNames),
      "Nothing can be concluded: a minimum jerk that ignores the object describes the movements as well as the closest candidate, (1) "
      "min-hand-jerk (p = 0.25).");
  c.referenceP = 0.05;
  expectIn(describeConclusion(c, kNames), {"(p = 0.05)"});
  c.referenceP = 0.049;
  expectIn(describeConclusion(c, kNames), {"(their squared errors differ by less than 10 %)"});
  c.referenceFirst = true;
  EXPECT_EQ(describeConclusion(c, kNames),
            "Nothing can be concluded: a minimum jerk that ignores the object describes the movements better than every candidate.");
}

TEST(Wording, OfEvidenceNamesRivalTestsAndWhatIsExplained) {
  Conclusion c = decided();
  EXPECT_EQ(describeEvidence(c, kNames),
            "Closest: (4) min-hand-force and (6) min-com-acceleration, which predict the same (6 subjects, 123 trials). Nearest rival: (1) "
            "min-hand-jerk, p = 0.012 (paired t over subjects). R² 0.951; the mean of a person's other trials reaches 0.988.");
  c.signFlipP = 0.03125;
  c.posterior = {0.1, 0.875, 0.02, 0.005};
  expectIn(describeEvidence(c, kNames),
           {" The same by exchange of signs: p = 0.031.", "most frequent among people: 0.88 (protected exceedance; 0.85 is asked for)"});
  c.overSubjects = false;
  expectIn(describeEvidence(c, kNames), {"(t over this person's trials, their serial correlation allowed for)"});
  c.rival.reset();
  EXPECT_EQ(describeEvidence(c, kNames), "");
  EXPECT_EQ(describeEvidence({}, kNames), "");
}

TEST(Wording, OfConditionsTogetherSaysWhichAreLeftOut) {
  StudyResult study = madeStudy();
  EXPECT_EQ(describeTogether(study), "Over slow pace. Left out: quick, where not every subject has 10 successful trials.");
  study.together = {0, 1};
  EXPECT_EQ(describeTogether(study), "Over slow pace and quick.");
  study.together.clear();
  EXPECT_EQ(describeTogether(study), "");
  study.together = {0};
  study.conditions.pop_back();
  EXPECT_EQ(describeTogether(study), "") << "one condition alone";
}

TEST(Wording, OfChoicesCountsMassesAndTimeLaws) {
  StudyResult study = madeStudy();
  EXPECT_EQ(describeChoices(study, {0, 1}, kNames[0]),
            "Hand masses tried for (4) to (6): 0 and 1.5 kg. Chosen for the closest: one plan run faster or slower (1).");
  study.people.push_back(study.people[0]);
  study.people.back().fit.candidates[1].choice = {TimeLaw::OnePlan, 1.3, 0};
  EXPECT_EQ(
      describeChoices(study, {0}, kNames[1]),
      "Hand masses tried for (4) to (6): 0 and 1.5 kg. Chosen for the closest: one plan run faster or slower (1) and planned anew for "
      "each duration (1). Its hand mass: 0 kg (1) and 1.5 kg (1).");
  EXPECT_EQ(describeChoices(study, {1}, kNames[1]), "") << "nobody was fitted there";
  study.results[0].candidates.massGiven = true;
  study.results[0].candidates.masses = {0.8};
  expectIn(describeChoices(study, {0}, kNames[0]), {"The hand's mass was given, 0.8 kg."});
}

TEST(Wording, OfMethodsHasEveryOptionThatChangesNumbers) {
  StudyResult study = madeStudy();
  const std::string usual = describeMethods(study);
  expectIn(usual, {"Butterworth, second order, 10 Hz in each pass", "crosses 5 % of the trial's own peak",
                   "0, 0.5, 1 and 2 kg were tried for criteria (4) to (6)", "p < 0.01 against every other",
                   "their scores are 0.1 or more above", "from 5 on if p < 0.05 against every other", "is at least 0.85",
                   "Fewer than 10 successful trials", "against the prediction for the task's duration"});
  expectNotIn(usual, {"Damping of the hand"});
  study.options.measure.cutoff = 0;
  study.options.measure.onset.rule = OnsetRule::Absolute;
  study.options.measure.onset.speed = 0.025;
  study.options.handMass = 0.75;
  study.options.handDamping = 2.5;
  study.options.predictFor = PredictionDuration::Moved;
  expectIn(describeMethods(study), {"was differentiated without a filter", "crosses 0.025 m/s", "The mass of the hand was given, 0.75 kg.",
                                    " Damping of the hand: 2.5 N s/m.", "against the prediction for the duration that was moved"});
  study.options.measure.onset.rule = OnsetRule::Task;
  expectIn(describeMethods(study), {"by the task's own window"});
  expectIn(describeLimits(study), {"closest among the candidates is not proved"});
}

TEST(Wording, OfCountsSaysWhatCountedAndWhatDidNot) {
  ConditionResult r;
  r.counts.success = 3, r.counts.failure = 1;
  r.used = 3;
  r.movementTime.mean = 1.344;
  r.movementRange = {1.206, 1.512};
  EXPECT_EQ(describeCounts(r),
            "3 of 4 trials succeeded (75 %). 3 trials in profiles and errors. Movement time 1.34 s (least 1.21, largest 1.51).");
  r.counts.aborted = 2, r.counts.interrupted = 5, r.counts.invalidTiming = 3, r.counts.practice = 1, r.counts.catchTrials = 4;
  r.counts.beforeGo = 1, r.counts.otherWay = 2;
  r.reasons = {{"position", 1}, {"timing", 3}};
  EXPECT_EQ(
      describeCounts(r),
      "3 of 4 trials succeeded (75 %); besides 2 aborted, 2 interrupted, 3 with invalid timing (more ticks missed than allowed), left "
      "out, 1 practice trial and 4 catch trials. Reasons: 1 × position and 3 × timing. 3 trials in profiles and errors. Movement time "
      "1.34 s (least 1.21, largest 1.51). In 1 trial the hand left before the go signal: no reaction time is given for them. 2 trials "
      "went round the closed curve the other way; velocity is counted along the way that the hand went.");
  r = {};
  EXPECT_EQ(describeCounts(r), "0 of 0 trials succeeded. 0 trials in profiles and errors.");
  r.counts.failure = r.used = 1;
  r.counts.interrupted = 1;
  r.onlyFailures = true;
  expectIn(describeCounts(r), {"0 of 1 trial succeeded (0 %); besides 1 interrupted.", "1 failed trial in profiles"});
  r.counts.invalidTiming = 1;
  expectNotIn(describeCounts(r), {"interrupted"});
}

TEST(Wording, OfEffectsGivesIntervalsForTwoPeopleOrMore) {
  const StudyResult study = madeStudy();
  EXPECT_EQ(describeEffect(study, study.effects[0]),
            "quick, D2 − D1: +21 percentage points [5, 37], odds ratio 2.5 [1.25, 5], p = 0.012 (2 subjects).");
  EXPECT_EQ(describeEffect(study, study.effects[1]), "quick − slow pace: −12.5 percentage points (one subject: no interval).");
  EXPECT_EQ(describeSlope(study, study.slopes[0]), "quick: +7.5 percentage points in 100 trials [−2.5, 17.5], p = 0.2 (2 subjects).");
  EXPECT_EQ(describeSlope(study, study.slopes[1]), "slow pace: −3 percentage points in 100 trials (one subject: no interval).");
  Effect none = study.effects[1];
  none.points.mean = 0;
  expectIn(describeEffect(study, none), {": +0 percentage"});
  LearningSlope flat = study.slopes[1];
  flat.perHundred = 0;
  expectIn(describeSlope(study, flat), {": +0 percentage"});
}

}  // namespace
}  // namespace reachlab::analysis
