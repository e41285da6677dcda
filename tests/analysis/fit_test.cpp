#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "analysis/conclusions/near_predictions.h"
#include "analysis/conclusions/person_fit.h"
#include "analysis/measures/filter.h"
#include "sim/experiment/experiment.h"
#include "tests/analysis/synthetic.h"

namespace reachlab::analysis {
namespace {

using predict::Criterion;

CandidateOptions of(std::vector<Criterion> criteria) {
  CandidateOptions options;
  options.criteria = std::move(criteria);
  return options;
}
const std::vector<Criterion> kQuick{Criterion::MinHandJerk, Criterion::MinCrackle, Criterion::MinHandForce, Criterion::MinHandForceChange,
                                    Criterion::MinHandCrackle};

/// A recording of `family` at `duration`, from 0.3 s before it to 0.3 s after.
FitWindow recorded(const ProfileFamily& family, double duration, double onset, double amplitude, double stretch = 1) {
  Profile profile;
  EXPECT_TRUE(family.at(duration, profile));
  FitWindow window;
  window.rate = 100;
  window.begin = onset - 0.3;
  const double T = stretch * duration;
  for (int i = 0; i <= static_cast<int>((T + 0.6) * 100); ++i)
    window.velocity.push_back(amplitude * profile.at((window.begin + i / 100.0 - onset) / T));
  window.weight.assign(window.velocity.size(), 1.0);
  return window;
}

/// One person's recordings.
struct Recordings {
  std::vector<FitWindow> windows;
  std::vector<double> durations;
  std::vector<double>& add(FitWindow window, double duration) {
    durations.push_back(duration);
    return windows.emplace_back(std::move(window)).velocity;
  }
  PersonFit fit(const CandidateSet& set) { return fitPerson(windows, durations, set); }
};

TEST(RecordingFilter, IsWhatTheDigitalFilterDoesToSamples) {
  // A minimum jerk of 0.8 s, sampled at 1 kHz and filtered there both ways, against the filter of the function.
  const double T = 0.8, rate = 1000;
  std::vector<double> exact(801), samples(2001, 0.0);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double s = static_cast<double>(i) / 800;
    exact[i] = samples[i + 600] = 30 * s * s * (1 - s) * (1 - s);
  }
  const std::vector<double> digital = lowPass(samples, rate, 10);
  const std::vector<double> ours = RecordingFilter(10, rate).apply(exact, T, 300);
  for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], digital[i + 300], 2e-6 * 1.875) << i;  // reach ends at 1e-6
}

TEST(Profile, HasItsValuesUpToItsEndsAndIsNothingBeyond) {
  const Profile profile{-0.5, 0.25, {1, 3, 2, 5, 4}, {}};
  for (std::size_t i = 0; i < profile.value.size(); ++i)
    EXPECT_DOUBLE_EQ(profile.at(profile.first + profile.step * static_cast<double>(i)), profile.value[i]);
  for (const double s : {profile.first + 0.01, profile.last() - 0.01}) EXPECT_GT(profile.at(s), 0.5) << s;
  for (const double s : {profile.first - 0.01, profile.last() + 0.01}) EXPECT_EQ(profile.at(s), 0) << s;
}

// Joint torque change is predicted at few durations, each started from its neighbours: against predictions of its own for each duration.
TEST(ProfileFamily, OfTorqueChangeIsExactThoughItsPredictionsStartFromOneAnother) {
  experiment::Experiment chain = experiment::readExperiment("chain-moderate");
  const CandidateSet set = makeCandidates(experiment::CompiledExperiment(chain), of({Criterion::MinTorqueChange}));
  const ProfileFamily& family = *set.candidates.front().families.front();
  for (const double t : {1.35, 0.95, 1.4, 1.77, 1.0}) {  // half-way between two of its durations, where it is worst, in any order
    const double node = std::floor(t / family.grid().spacing) * family.grid().spacing;
    predict::PredictOptions how;
    how.duration = node + 0.5 * family.grid().spacing;
    const auto exact = predict::predict(chain, Criterion::MinTorqueChange, how);
    std::vector<double> phi(family.grid().parts + 1);
    ASSERT_TRUE(sampleProfile(*exact, phi));
    Profile between;
    ASSERT_TRUE(family.at(how.duration, between));
    const std::size_t margin = (between.value.size() - phi.size()) / 2;
    const std::vector<double> filtered = RecordingFilter(10, 100).apply(phi, how.duration, margin);
    const double peak = *std::max_element(filtered.begin(), filtered.end());
    for (std::size_t i = 0; i < filtered.size(); ++i) ASSERT_NEAR(between.value[i], filtered[i], 1e-6 * peak) << t << " s, sample " << i;
  }
}

/// Trials of one plan run faster or slower (stretched), or planned anew for each duration; no scatter but of the durations.
PersonFit fitOf(const CandidateSet& set, std::size_t truth, std::size_t family, bool onePlan, double T) {
  Recordings trials;
  std::mt19937_64 random(5);
  for (int i = 0; i < 10; ++i) {
    const double stretch = 0.9 + 0.2 * std::generate_canonical<double, 53>(random);
    trials.add(recorded(*set.candidates[truth].families[family], onePlan ? T : T * stretch, 0.5, 0.2 / T / stretch, onePlan ? stretch : 1),
               0.95 * T * stretch);
  }
  return trials.fit(set);
}

TEST(PersonFit, WithoutScatterPutsTheTruthFirstForEveryCriterionAndTimeLaw) {
  for (const experiment::Experiment& e :
       {chainExperiment(1.35), parallelExperiment(2.5), lineExperiment(experiment::ObjectKind::Chain, {3}, {}, 120, 1.35)}) {
    const CandidateSet set = makeCandidates(experiment::CompiledExperiment(e), of(kQuick));
    for (std::size_t truth = 0; truth < set.candidates.size(); ++truth)
      for (const bool onePlan : {false, true}) {
        if (onePlan && set.candidates[truth].reference()) continue;
        const std::size_t family = set.candidates[truth].families.size() > 1 ? 1 : 0;  // 1 kg
        const PersonFit fit = fitOf(set, truth, family, onePlan, e.task->duration);
        std::size_t best = 0;
        for (std::size_t k = 1; k < fit.candidates.size(); ++k)
          if (fit.candidates[k].meanScore < fit.candidates[best].meanScore) best = k;
        EXPECT_EQ(best, truth) << e.task->duration << (onePlan ? " one plan" : " anew");
        // One plan's duration and the hand's mass can stand for one another; planned anew they cannot.
        if (!onePlan) {
          EXPECT_EQ(fit.candidates[truth].choice.family, family) << e.task->duration;
        }
      }
  }
}

// An even and an odd number of trials, so that their median duration is one of them or lies between two. The hand's mass is given: without any
// scatter, rounding chooses between masses and plans that stand for one another.
TEST(PersonFit, OfAllTrialsDoesNotDependOnTheirOrder) {
  CandidateOptions options = of({Criterion::MinHandJerk, Criterion::MinHandForceChange});
  options.handMass = 0;
  const CandidateSet set = makeCandidates(experiment::CompiledExperiment(chainExperiment(1.35)), options);
  for (const int count : {12, 13}) {
    Recordings trials;
    std::vector<std::size_t> order;
    for (int i = 0; i < count; ++i) {
      const double stretch = 0.8 + 0.03 * i;
      trials.add(recorded(*set.candidates[1].families[0], 1.35, 0.5, 0.2 / stretch, stretch), 1.3 * stretch);
      order.push_back(static_cast<std::size_t>(i * 5 % count));
    }
    const auto choicesIn = [&](const std::vector<std::size_t>& places) {
      Recordings placed;
      for (const std::size_t i : places) placed.add(trials.windows[i], trials.durations[i]);
      std::vector<double> plans;
      for (const CandidateFit& fit : placed.fit(set).candidates) plans.push_back(fit.choice.plan);
      return plans;
    };
    const std::vector<double> shuffled = choicesIn(order);
    std::sort(order.begin(), order.end());
    const std::vector<double> sorted = choicesIn(order);
    ASSERT_EQ(shuffled.size(), sorted.size());
    EXPECT_GT(sorted[1], 0) << "one plan, stretched, as they were made";
    for (std::size_t k = 0; k < sorted.size(); ++k) EXPECT_NEAR(shuffled[k], sorted[k], 1e-7) << count << " trials";
  }
}

// Plans are tried 1.8 % apart. Where trials waver alike, the plan of several is the mean of theirs, which lies between two that are tried:
// of a fold that is left out, a part of a step away from the plan of all.
TEST(PersonFit, FindsAPlanBetweenThoseThatItTries) {
  const CandidateSet set = makeCandidates(experiment::CompiledExperiment(chainExperiment(1.35)), of({Criterion::MinHandJerk}));
  constexpr double kApart[kFolds] = {-0.02, 0.01, 0.02, -0.01, 0};  // of ln P, by fold
  for (int without = -1; without < kFolds; ++without) {
    Recordings trials;
    for (int i = 0; i < 15; ++i) {
      if (i % kFolds == without) continue;
      const double stretch = 0.86 + 0.02 * i;
      std::vector<double>& velocity = trials.add(
          recorded(*set.candidates[0].families[0], 1.35 * std::exp(kApart[i % kFolds]), 0.5, 0.2 / stretch, stretch), 1.3 * stretch);
      for (std::size_t k = 0; k < velocity.size(); ++k) velocity[k] += 0.006 * std::sin(0.35 * static_cast<double>(k) / stretch) / stretch;
    }
    const ShapeChoice choice = trials.fit(set).candidates[0].choice;
    ASSERT_EQ(choice.law, TimeLaw::OnePlan);
    EXPECT_NEAR(std::log(choice.plan / 1.35), without < 0 ? 0 : -kApart[without] / (kFolds - 1), 0.001) << "without fold " << without;
  }
}

// A fold's choice must not depend on its own trials: changing them changes neither the choice nor the other folds' scores' shapes.
TEST(PersonFit, ScoresNoTrialByAChoiceItTookPartIn) {
  const experiment::Experiment chain = chainExperiment(1.35);
  const CandidateSet set =
      makeCandidates(experiment::CompiledExperiment(chain), of({Criterion::MinHandForceChange, Criterion::MinHandJerk}));
  const std::size_t force = 0;
  Recordings trials;
  // Fold 0 is planned with 2 kg, the other four with none.
  for (int i = 0; i < 15; ++i)
    trials.add(recorded(*set.candidates[force].families[i % 5 == 0 ? 2 : 0], 1.3 + 0.01 * i, 0.5, 0.15), 1.25 + 0.01 * i);
  const PersonFit fit = trials.fit(set);
  for (std::size_t i = 0; i < trials.windows.size(); i += 5)
    EXPECT_GT(fit.candidates[force].score[i], fit.candidates[force].score[i + 1] + 3);
}

/// Trials of `family` with a slow wave of 3 % of the peak, another in each trial.
PersonFit scatteredFit(const CandidateSet& set, const ProfileFamily& family) {
  Recordings trials;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const double T = 1.35 * std::exp(0.04 * normal(random)), size = 0.03 * normal(random), phase = 3 * normal(random);
    std::vector<double>& velocity = trials.add(recorded(family, T, 0.5, 0.2 / T), 0.95 * T);
    const double peak = *std::max_element(velocity.begin(), velocity.end());
    for (std::size_t k = 0; k < velocity.size(); ++k) velocity[k] += peak * size * std::sin(0.06 * static_cast<double>(k) + phase);
  }
  return trials.fit(set);
}

TEST(PersonFit, FindsAHandsMassBetweenThoseThatItStartsFrom) {
  const CandidateSet set = makeCandidates(experiment::CompiledExperiment(chainExperiment(1.35)),
                                          of({Criterion::MinHandJerk, Criterion::MinHandForce, Criterion::MinHandForceChange}));
  for (const std::size_t truth : {1, 2})
    for (const double mass : {0.3, 1.3, 3.3, 6.6}) {
      const PersonFit fit = scatteredFit(set, *set.candidates[truth].familyOf(mass));
      ASSERT_TRUE(fit.candidates[truth].mass);
      const MassFit& found = *fit.candidates[truth].mass;
      EXPECT_LE(found.interval.low, mass) << truth;
      EXPECT_GE(found.interval.high, mass) << truth;
      EXPECT_LE(found.interval.low, found.mass);
      EXPECT_GE(found.interval.high, found.mass);
      EXPECT_EQ(found.mass, fit.candidates[truth].choice.mass);
      EXPECT_FALSE(found.atEdge) << mass;
      EXPECT_TRUE(fit.candidates[truth].beyond.empty());
      EXPECT_FALSE(fit.candidates[0].mass) << "a hand's mass changes nothing for (1)";
    }
}

TEST(PersonFit, SaysThatAMassIsAtTheEdgeAndTriesThoseBeyond) {
  CandidateOptions options = of({Criterion::MinHandJerk, Criterion::MinHandForce});
  options.handMasses = {2, 4, 3};
  const CandidateSet set = makeCandidates(experiment::CompiledExperiment(chainExperiment(1.35)), options);
  EXPECT_EQ(set.candidates[1].masses, (std::vector<double>{2, 3, 4}));
  const CandidateFit fit = scatteredFit(set, *set.candidates[1].familyOf(0.2)).candidates[1];
  EXPECT_EQ(fit.mass->mass, 2);
  EXPECT_TRUE(fit.mass->atEdge);
  ASSERT_EQ(fit.beyond.size(), fit.score.size());
  EXPECT_LT(std::accumulate(fit.beyond.begin(), fit.beyond.end(), 0.0), std::accumulate(fit.score.begin(), fit.score.end(), 0.0));
  options.handMasses = {0, 1, 2};
  const CandidateSet fromZero = makeCandidates(experiment::CompiledExperiment(chainExperiment(1.35)), options);
  EXPECT_FALSE(scatteredFit(fromZero, *fromZero.candidates[1].familyOf(0.02)).candidates[1].mass->atEdge) << "no hand is lighter than 0 kg";
}

TEST(PersonFit, GivesEveryCandidateTheSameWindowAndWeights) {
  const experiment::Experiment chain = chainExperiment(1.35);
  const auto weightsWith = [&](std::vector<Criterion> criteria) {
    const CandidateSet truth = makeCandidates(experiment::CompiledExperiment(chain), of({Criterion::MinHandJerk})),
                       set = makeCandidates(experiment::CompiledExperiment(chain), of(std::move(criteria)));
    Recordings trials;
    for (int i = 0; i < 10; ++i) {
      std::vector<double>& velocity =
          trials.add(recorded(*truth.candidates[0].families[0], 1.2 + 0.02 * i, 0.5, 0.15 + 0.002 * (i % 3)), 1.1 + 0.02 * i);
      for (std::size_t k = 0; k < velocity.size(); ++k) velocity[k] += 0.004 * std::sin(0.1 * i * static_cast<double>(k));
    }
    trials.fit(set);
    std::vector<std::vector<double>> weights;
    for (const FitWindow& w : trials.windows) weights.push_back(w.weight);
    return weights;
  };
  EXPECT_EQ(weightsWith({Criterion::MinHandJerk}), weightsWith({Criterion::MinCrackle, Criterion::MinHandForce}));
}

}  // namespace
}  // namespace reachlab::analysis
