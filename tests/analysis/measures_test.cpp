#include "analysis/measures/measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::analysis {
namespace {

// A reach with v = 12 s^2 (1 - s) D / T, whose peak of 16/9 D / T is at s = 2/3, along a direction across all axes.
constexpr double kRest = 0.5, kTime = 0.8, kWay = 0.25, kReachRate = 500;
const Vec3 kAlong{2.0 / 3, -1.0 / 3, 2.0 / 3}, kStart{0.1, 0.2, -0.3};
constexpr double kFirst = 0.0015, kPeak = 16.0 / 9 * kWay / kTime;
constexpr double kClose = 2e-4;  // of differences and interpolation at 500 Hz

double placeAt(double s) { return s <= 0 ? 0 : s >= 1 ? kWay : kWay * s * s * s * (4 - 3 * s); }
double speedAt(double s) { return s <= 0 || s >= 1 ? 0 : 12 * s * s * (1 - s) * kWay / kTime; }

TrialData reach() {
  TrialData trial;
  trial.rate = kReachRate;
  trial.first = kFirst;
  trial.goTime = 0.2;
  trial.taskOnset = 0.6;
  trial.taskEnd = 1.55;
  trial.result.outcome = trial::Outcome::Success;
  trial.along = {kAlong};
  trial.start = kStart;
  trial.target = kStart + 0.24 * kAlong;
  for (int i = 0; i <= 800; ++i) {
    const double s = (i / kReachRate - kRest) / kTime;
    trial.hand.push_back(Vec3{7, 8, 9} + placeAt(s) * kAlong);
    trial.object.push_back(kStart + 1.02 * placeAt(s) * kAlong);
    trial.objectVelocity.push_back(1.02 * speedAt(s) * kAlong);
    trial.force.push_back(1 + i / kReachRate);
  }
  return trial;
}

MeasureOptions unfiltered() {
  MeasureOptions options;
  options.cutoff = 0;
  return options;
}

TrialMeasures measured(const TrialData& trial, const MeasureOptions& options = unfiltered()) {
  return computeMeasures(trial, computeSignals(trial, options));
}

TEST(Measures, OfTheForceAreTheLogsWhereItHasThem) {
  TrialData trial = reach();
  TrialMeasures m = measured(trial);
  EXPECT_NEAR(m.peakForce, 2.6, 1e-12) << "of all samples";
  EXPECT_NEAR(m.meanForce, 1 + (m.onset + m.offset) / 2 - kFirst, 2e-3) << "over the movement";
  trial.peakForce = 7, trial.meanForce = 3;
  m = measured(trial);
  EXPECT_EQ(m.peakForce, 7);
  EXPECT_EQ(m.meanForce, 3);
  trial.peakForce = trial.meanForce = kNotMeasured;
  trial.force.clear();
  EXPECT_TRUE(std::isnan(measured(trial).peakForce));
}

TEST(Measures, OfAHandThatLeftBeforeTheSignalHaveNoReactionTime) {
  TrialData trial = reach();
  trial.goTime = 0.7;
  const TrialMeasures m = measured(trial);
  EXPECT_TRUE(m.beforeGo);
  EXPECT_TRUE(std::isnan(m.reactionTime));
  trial.goTime = kNotMeasured;
  EXPECT_FALSE(measured(trial).beforeGo);
  EXPECT_TRUE(std::isnan(measured(trial).reactionTime));
}

TEST(Measures, WithoutAMovementAreTheTasksAndTheLogsAlone) {
  TrialData trial = reach();
  for (Vec3& place : trial.hand) place = {};
  trial.peakForce = 7, trial.meanForce = 3;
  const TrialMeasures m = measured(trial);
  EXPECT_NEAR(m.movementTime, 0.95, 1e-12);
  EXPECT_EQ(m.peakForce, 7);
  EXPECT_EQ(m.meanForce, 3);
  for (const double none : {m.onset, m.offset, m.duration, m.reactionTime, m.peakSpeed, m.timeToPeak, m.pathLength, m.speedPeaks, m.sparc,
                            m.handEndpointError, m.objectEndpointError, m.handOvershoot, m.objectOvershoot})
    EXPECT_TRUE(std::isnan(none));
}

// A closed curve leads to its target either way round: the way that the hand went is forwards.
TEST(Signals, OfAClosedCurveAreAlongTheWayThatTheHandWent) {
  TrialData trial = reach();
  trial.along = {-1 * kAlong};
  EXPECT_FALSE(computeSignals(trial, unfiltered()).otherWay) << "no closed curve";
  EXPECT_LT(computeSignals(trial, unfiltered()).handVelocity[450], 0);
  trial.closed = true;
  const TrialSignals signals = computeSignals(trial, unfiltered());
  EXPECT_TRUE(signals.otherWay);
  EXPECT_NEAR(signals.handVelocity[450], speedAt(0.5), kClose);
  EXPECT_NEAR(signals.objectVelocity[450], 1.02 * speedAt(0.5), 1e-12);
  trial.along = {kAlong};
  EXPECT_FALSE(computeSignals(trial, unfiltered()).otherWay);
}

// A hand that is fastest when its trial ends has its peak there, and no slowing-down to compare with.
TEST(Signals, ThatArePeakingWhenTheTrialEndsHaveTheirPeakAtTheEnd) {
  TrialData trial = reach();
  trial.taskEnd = 0.8013;  // between two samples
  const TrialSignals signals = computeSignals(trial, unfiltered());
  const auto found = computeMeasures(trial, signals);
  EXPECT_LE(found.timeToPeak, found.duration);
  EXPECT_TRUE(std::isnan(found.symmetryRatio) || found.symmetryRatio > 0);
}

// Marks and the task's window are told since arming; the movement is counted from the first sample.
TEST(Signals, EndWithTheTrialAndGiveWayToMarks) {
  TrialData trial = reach();
  trial.taskEnd = 1.0;
  EXPECT_NEAR(computeSignals(trial, unfiltered()).movement.offset, 1.0 - kFirst, 1e-9) << "though the hand moves on";
  MeasureOptions task = unfiltered();
  task.onset.rule = OnsetRule::Task;
  EXPECT_DOUBLE_EQ(computeSignals(trial, task).movement.onset, 0.6 - kFirst);
  EXPECT_DOUBLE_EQ(computeSignals(trial, task).movement.offset, 1.0 - kFirst);
  trial.markedOnset = 0.7;
  const Movement later = computeSignals(trial, unfiltered()).movement;
  EXPECT_DOUBLE_EQ(later.onset, 0.7 - kFirst);
  EXPECT_NEAR(later.offset, 1.0 - kFirst, 1e-9);
  trial.markedOffset = 0.9;
  EXPECT_DOUBLE_EQ(computeSignals(trial, unfiltered()).movement.offset, 0.9 - kFirst);
  trial.markedOnset = 0.95;
  EXPECT_FALSE(computeSignals(trial, unfiltered()).movement.found) << "nothing is between marks that cross";
  trial.markedOnset = kNotMeasured;
  trial.markedOffset = 99;
  const TrialSignals beyond = computeSignals(trial, unfiltered());
  EXPECT_DOUBLE_EQ(beyond.movement.offset, static_cast<double>(beyond.speed.size() - 1) / kReachRate) << "to the last sample, no farther";
  trial.markedOffset = kNotMeasured;
  trial.markedOnset = -5;
  EXPECT_EQ(computeSignals(trial, unfiltered()).movement.onset, 0);
}

TEST(Signals, OfATaskThatNeverBeganHaveNoMovementByItsRule) {
  TrialData trial = reach();
  trial.taskEnd = kNotMeasured;
  MeasureOptions task = unfiltered();
  task.onset.rule = OnsetRule::Task;
  EXPECT_FALSE(computeSignals(trial, task).movement.found);
  EXPECT_TRUE(computeSignals(trial, unfiltered()).movement.found);
}

// The trial ends between two rows, and the second was never taken: the straight line through the last two goes on, but not below 0.
TEST(Signals, AreContinuedToTheRowAfterTheTrialsEnd) {
  TrialData trial = reach();
  trial.rate = 10;
  trial.first = 0;
  trial.taskEnd = 0.95;
  trial.hand.clear(), trial.object.clear(), trial.objectVelocity.clear(), trial.force.clear();
  for (int i = 0; i <= 9; ++i) {
    const double t = i / 10.0;
    trial.hand.push_back(0.5 * t * t * kAlong);
    trial.object.push_back({});
    trial.objectVelocity.push_back(t * kAlong);
  }
  const TrialSignals signals = computeSignals(trial, unfiltered());
  ASSERT_EQ(signals.speed.size(), 11u);
  EXPECT_NEAR(signals.speed[10], 1, 1e-12);
  EXPECT_NEAR(signals.handVelocity[10], 1, 1e-12);
  EXPECT_NEAR(signals.objectVelocity[10], 1, 1e-12);
  EXPECT_DOUBLE_EQ(signals.movement.offset, 0.95);
  trial.taskEnd = 0.9;
  EXPECT_EQ(computeSignals(trial, unfiltered()).speed.size(), 10u) << "the row of its end was taken";
  for (int i = 0; i <= 9; ++i) trial.hand[static_cast<std::size_t>(i)] = (i < 8 ? 0.1 * i : i == 8 ? 0.75 : 0.76) * kAlong;
  trial.taskEnd = 0.95;
  EXPECT_EQ(computeSignals(trial, unfiltered()).speed.back(), 0);
}

}  // namespace
}  // namespace reachlab::analysis
