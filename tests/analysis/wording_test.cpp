#include "analysis/report/wording.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/analysis/made_analysis.h"
#include "tests/text_parts.h"

namespace reachlab::analysis {
namespace {

using predict::Criterion;

const std::vector<std::vector<Criterion>> kNames{
    {Criterion::MinHandJerk}, {Criterion::MinHandForce, Criterion::MinComAcceleration}, {Criterion::MinCrackle}, {}};

Conclusion decided() {
  Conclusion c;
  c.best = c.follows = 1;
  c.rival = 0;
  c.subjects = 6, c.trials = 123;
  c.overSubjects = true;
  c.p = 0.0123, c.level = 0.05;
  c.r2 = 0.9514, c.ceiling = 0.9876;
  c.against.resize(4);
  c.closest = {1, 5, 0, 0};
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

/// Without the candidates behind it.
std::string told(const Conclusion& c) {
  const std::string text = describeConclusion(c, kNames);
  return text.substr(0, text.find(" Compared were "));
}

TEST(Wording, OfAConclusionSaysWhomItIsAbout) {
  Conclusion c = decided();
  EXPECT_EQ(
      told(c),
      "The movements of these 6 subjects (123 trials) follow (4) min-hand-force (the same prediction as (6) "
      "min-com-acceleration) most closely among the candidates: it is nearer than every other, and than a minimum jerk that ignores the object.");
  c.overSubjects = false;
  c.subject = "07";
  c.trials = 1;
  c.leftOut = 2;
  expectIn(told(c), {"The movements of subject 07 (1 trial) follow", "; nothing follows about other people from one subject.",
                     "2 subjects with fewer than 10 successful trials are left out."});
}

TEST(Wording, OfNoConclusionSaysWhy) {
  Conclusion c = decided();
  c.follows.reset();
  c.reason = Obstacle::TooFewSubjects;
  c.subjects = 3;
  c.each = {0u, std::nullopt, 0u};
  EXPECT_EQ(told(c),
            "Nothing can be concluded about people in general: 3 subjects are too few, 5 are needed. Each judged alone: 2 for (1) "
            "min-hand-jerk and 1 undecided.");
  c.reason = Obstacle::SubjectsDiffer;
  c.each = {2u, 0u};
  EXPECT_EQ(told(c),
            "Nothing can be concluded: people differ. Closest over all is (4) min-hand-force (the same prediction as (6) "
            "min-com-acceleration); each judged alone: 1 for (1) min-hand-jerk and 1 for (3) min-crackle.");
  c.reason = Obstacle::Poor;
  c.best = 0;
  c.misfit.mean = 0.5, c.misfit.p = 0.0021;
  c.systematic = {0.25, 1e-4, 0};
  EXPECT_EQ(
      told(c),
      "Nothing can be concluded: (1) min-hand-jerk is the closest of these, but does not fit. 25 % of what it leaves is the same in "
      "every trial or grows with the duration (p < 0.0001). Its squared errors are 65 % above those of the person's other trials (p = 0.0021), and "
      "it leaves 3.92 times the squares that their mean leaves.");
  c.reason = Obstacle::MassAtEdge;
  c.atEdge = {2};
  expectIn(told(c), {"(1) min-hand-jerk is the closest candidate, but the hand's mass of (3) min-crackle", "at the edge of the range",
                     "Widen the range of masses"});
  c.reason = Obstacle::NothingToCompare;
  expectIn(told(c), {"Nothing can be concluded: fewer than two candidates"});
  c.reason = Obstacle::None;
  EXPECT_EQ(told(c), "");
}

TEST(Wording, OfTheReferenceSaysHowNearItIs) {
  Conclusion c = decided();
  c.follows.reset();
  c.best = 0;
  c.reason = Obstacle::Reference;
  c.referenceP = 0.25;
  EXPECT_EQ(
      told(c),
      "Nothing can be concluded: a minimum jerk that ignores the object describes the movements as well as the closest candidate, (1) "
      "min-hand-jerk (p = 0.25).");
  c.referenceP = 0.05;
  expectIn(told(c), {"(p = 0.05)"});
  c.referenceP = 0.049;
  expectIn(told(c), {"(their squared errors differ by less than 10 %)"});
  c.referenceFirst = true;
  EXPECT_EQ(told(c),
            "Nothing can be concluded: a minimum jerk that ignores the object describes the movements better than every candidate.");
}

TEST(Wording, OfConditionsTogetherSaysWhichAreLeftOut) {
  Analysis analysis = madeStudy();
  EXPECT_EQ(describeTogether(analysis), "Over slow pace. Left out: quick, where not each of these subjects has 10 successful trials.");
  analysis.together = {0, 1};
  EXPECT_EQ(describeTogether(analysis), "Over slow pace and quick.");
  analysis.together.clear();
  EXPECT_EQ(describeTogether(analysis), "");
  analysis.together = {0};
  analysis.conditions.pop_back();
  EXPECT_EQ(describeTogether(analysis), "") << "one condition alone";
}

TEST(Wording, OfChoicesCountsMassesAndTimeLaws) {
  Analysis analysis = madeStudy();
  EXPECT_EQ(describeChoices(analysis, {0, 1}, kNames[0]),
            "The hand's mass was searched from 0 to 1.5 kg for (4) to (6). Chosen for the closest: one plan run faster or slower (1).");
  analysis.people.push_back(analysis.people[0]);
  analysis.people.back().subject = "C";
  analysis.people.back().fit.candidates[1].choice = {TimeLaw::OnePlan, 1.3, 0};
  analysis.people.back().fit.candidates[1].mass = MassFit{0.625, {0.5, 0.75}, false};
  EXPECT_EQ(
      describeChoices(analysis, {0}, kNames[1]),
      "The hand's mass was searched from 0 to 1.5 kg for (4) to (6). Chosen for the closest: one plan run faster or slower (1) and planned anew "
      "for each duration (1). Its hand mass with the 95 % interval: 1.5 kg [1.25, 1.5] (A, at the edge of the range) and 0.625 kg [0.5, 0.75] "
      "(C).");
  EXPECT_EQ(describeChoices(analysis, {1}, kNames[1]), "") << "nobody was fitted there";
  analysis.results[0].candidates.massGiven = true;
  analysis.results[0].candidates.masses = {0.8};
  expectIn(describeChoices(analysis, {0}, kNames[0]), {"The hand's mass was given, 0.8 kg."});
}

/// Six trials without a field, twelve in it with every fourth a channel, six after it. The last quarter of the training is trials 16 to 18.
Analysis madeAdaptation(const std::vector<double>& plateaus, double push) {
  Analysis analysis;
  for (std::size_t k = 0; k < plateaus.size(); ++k)
    for (int n = 1; n <= 24; ++n) {
      AnalyzedTrial t;
      t.key.subject = std::string(1, static_cast<char>('A' + k));
      t.key.session = "01";
      t.key.trial = n;
      t.scene.trained = experiment::SquareMatrix<3>{{{0, 0, 13}, {0, 0, 0}, {-13, 0, 0}}};
      const bool training = n > 6 && n <= 18;
      t.scene.channel = training && n % 4 == 1;
      t.scene.inField = training && !t.scene.channel;
      t.scene.strength = t.scene.inField;
      t.measures.maxPerpendicular = t.scene.channel ? 0 : 0.001 + (training ? push * (n > 15 ? 0.25 : 1) : n > 18 ? -push / 2 : 0);
      if (t.scene.channel) t.measures.adaptation = n > 15 ? plateaus[k] : 0;
      analysis.trials.push_back(t);
    }
  return analysis;
}

TEST(Wording, OfLearningGivesPlateauAfterEffectAndItsSide) {
  EXPECT_EQ(
      describeLearning(madeAdaptation({60}, -0.02)),
      "In a counterclockwise curl field of 13 N s/m, 1 subject learned to cancel 60 % of it (channel trials of the last quarter of the "
      "training). Without it they then deviated by 10 mm to the right, against the deviation at first (after-effect).");
  expectIn(describeLearning(madeAdaptation({60}, 0)), {"Without it they then deviated by 0 mm", "No after-effect is shown."});
  // t(0.975; 2) sd / sqrt(3) = 4.3027 * 10 / 1.7321 = 24.8.
  expectIn(describeLearning(madeAdaptation({50, 60, 70}, 0.02)),
           {"3 subjects learned to cancel 60 [35.2, 84.8] % of it", "by 10 mm to the left, against the"});
  expectIn(describeLearning(madeAdaptation({10, 60, -20}, 0.02)),
           {"3 subjects cancelled 16.7 [−83.7, 117] % of it", "It is not shown that they learned."});
  Analysis without = madeAdaptation({60}, -0.02);
  std::erase_if(without.trials, [](const AnalyzedTrial& t) { return t.scene.channel || t.key.trial > 18; });
  expectIn(
      describeLearning(without),
      {"1 subject deviated by 20 mm to the left at first and by 5 mm to the left in the last quarter of the training. No trial without it "
       "followed"});
  EXPECT_EQ(describeLearning(madeStudy()), "") << "nobody was perturbed";
}

TEST(Wording, OfLearningKeepsTrainingsApart) {
  Analysis analysis = madeAdaptation({60}, -0.02);
  const std::string alone = describeLearning(analysis);
  const std::vector<AnalyzedTrial> trained = analysis.trials;
  const auto again = [&](const auto& change) {
    for (AnalyzedTrial t : trained) {
      t.key.trial += 100;
      t.key.session = "02";
      change(t);
      analysis.trials.push_back(t);
    }
  };
  again([](AnalyzedTrial& t) {  // the opposite field, as savings are studied
    if (t.key.trial > 118) t.scene.inField = true;
    t.scene.strength = t.scene.inField ? 1 : 0;
    for (auto& row : *t.scene.trained)
      for (double& b : row) b = -b;
  });
  EXPECT_EQ(describeLearning(analysis), alone) << "one field is not the other's";
  analysis.trials = trained;
  again([](AnalyzedTrial& t) {
    t.scene.channel = t.scene.inField = false;
    t.scene.strength = 0;
    t.scene.rotation = t.key.trial > 106 ? 30 : 0;
    t.measures.handAngle = t.key.trial > 106 ? -15 : 0;
  });
  expectIn(describeLearning(analysis), {alone, "In a rotation of the cursor by 30° counterclockwise, 1 subject learned to cancel 50 %"});
  analysis.trials = trained;
  for (AnalyzedTrial& t : analysis.trials)
    if (t.key.trial > 6 && t.key.trial <= 18) t.exclusion = "practice";
  EXPECT_EQ(describeLearning(analysis), "");
}

TEST(Wording, OfMethodsHasEveryOptionThatChangesNumbers) {
  Analysis analysis = madeStudy();
  const std::string usual = describeMethods(analysis);
  expectIn(usual, {"Butterworth, second order, 10 Hz in each pass", "crosses 5 % of the trial's own peak",
                   "it was fitted from 0 to 8 kg for criteria (4) to (6)", "p < 0.01 against every other",
                   "their scores are 0.1 or more above", "from 5 on if p < 0.05 against every other", "is at least 0.85",
                   "Fewer than 10 successful trials", "against the prediction for the task's duration"});
  expectNotIn(usual, {"Damping of the hand"});
  analysis.options.measure.cutoff = 0;
  analysis.options.measure.onset.rule = OnsetRule::Absolute;
  analysis.options.measure.onset.speed = 0.025;
  analysis.options.handMass = 0.75;
  analysis.options.handDamping = 2.5;
  analysis.options.predictFor = PredictionDuration::Moved;
  expectIn(describeMethods(analysis),
           {"was differentiated without a filter", "crosses 0.025 m/s", "The mass of the hand was given, 0.75 kg.",
            " Damping of the hand: 2.5 N s/m.", "against the prediction for the duration that was moved"});
  analysis.options.measure.onset.rule = OnsetRule::Task;
  expectIn(describeMethods(analysis), {"by the task's own window"});
  expectIn(describeLimits(analysis), {"closest among the candidates is not proved"});
}

TEST(Wording, OfEffectsGivesIntervalsForTwoPeopleOrMore) {
  const Analysis analysis = madeStudy();
  EXPECT_EQ(describeEffect(analysis, analysis.effects[0]),
            "quick, D2 − D1: +21 percentage points [5, 37], odds ratio 2.5 [1.25, 5], p = 0.012 (2 subjects).");
  EXPECT_EQ(describeEffect(analysis, analysis.effects[1]), "quick − slow pace: −12.5 percentage points (one subject: no interval).");
  EXPECT_EQ(describeSlope(analysis, analysis.slopes[0]),
            "quick: +0.75 percentage points per ten trials [−0.25, 1.75], p = 0.2 (2 subjects).");
  EXPECT_EQ(describeSlope(analysis, analysis.slopes[1]), "slow pace: −0.3 percentage points per ten trials (one subject: no interval).");
  Effect none = analysis.effects[1];
  none.points.mean = 0;
  expectIn(describeEffect(analysis, none), {": +0 percentage"});
  LearningSlope flat = analysis.slopes[1];
  flat.perHundred = 0;
  expectIn(describeSlope(analysis, flat), {": +0 percentage"});
}

}  // namespace
}  // namespace reachlab::analysis
