#include "analysis/measures/deviation_and_adaptation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/minimum_jerk.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

constexpr double kB = 13, kReachSeconds = 0.5;  // [N s/m], [s]
constexpr experiment::SquareMatrix<3> kCurl{{{0, 0, kB}, {0, 0, 0}, {-kB, 0, 0}}};
const Vec3 kForward{0, 0, -1};

/// A minimum-jerk reach of 10 cm forward at 1 kHz, 0.1 s after arming.
TrialData straightReach() {
  TrialData trial;
  trial.rate = 1000;
  trial.taskOnset = 0.1;
  trial.taskEnd = 0.1 + kReachSeconds;
  trial.start = {0.2, 0.1, 0};
  trial.target = trial.start + 0.1 * kForward;
  trial.along = {kForward};
  for (int i = 0; i <= 600; ++i) {
    const double x = std::clamp((i / 1000.0 - 0.1) / kReachSeconds, 0.0, 1.0);
    trial.hand.push_back(trial.start + 0.1 * minimumJerk(x) * kForward);
    trial.velocity.push_back(0.1 * minimumJerkRate(x) / kReachSeconds * kForward);
  }
  return trial;
}

TrialMeasures measuredAcross(const TrialData& trial) {
  TrialMeasures m;
  measureAcross(trial, m);
  return m;
}

/// The channel returns this share of the force that cancels a curl field, to the right.
TrialData pressedInAChannel(double share) {
  TrialData trial = straightReach();
  trial.scene.channel = true;
  trial.scene.trained = kCurl;
  for (const Vec3& v : trial.velocity) trial.environment.push_back(share * Vec3{kB * v.z, 0, -kB * v.x});
  return trial;
}

TEST(MeasuresAcross, AHandThatPressesWithAShareOfTheForceHasAdaptedByIt) {
  for (const double share : {0.0, 0.5, 1.0}) {
    const TrialMeasures m = measuredAcross(pressedInAChannel(share));
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
  EXPECT_NEAR(measuredAcross(trial).adaptation, 100, 1);
  EXPECT_NEAR(measuredAcross(trial).adaptationR2, 0.5, 0.01);
}

TEST(MeasuresAcross, OnlyAChannelTrialOfATrainedFieldHasAnAdaptation) {
  TrialData trial = pressedInAChannel(1);
  trial.scene.trained.reset();
  EXPECT_TRUE(std::isnan(measuredAcross(trial).adaptation));
  EXPECT_FALSE(std::isnan(measuredAcross(trial).channelLeak));
  trial = pressedInAChannel(1);
  trial.scene.channel = false;
  EXPECT_TRUE(std::isnan(measuredAcross(trial).adaptation));
  EXPECT_TRUE(std::isnan(measuredAcross(trial).channelLeak));
}

// Half way the hand is to the right of the line, at the target's distance to its left; it goes on beyond.
TEST(MeasuresAcross, TheAngleAtTheTargetsRadiusIsThatWhereTheHandFirstComesSoFar) {
  TrialData trial = straightReach();
  for (std::size_t i = 100; i < trial.hand.size(); ++i) {
    const double x = static_cast<double>(i - 100) / 400;  // at the target's distance after 400 of the 500 rows
    const double angle = x < 1 ? 0.2 * (1 - x) : 0.3 * (1 - x) - 0.1;
    trial.hand[i] = trial.start + 0.1 * x * Vec3{std::sin(angle), 0, -std::cos(angle)};
  }
  EXPECT_NEAR(measuredAcross(trial).handAngleAtRadius, 0.1 * 180 / std::numbers::pi, 1e-9) << "to the left is positive";
}

TEST(MeasuresAcross, ALeakIsCountedOnAllSidesOfTheLine) {
  TrialData trial = pressedInAChannel(1);
  trial.hand[300] += Vec3{0.003, 0.004, 0};
  EXPECT_NEAR(measuredAcross(trial).channelLeak, 0.005, 1e-15);
}

TEST(MeasuresAcross, ThereIsNoneOnABentWayOrWithoutAMovement) {
  TrialData trial = straightReach();
  trial.along.push_back(kForward);
  EXPECT_TRUE(std::isnan(measuredAcross(trial).maxPerpendicular));
  trial = straightReach();
  trial.taskOnset = kNotMeasured;
  EXPECT_TRUE(std::isnan(measuredAcross(trial).maxPerpendicular));
  trial = straightReach();
  trial.scene.normal = kForward;
  EXPECT_TRUE(std::isnan(measuredAcross(trial).maxPerpendicular)) << "in this plane the way has no right";
}

TEST(SceneOfATrial, TellsChannelAndField) {
  experiment::Experiment field, channel;
  field.environment = {{experiment::ViscousForce{kCurl}}};
  channel.environment = {{experiment::ChannelForce{}, experiment::ForceWhen::Trial}};
  EXPECT_EQ(viscousFieldOf(field), kCurl);
  EXPECT_FALSE(viscousFieldOf(channel));
  experiment::Experiment none;
  none.environment = {{experiment::ViscousForce{}}};
  EXPECT_FALSE(viscousFieldOf(none)) << "a matrix of zeros is no field";
  EXPECT_TRUE(sceneOf(channel, kCurl).channel);
  EXPECT_FALSE(sceneOf(channel, kCurl).inField);
  EXPECT_EQ(sceneOf(channel, kCurl).trained, kCurl);
  EXPECT_TRUE(sceneOf(field, kCurl).inField);
  EXPECT_FALSE(sceneOf(field, kCurl).channel);
  EXPECT_FALSE(sceneOf({}, kCurl).inField) << "a null trial";
  EXPECT_EQ(sceneOf({}, kCurl).strength, 0);
  experiment::SquareMatrix<3> half = kCurl;
  for (auto& row : half)
    for (double& b : row) b *= -0.5;
  field.environment = {{experiment::ViscousForce{half}}};
  EXPECT_EQ(sceneOf(field, kCurl).strength, -0.5);
  field.environment = {{experiment::JointViscousForce{}}};
  EXPECT_TRUE(sceneOf(field, {}).inField);
  channel.environment.push_back({experiment::PulseForce{}});
  EXPECT_TRUE(sceneOf(channel, kCurl).channel);
  EXPECT_TRUE(sceneOf(channel, kCurl).otherForce) << "what the channel returns is not known alone";
}

}  // namespace
}  // namespace reachlab::analysis
