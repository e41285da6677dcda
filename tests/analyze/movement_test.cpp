#include "sim/analyze/movement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim/analyze/measures.h"
#include "tests/analyze/synthetic.h"

namespace reachlab::analyze {
namespace {

constexpr double kRate = 100;

std::vector<double> bell(double before, double duration, double after, double height = 0.3) {
  std::vector<double> v;
  for (int i = 0; i <= static_cast<int>(std::lround((before + duration + after) * kRate)); ++i) {
    const double s = (i / kRate - before) / duration;
    v.push_back(s < 0 || s > 1 ? 0 : height * 16 * s * s * (1 - s) * (1 - s));
  }
  return v;
}

/// Where 16 s^2 (1-s)^2 reaches `share`.
double crossing(double share) { return (1 - std::sqrt(1 - std::sqrt(share))) / 2; }

TEST(FindMovement, FindsTheCrossingsOfABell) {
  for (const double percent : {2.0, 5.0, 10.0}) {
    OnsetOptions options;
    options.percent = percent;
    const Movement m = findMovement(bell(0.5, 1.0, 0.7), kRate, options);
    ASSERT_TRUE(m.found);
    const double kLinear = 1e-3;  // [s] linear interpolation over 10 ms of a curve
    EXPECT_NEAR(m.onset, 0.5 + crossing(percent / 100), kLinear);
    EXPECT_NEAR(m.offset, 1.5 - crossing(percent / 100), kLinear);
    EXPECT_NEAR(m.peakTime, 1.0, 1e-9);
    EXPECT_NEAR(m.peak, 0.3, 1e-12);
    EXPECT_FALSE(m.cutAtStart || m.cutAtEnd);
  }
}

TEST(FindMovement, SkipsATwitchBeforeTheMovement) {
  std::vector<double> v = bell(0.5, 1.0, 0.7);
  v[10] = v[11] = 0.1;  // 20 ms
  EXPECT_NEAR(findMovement(v, kRate, {}).onset, 0.5 + crossing(0.05), 1e-3);
}

TEST(FindMovement, SearchesBackFromThePeakSoThatADriftBeginsNothing) {
  // A slow drift at 8 % of the peak, which ends 0.2 s before the reach: the first upward crossing is the drift's.
  std::vector<double> v = bell(0.8, 1.0, 0.7);
  for (std::size_t i = 10; i < static_cast<std::size_t>(0.6 * kRate); ++i) v[i] = std::max(v[i], 0.08 * 0.7);
  const Movement drifting = findMovement(v, kRate, {}), clean = findMovement(bell(0.8, 1.0, 0.7), kRate, {});
  EXPECT_DOUBLE_EQ(drifting.onset, clean.onset);
  EXPECT_DOUBLE_EQ(drifting.offset, clean.offset);
}

TEST(FindMovement, KeepsBothPhasesOfATwoPhaseMovement) {
  std::vector<double> v = bell(0.3, 0.5, 0.0);
  const std::vector<double> second = bell(0.1, 0.6, 0.4, 0.2);
  v.insert(v.end(), second.begin(), second.end());
  const Movement m = findMovement(v, kRate, {});
  EXPECT_LT(m.onset, 0.4);
  EXPECT_GT(m.offset, 1.4);
}

TEST(FindMovement, SaysWhereTheSignalBeginsOrEndsTooSoon) {
  std::vector<double> v = bell(0, 1, 0);
  v.erase(v.begin(), v.begin() + 30);
  v.resize(v.size() - 30);
  const Movement m = findMovement(v, kRate, {});
  EXPECT_TRUE(m.found && m.cutAtStart && m.cutAtEnd);
  EXPECT_DOUBLE_EQ(m.onset, 0);
  EXPECT_DOUBLE_EQ(m.offset, static_cast<double>(v.size() - 1) / kRate);
}

TEST(FindMovement, FindsNoneInStillness) {
  EXPECT_FALSE(findMovement(std::vector<double>(100, 0.0), kRate, {}).found);
  EXPECT_FALSE(findMovement({}, kRate, {}).found);
  OnsetOptions absolute;
  absolute.rule = OnsetRule::Absolute;
  absolute.speed = 0.5;
  EXPECT_FALSE(findMovement(bell(0.2, 1, 0.2), kRate, absolute).found);
}

// Of a hand that trembles, 5 % of the peak speed is passed at once and at last: the whole trial would be its movement.
TEST(FindMovement, FindsNoneWhereTheTrialEndedBecauseTheHandNeverLeft) {
  TrialData trial;
  trial.rate = kRate;
  for (int i = 0; i < 200; ++i) {
    trial.hand.push_back({2e-5 * std::sin(60.0 * i / kRate), 0, 0});
    trial.object.push_back({});
    trial.objectVelocity.push_back({});
    trial.force.push_back(0);
  }
  EXPECT_TRUE(computeSignals(trial, {}).movement.found);
  for (const trial::Reason reason : {trial::Reason::NoOnset, trial::Reason::NoStart}) {
    trial.result = {trial::Outcome::Aborted, reason};
    EXPECT_FALSE(computeSignals(trial, {}).movement.found);
  }
}

TEST(ScaleVelocity, KeepsTheDistance) {
  const std::vector<double> v = bell(0.5, 1.0, 0.7);
  const auto distance = [](const std::vector<double>& profile, double duration) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) sum += 0.5 * (profile[i] + profile[i + 1]);
    return sum * duration / static_cast<double>(profile.size() - 1);
  };
  const double d = distance(normaliseTime(v, kRate, 0.5, 1.5), 1.0);
  for (const double duration : {0.5, 1.0, 2.26}) EXPECT_NEAR(distance(scaleVelocity(v, kRate, 0.5, 1.5, duration), duration), d, 1e-12);
}

TEST(SmoothValue, FollowsACurveBetterThanTheChord) {
  std::vector<double> v;
  for (int i = 0; i < 100; ++i) v.push_back(std::sin(0.1 * i));
  double chord = 0, smooth = 0;
  for (double t = 0.1; t < 0.9; t += 0.0037) {
    chord = std::max(chord, std::abs(valueAt(v, kRate, t) - std::sin(10 * t)));
    smooth = std::max(smooth, std::abs(smoothValueAt(v, kRate, t) - std::sin(10 * t)));
  }
  EXPECT_LT(smooth, chord / 10);
}

TEST(Onset, OfSimulatedTrialsIsWhereItWasPutWithSmallBiasAndSpread) {
  // Known onsets: where the planned, time-stretched velocity itself crosses 5 % of its peak. What is left is the measurement's noise,
  // the filter and 100 Hz sampling.
  const auto plan = predict::predict(chainExperiment(1.35), predict::Criterion::MinHandJerk);
  OnsetOptions onset;
  const double planned = [&] {
    double peak = std::abs(plan->handPeak), t = 0;
    while (plan->handAt(t).velocity < 0.05 * peak) t += 1e-5;
    return t;
  }();
  std::mt19937_64 random(7);
  std::vector<double> errors;
  Scatter scatter;
  scatter.shape = 0;  // a wave would move the truth itself
  for (int i = 0; i < 200; ++i) {
    const TrialData trial = followPlan(*plan, scatter, random);
    const TrialSignals signals = computeSignals(trial, {});
    const double truth = trial.taskOnset + planned * (trial.taskEnd - trial.taskOnset) / plan->duration;
    errors.push_back(signals.movement.onset - truth);
  }
  const MeanSd e = computeMeanSd(errors);
  std::printf("onset at 5 %% of peak, 200 simulated trials, 20 um noise, 10 Hz filter: bias %.2f ms, spread (SD) %.2f ms\n", 1e3 * e.mean,
              1e3 * e.sd);
  EXPECT_LT(std::abs(e.mean), 0.005);  // half a sample
  EXPECT_LT(e.sd, 0.005);
}

}  // namespace
}  // namespace reachlab::analyze
