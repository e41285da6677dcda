// What the theory says about every prediction, whatever its numbers (docs/theory/criteria.md, "Least norm form").
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.h"
#include "sim/predict/predict.h"
#include "tests/predict/objects.h"
#include "tests/refusal.h"

namespace reachlab::predict {
namespace {

using enum Criterion;

// Two closed forms of the same number, each right to a few units in the twelfth digit.
constexpr double kSame = 1e-11;
// Values that docs/theory/criteria.md prints with five digits, and end jumps with two or three.
constexpr double kFiveDigits = 2e-5, kTwoDigits = 0.03;

std::unique_ptr<Prediction> predictWith(const experiment::Experiment& e, Criterion criterion, double handMass, double handDamping = 0) {
  return predict(e, criterion, {.handMass = handMass, .handDamping = handDamping});
}

// Largest difference of two velocities on [0, T], of the first's peak.
double difference(double duration, const std::function<double(double)>& a, const std::function<double(double)>& b) {
  double peak = 0, most = 0;
  for (int i = 0; i <= 100; ++i) {
    const double t = duration * i / 100;
    peak = std::max(peak, std::abs(a(t)));
    most = std::max(most, std::abs(a(t) - b(t)));
  }
  return most / peak;
}

std::function<double(double)> handOf(const Prediction& p) {
  return [&p](double t) { return p.handAt(t).velocity; };
}

double massVelocity(const Prediction& p, int mass, double t) {
  std::vector<double> x(p.massCount()), v(p.massCount());
  p.massesAt(t, x, v);
  return v[mass];
}

double minimumJerkVelocity(double distance, double T, double t) { return 30 * distance / T * std::pow(t / T, 2) * std::pow(1 - t / T, 2); }

TEST(Laws, StiffSpringsGiveTheMinimumJerkOfTheHand) {
  // The lag behind a spring is a (w T)^-2 part of the profile: 1e9 N/m leaves 1e-8.
  const experiment::Experiment stiff = makeChain(2, 0.5, 1e9, 1);
  const auto jerk = predict(stiff, MinHandJerk);
  EXPECT_LT(difference(
                1, [](double t) { return minimumJerkVelocity(0.2, 1, t); }, handOf(*jerk)),
            1e-6);
  EXPECT_NEAR(jerk->cost / (720 * 0.04), 1, 1e-6);
  EXPECT_NEAR(predict(stiff, MinComAcceleration)->cost / (12 * 0.04), 1, 1e-6);
}

TEST(Laws, HeavyHandTurnsForceChangeIntoHandJerk) {
  constexpr double kHeavy = 1e6;  // [kg] against 3: leaves 3e-6
  const auto force = predictWith(chainModerate(), MinHandForceChange, kHeavy), jerk = predict(chainModerate(), MinHandJerk);
  EXPECT_NEAR(force->cost / (kHeavy * kHeavy * jerk->cost), 1, 1e-4);
  EXPECT_LT(difference(1.35, handOf(*jerk), handOf(*force)), 1e-4);
}

TEST(Laws, DistanceScalesProfilesAndCosts) {
  experiment::Experiment twice = chainModerate();
  twice.constraint.shape["length_m"] = 0.4;
  const auto one = predict(chainModerate(), MinHandJerk), two = predict(twice, MinHandJerk);
  EXPECT_NEAR(two->cost / one->cost, 4, 4 * kSame);
  EXPECT_NEAR(two->handPeak / one->handPeak, 2, 2 * kSame);
}

TEST(EndJumps, AreThePublishedNumbers) {
  EXPECT_NEAR(*predict(chainModerate(), MinHandForce)->handJump, 3.6e-3, kTwoDigits * 3.6e-3);
  EXPECT_NEAR(*predict(dingwell(), MinHandForce)->handJump, 16.5e-3, kTwoDigits * 16.5e-3);
  EXPECT_NEAR(*predict(parallelPair(), MinHandForce)->handJump, 4.7e-3, kTwoDigits * 4.7e-3);
  EXPECT_FALSE(predict(dingwell(), MinHandForce)->handVelocityJump.has_value());
  experiment::Experiment pair = parallelPair();
  EXPECT_NEAR(*predict(chainModerate(), MinHandForceChange)->handVelocityJump, 0.0228, kTwoDigits * 0.0228);
  EXPECT_NEAR(*predict(dingwell(), MinHandForceChange)->handVelocityJump, 0.122, kTwoDigits * 0.122);
  EXPECT_NEAR(*predict(pair, MinHandForceChange)->handVelocityJump, 0.0140, kTwoDigits * 0.0140);
  EXPECT_EQ(*predict(pair, MinHandForceChange)->handJump, 0);
  EXPECT_EQ(*predictWith(pair, MinHandForceChange, 1)->handVelocityJump, 0);
}

TEST(EqualFrequencies, AreMergedAndSaidSo) {
  const auto merged = predict(makeParallel({3, 3}, {50, 50}, 2.5), MinHandJerk);
  EXPECT_NEAR(merged->cost, 0.34971, kFiveDigits);
  EXPECT_NEAR(merged->handPeak, 0.13407, kFiveDigits);
  ASSERT_EQ(merged->warnings.size(), 1u);
  EXPECT_TRUE(holds(merged->warnings[0], "equal frequencies"));
  EXPECT_EQ(massVelocity(*merged, 0, 1.0), massVelocity(*merged, 1, 1.0));
}

TEST(Refusals, SayWhyNothingCanBeComputed) {
  EXPECT_THROW(predict(makeChain(20, 0.15, 60, 1.35), MinHandJerk), RefusedError);
  EXPECT_THROW(predict(makeChain(400, 0.6, 600, 1.35), MinHandJerk), RefusedError);
  EXPECT_THROW(predict(makeChain(400, 0.6, 600, 1.35), MinCrackle), RefusedError);
  EXPECT_THROW(predict(makeChain(5, 0.6, 0, 1.35), MinHandForce), RefusedError);
  EXPECT_TRUE(holds(refusalOf([&] { (void)predict(makeParallel({3, 3}, {50, 0}, 2.5), MinHandJerk); }), "spring 2 is 0 N/m"));
  experiment::Experiment stiff = chainModerate();
  for (double& b : stiff.object.damping) b = 1e9;
  EXPECT_THROW(predict(stiff, MinHandJerk), RefusedError);
}

TEST(Warnings, NameTravelTimeAndCondition) {
  const auto hurried = predict(makeChain(10, 0.3, 60, 1.35), MinHandJerk);
  ASSERT_EQ(hurried->warnings.size(), 2u);
  EXPECT_NEAR(*hurried->travelTime, 2 * 10 * std::sqrt(0.3 / 60), 1e-12);
  EXPECT_NEAR(std::abs(hurried->handPeak), 3268, 1);  // docs/theory/criteria.md, "When the time is too short"
  EXPECT_TRUE(predict(chainModerate(), MinHandJerk)->warnings.empty());
  EXPECT_NEAR(*predict(chainModerate(), MinHandJerk)->travelTime, 0.316, 0.0005);
  EXPECT_FALSE(predict(parallelPair(), MinHandJerk)->travelTime.has_value());
}

TEST(Warnings, OfAFreeArmAreOfAHandThatCarriesNothing) {
  experiment::Experiment free = experiment::readExperiment("free-point");
  PredictOptions quick;
  quick.duration = 0.07;
  EXPECT_FALSE(predict(free, MinTorqueChange, quick)->travelTime.has_value());
  const auto warningsWith = [&](const PredictOptions& how) {
    std::string all;
    const auto prediction = predict(free, MinTorqueChange, how);
    for (const std::string& warning : prediction->warnings) all += warning + '\n';
    return all;
  };
  PredictOptions heavy, light;
  heavy.handMass = 5;
  light.handMass = 0;
  EXPECT_TRUE(holds(warningsWith(heavy), "hand mass and hand damping have no part"));
  EXPECT_FALSE(holds(warningsWith(light), "hand mass"));
  free.environment.push_back({experiment::ViscousForce{}});
  EXPECT_TRUE(holds(warningsWith(light), "its forces are no part of the prediction"));
}

TEST(Names, AreReadBack) {
  for (const Criterion criterion : kAllCriteria) EXPECT_EQ(criterionFromName(nameOf(criterion)), criterion);
  EXPECT_FALSE(criterionFromName("min-effort").has_value());
}

}  // namespace
}  // namespace reachlab::predict
