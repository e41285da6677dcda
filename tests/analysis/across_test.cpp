#include "analysis/measures/across.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/math/minimum_jerk.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

constexpr double kB = 13, kDuration = 0.5;  // [N s/m], [s]
constexpr experiment::SquareMatrix<3> kCurl{{{0, 0, kB}, {0, 0, 0}, {-kB, 0, 0}}};
const Vec3 kForward{0, 0, -1}, kRight{1, 0, 0};

/// A minimum-jerk reach of 10 cm forward at 1 kHz, 0.1 s after arming, bent to the right by `bend` at its middle and turned
/// counterclockwise by `degrees`.
TrialData reachOf(double bend, double degrees = 0) {
  TrialData trial;
  trial.rate = 1000;
  trial.taskOnset = 0.1;
  trial.taskEnd = 0.1 + kDuration;
  trial.start = {0.2, 0.1, 0};
  trial.target = trial.start + 0.1 * kForward;
  trial.along = {kForward};
  const double turn = degrees * std::numbers::pi / 180;
  const Vec3 along = std::cos(turn) * kForward - std::sin(turn) * kRight, right = std::cos(turn) * kRight + std::sin(turn) * kForward;
  for (int i = 0; i <= 600; ++i) {
    const double x = std::clamp((i / 1000.0 - 0.1) / kDuration, 0.0, 1.0), way = minimumJerk(x), rate = minimumJerkRate(x) / kDuration;
    trial.hand.push_back(trial.start + 0.1 * way * along + bend * std::sin(std::numbers::pi * way) * right);
    trial.velocity.push_back(0.1 * rate * along + bend * std::numbers::pi * std::cos(std::numbers::pi * way) * rate * right);
  }
  return trial;
}

TrialMeasures measured(const TrialData& trial) {
  TrialMeasures m;
  measureAcross(trial, m);
  return m;
}

TEST(MeasuresAcross, ADeviationIsPositiveToTheRightOfTheWay) {
  for (const double bend : {0.02, -0.02}) {
    const TrialMeasures m = measured(reachOf(bend));
    EXPECT_NEAR(m.maxPerpendicular, bend, 1e-12) << "half of a sine has its largest value in the middle";
    EXPECT_NEAR(m.perpendicularAtPeakSpeed, bend, 1e-12) << "where the reach is fastest";
  }
  EXPECT_NEAR(measured(reachOf(0)).maxPerpendicular, 0, 1e-15);
}

TEST(MeasuresAcross, AHandThatUndoesARotationHasItsAngle) {
  for (const double degrees : {-30.0, 15.0, 45.0}) {
    const TrialMeasures m = measured(reachOf(0, degrees));
    EXPECT_NEAR(m.handAngle, degrees, 1e-9);
    EXPECT_NEAR(m.handAngleAtRadius, degrees, 1e-9);
    EXPECT_NEAR(m.maxPerpendicular, -0.1 * std::sin(degrees * std::numbers::pi / 180), 1e-12);
  }
}

TEST(MeasuresAcross, AHandThatDoesNotReachTheRadiusHasNoAngleThere) {
  TrialData trial = reachOf(0);
  trial.target = trial.start + 0.2 * kForward;
  EXPECT_TRUE(std::isnan(measured(trial).handAngleAtRadius));
}

/// The channel returns this share of the force that cancels a curl field, to the right.
TrialData pressedInAChannel(double share) {
  TrialData trial = reachOf(0);
  trial.scene.channel = true;
  trial.scene.trained = kCurl;
  for (const Vec3& v : trial.velocity) trial.environment.push_back(share * Vec3{kB * v.z, 0, -kB * v.x});
  return trial;
}

TEST(MeasuresAcross, AHandThatPressesWithAShareOfTheForceHasAdaptedByIt) {
  for (const double share : {0.0, 0.5, 1.0}) {
    const TrialMeasures m = measured(pressedInAChannel(share));
    EXPECT_NEAR(m.adaptation, 100 * share, 1e-9);
    if (share > 0) EXPECT_NEAR(m.adaptationR2, 1, 1e-12);
    else EXPECT_TRUE(std::isnan(m.adaptationR2)) << "no force has no part that is explained";
    EXPECT_EQ(m.channelLeak, 0);
  }
}

// Twice the force in every second row and none in the others: the same share, and as much unexplained as explained.
TEST(MeasuresAcross, AForceThatDoesNotFollowTheSpeedIsExplainedLess) {
  TrialData trial = pressedInAChannel(1);
  for (std::size_t i = 0; i < trial.environment.size(); ++i) trial.environment[i] = (i % 2 == 0 ? 2.0 : 0.0) * trial.environment[i];
  EXPECT_NEAR(measured(trial).adaptation, 100, 1);
  EXPECT_NEAR(measured(trial).adaptationR2, 0.5, 0.01);
}

TEST(MeasuresAcross, OnlyAChannelTrialOfATrainedFieldHasAnAdaptation) {
  TrialData trial = pressedInAChannel(1);
  trial.scene.trained.reset();
  EXPECT_TRUE(std::isnan(measured(trial).adaptation));
  EXPECT_FALSE(std::isnan(measured(trial).channelLeak));
  trial = pressedInAChannel(1);
  trial.scene.channel = false;
  EXPECT_TRUE(std::isnan(measured(trial).adaptation));
  EXPECT_TRUE(std::isnan(measured(trial).channelLeak));
}

TEST(MeasuresAcross, ALeakIsCountedOnAllSidesOfTheLine) {
  TrialData trial = pressedInAChannel(1);
  trial.hand[300] += Vec3{0.003, 0.004, 0};
  EXPECT_NEAR(measured(trial).channelLeak, 0.005, 1e-15);
}

TEST(MeasuresAcross, ThereIsNoneOnABentWayOrWithoutAMovement) {
  TrialData trial = reachOf(0.02);
  trial.along.push_back(kForward);
  EXPECT_TRUE(std::isnan(measured(trial).maxPerpendicular));
  trial = reachOf(0.02);
  trial.taskOnset = kNotMeasured;
  EXPECT_TRUE(std::isnan(measured(trial).maxPerpendicular));
  trial = reachOf(0.02);
  trial.scene.normal = kForward;
  EXPECT_TRUE(std::isnan(measured(trial).maxPerpendicular)) << "in this plane the way has no right";
}

TEST(SceneOfATrial, TellsChannelAndField) {
  experiment::Experiment field, channel;
  field.environment = {{experiment::ViscousForce{kCurl}}};
  channel.environment = {{experiment::ChannelForce{}, experiment::ForceWhen::Trial}};
  EXPECT_EQ(viscousFieldOf(field), kCurl);
  EXPECT_FALSE(viscousFieldOf(channel));
  EXPECT_TRUE(sceneOf(channel, kCurl).channel);
  EXPECT_FALSE(sceneOf(channel, kCurl).inField);
  EXPECT_EQ(sceneOf(channel, kCurl).trained, kCurl);
  EXPECT_TRUE(sceneOf(field, kCurl).inField);
  EXPECT_FALSE(sceneOf(field, kCurl).channel);
  EXPECT_FALSE(sceneOf({}, kCurl).inField) << "a null trial";
}

}  // namespace
}  // namespace reachlab::analysis
