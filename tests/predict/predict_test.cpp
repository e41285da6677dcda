// What every prediction promises whatever it is of, and what is refused.
#include "sim/predict/predict.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/fault.h"
#include "sim/predict/line/line_object.h"
#include "sim/predict/line/line_predictions.h"
#include "sim/predict/peaks.h"
#include "tests/predict/objects.h"
#include "tests/refusal.h"

namespace reachlab::predict {
namespace {

using enum Criterion;

experiment::Experiment unevenlyDamped(experiment::Experiment e) {
  for (std::size_t i = 0; i < e.object.damping.size(); ++i) e.object.damping[i] = 1.5 + static_cast<double>(i);
  if (e.coupling) e.coupling->damping = 3;
  e.object.viscosity = 0.4;
  return e;
}

experiment::Experiment unevenChain() {
  experiment::Experiment e = makeChain(3, 1, 100, 1.5);
  e.object.masses = {0.5, 1, 1.4};
  e.object.stiffness = {300, 500};
  e.coupling->stiffness = 700;
  return e;
}

struct Family {
  std::string name;
  std::function<std::unique_ptr<Prediction>()> make;
};
std::vector<Family> families() {
  std::vector<Family> all;
  for (const Criterion c : {MinHandJerk, MinCrackle, MinHandForce, MinHandForceChange, MinComAcceleration, MinHandCrackle}) {
    const std::string name(nameOf(c));
    const PredictOptions heavy{.handMass = 0.8, .handDamping = 2};
    all.push_back({"chain " + name, [=] { return predict(unevenChain(), c); }});
    all.push_back({"pair with hand " + name, [=] { return predict(parallelPair(), c, heavy); }});
    all.push_back({"damped chain " + name, [=] { return predict(unevenlyDamped(unevenChain()), c, heavy); }});
  }
  for (const Criterion c : {MinHandForce, MinHandForceChange})
    all.push_back({"damped chain, massless hand " + std::string(nameOf(c)), [=] { return predict(unevenlyDamped(unevenChain()), c); }});
  all.push_back({"damped pair", [] { return predict(unevenlyDamped(parallelPair()), MinHandForceChange); }});
  all.push_back({"merged", [] { return predict(makeParallel({3, 1, 2}, {60, 20, 90}, 2), MinHandJerk); }});
  all.push_back({"hand", [] { return predict(makeChain(1, 2, 600, 1.3), MinHandJerk, asHand()); }});
  all.push_back({"hand by force", [] { return predict(makeChain(1, 2, 600, 1.3), MinHandForce, asHand()); }});
  all.push_back({"arm", [] { return predict(dingwell(), MinTorqueChange); }});
  all.push_back({"free arm", [] { return predict(freely(dingwell(), {-0.1, 0, 0}, {0.15, 0, -0.08}), MinTorqueChange); }});
  all.push_back({"curve", [] {
                   return predict(onCurve(makeChain(1, 1, 600, 1.2), {"0.1*cos(phi)", "0.06*sin(phi)", "0.02*phi"}, 0.3, 2), MinHandJerk);
                 }});
  all.push_back({"object on a curve", [] {
                   return predict(onCurve(unevenlyDamped(unevenChain()), {"0.1*cos(phi)", "0.06*sin(phi)", "0"}, 0.3, 2), MinHandJerk);
                 }});
  all.push_back(
      {"surface", [] {
         return predict(onSurface(makeChain(1, 1, 600, 1.2), {"0.1*u", "0.1*v", "0.03*u*v"}, {-0.5, 0.2}, {0.7, 0.9}), MinHandJerk);
       }});
  return all;
}

// Slopes by Richardson's rule of central differences.
double slope(const std::function<double(double)>& f, double t, double h) {
  const auto central = [&](double by) { return (f(t + by) - f(t - by)) / (2 * by); };
  return (4 * central(h / 2) - central(h)) / 3;
}

TEST(Predictions, VelocityAndAccelerationAreTheSlopesOfThePosition) {
  for (const Family& family : families()) {
    const auto p = family.make();
    const double T = p->duration, h = 1e-3 * T, size = std::abs(p->handPeak);
    const auto n = static_cast<std::size_t>(p->massCount());
    std::vector<double> x(n), v(n);
    const auto mass = [&](std::size_t m, double t) {
      p->massesAt(t, x, v);
      return x[m];
    };
    for (const double part : {0.11, 0.37, 0.5, 0.83}) {
      const double t = part * T;
      const PredictedHand at = p->handAt(t);
      EXPECT_NEAR(slope([&](double s) { return p->handAt(s).position; }, t, h), at.velocity, 1e-6 * size) << family.name << part;
      EXPECT_NEAR(slope([&](double s) { return p->handAt(s).velocity; }, t, h), at.acceleration, 1e-5 * size / T * 10)
          << family.name << part;
      for (std::size_t m = 0; m < n; ++m) {
        const double rate = slope([&](double s) { return mass(m, s); }, t, h);
        p->massesAt(t, x, v);
        EXPECT_NEAR(rate, v[m], 1e-6 * size) << family.name << part << " mass " << m;
      }
    }
  }
}

TEST(Predictions, PeaksAreTheLargestVelocitiesThatSamplingFinds) {
  for (const Family& family : families()) {
    const auto p = family.make();
    constexpr int kSamples = 2000;
    double hand = 0, object = 0;
    for (int i = 0; i <= kSamples; ++i) {
      const double t = p->duration * i / kSamples;
      hand = std::max(hand, std::abs(p->handAt(t).velocity));
      object = std::max(object, std::abs(p->objectVelocityAt(t)));
    }
    EXPECT_GE(std::abs(p->handPeak), hand * (1 - 1e-9)) << family.name;
    EXPECT_NEAR(std::abs(p->handPeak), hand, 1e-4 * hand) << family.name;
    EXPECT_NEAR(p->handAt(p->handPeakTime).velocity, p->handPeak, 1e-9 * hand) << family.name;
    EXPECT_GE(std::abs(p->objectPeak), object * (1 - 1e-9)) << family.name;
    EXPECT_NEAR(std::abs(p->objectPeak), object, 1e-4 * object) << family.name;
  }
}

TEST(Predictions, SampledVelocitiesAreThoseOfEachTime) {
  for (const Family& family : families()) {
    const auto p = family.make();
    std::vector<double> x(static_cast<std::size_t>(p->massCount())), v(x.size());
    for (const std::size_t count : {2, 3, 18, 61}) {
      std::vector<double> hand(count, -9), object(count, -9);
      p->sampleVelocities(hand, object);
      for (std::size_t i = 1; i + 1 < count; ++i) {
        const double t = p->duration * static_cast<double>(i) / static_cast<double>(count - 1);
        EXPECT_NEAR(hand[i], p->handAt(t).velocity, 1e-9 * std::abs(p->handPeak)) << family.name << i;
        EXPECT_NEAR(object[i], p->objectVelocityAt(t), 1e-9 * std::abs(p->handPeak)) << family.name << i;
        p->massesAt(t, x, v);
        EXPECT_NEAR(p->objectVelocityAt(t), v.back(), 1e-12) << family.name << i;
      }
      for (const std::size_t end : {std::size_t{0}, count - 1}) {
        const double t = end == 0 ? 0 : p->duration;
        EXPECT_NEAR(hand[end], p->handAt(t).velocity, 1e-9 * std::abs(p->handPeak)) << family.name;
        EXPECT_NEAR(object[end], p->objectVelocityAt(t), 1e-9 * std::abs(p->handPeak)) << family.name;
      }
    }
  }
}

// Every mass goes from rest at the start to rest at the target, and says so of the way's length.
TEST(Predictions, MassesGoFromRestToRestOverTheDistance) {
  for (const Family& family : families()) {
    const auto p = family.make();
    const auto n = static_cast<std::size_t>(p->massCount());
    std::vector<double> x(n), v(n);
    for (const bool end : {false, true}) {
      p->massesAt(end ? p->duration : 0, x, v);
      for (std::size_t m = 0; m < n; ++m) {
        EXPECT_NEAR(x[m], end ? p->distance : 0, 1e-9) << family.name;
        EXPECT_NEAR(v[m], 0, 1e-8) << family.name;
      }
    }
    EXPECT_GT(p->cost, 0) << family.name;
    EXPECT_GE(p->condition, 0) << family.name;
    EXPECT_GT(p->distance, 0) << family.name;
  }
}

// The jump of place or speed at the beginning is what the profile itself has at 0+; by symmetry it ends with the like.
TEST(Predictions, EndJumpsAreThoseOfTheProfile) {
  for (const Family& family : families()) {
    const auto p = family.make();
    if (p->handJump) {
      EXPECT_NEAR(p->handAt(0).position, *p->handJump, 1e-9) << family.name;
    }
    if (p->handVelocityJump) {
      EXPECT_NEAR(p->handAt(0).velocity, *p->handVelocityJump, 1e-8) << family.name;
    }
  }
}

// Without damping the movement back is the movement there in reverse, whatever it is on; so is how well it is determined.
TEST(Predictions, TheWayBackIsTheWayThereInReverse) {
  experiment::Experiment still = dingwell();
  still.arm.damping = {0, 0};
  still.arm.shoulder = {-0.2, -0.3};
  const auto surface = onSurface(makeChain(1, 1, 600, 1.2), {"0.1*u", "0.1*v", "0.03*u*v + 0.01*u^3"}, {-0.5, 0.2}, {0.7, 0.9});
  struct Way {
    experiment::Experiment experiment;
    Criterion criterion;
  };
  for (const Way& way :
       {Way{still, MinTorqueChange}, Way{freely(still, {-0.1, 0, 0}, {0.05, 0, -0.08}), MinTorqueChange}, Way{surface, MinHandJerk},
        Way{onCurve(makeChain(1, 1, 600, 1.2), {"0.1*cos(phi)", "0.06*sin(phi)", "0.02*phi^2"}, 0.3, 2), MinHandJerk},
        Way{onCurve(unevenChain(), {"0.1*cos(phi)", "0.06*sin(phi)", "0.02*phi"}, 0.3, 2), MinHandJerk}}) {
    const PredictOptions options{.unknowns = 36};
    experiment::Experiment back = way.experiment;
    std::swap(back.task->start, back.task->target);
    const auto there = predict(way.experiment, way.criterion, options), again = predict(back, way.criterion, options);
    EXPECT_NEAR(again->cost / there->cost, 1, 1e-8);
    EXPECT_NEAR(again->condition / there->condition, 1, 0.15) << "an estimate";
    EXPECT_NEAR(again->distance, there->distance, 1e-9);
    for (const double part : {0.1, 0.4, 0.7})
      EXPECT_NEAR(again->handAt(part * there->duration).velocity, there->handAt((1 - part) * there->duration).velocity, 1e-7)
          << nameOf(way.criterion);
  }
}

MadePrediction sines(double seconds, double a, double wa, double b, double wb, double phase = 0) {
  return {seconds, [=](double t) { return a * std::sin(wa * t + phase) + b * std::sin(wb * t); }, std::max(wa, wb),
          [=](double t) { return a * wa * std::cos(wa * t + phase) + b * wb * std::cos(wb * t); }};
}

TEST(Peaks, LieBetweenTheSamplesToTheLastDigits) {
  MadePrediction p = sines(1.7, 0.4, 2.9, 0, 1);
  findPeaks(p);
  EXPECT_NEAR(p.handPeak, 0.4, 1e-15);
  EXPECT_NEAR(p.handPeakTime, std::numbers::pi / 2 / 2.9, 1e-9);
  EXPECT_NEAR(p.objectPeak, -1.2, 1e-12) << "of the last mass, with its sign";
}

TEST(Peaks, AreWithTheirSignAndTheEarliestOfEqualOnes) {
  MadePrediction back = sines(1, -0.7, 2 * std::numbers::pi, 0, 1);
  findPeaks(back);
  EXPECT_NEAR(back.handPeak, -0.7, 1e-12);
  EXPECT_NEAR(back.handPeakTime, 0.25, 1e-9);
  MadePrediction later = sines(1, 0.7, 3 * std::numbers::pi, -0.2, std::numbers::pi);  // 0.5 in the middle of the first half, -0.9 at 0.5
  findPeaks(later);
  EXPECT_NEAR(later.handPeakTime, 0.5, 1e-9);
  EXPECT_NEAR(later.handPeak, -0.9, 1e-12);
}

TEST(Peaks, MayStandAtTheVeryEnds) {
  MadePrediction falling(
      2, [](double t) { return 3 - t; }, 1, [](double) { return -1.0; });
  findPeaks(falling);
  EXPECT_EQ(falling.handPeak, 3);
  EXPECT_EQ(falling.handPeakTime, 0);
  EXPECT_EQ(falling.objectPeak, -9);
  MadePrediction rising(
      2, [](double t) { return 0.5 + t; }, 1, [](double) { return 1.0; });
  findPeaks(rising);
  EXPECT_EQ(rising.handPeak, 2.5);
  EXPECT_EQ(rising.handPeakTime, 2);
}

// Samples 48 to the second and more with the fastest frequency: an inner maximum between two that are lower at their samples.
TEST(Peaks, AreFoundAmongWavesOfTheFastestFrequency) {
  MadePrediction p = sines(1, 1, std::numbers::pi, 0.3, 211);
  findPeaks(p);
  double most = 0;
  for (int i = 0; i <= 200'000; ++i) most = std::max(most, std::abs(p.handAt(i / 200'000.0).velocity));
  EXPECT_NEAR(p.handPeak, most, 1e-6);
  EXPECT_GE(p.handPeak, most);
  EXPECT_EQ(p.scanCount(), 48 + 253);
}

// Nothing hangs on the hand, so the hand's own movement is the object's in every table and figure.
TEST(HandAlone, IsItsOwnObjectUnderEveryCriterion) {
  const experiment::Experiment e = experiment::readExperiment("curl-field");
  for (const Criterion criterion : {MinHandJerk, MinTorqueChange, MinCrackle, MinHandForce, MinHandForceChange, MinComAcceleration}) {
    const auto prediction = predict(e, criterion);
    EXPECT_NEAR(prediction->objectPeak, prediction->handPeak, 1e-12) << nameOf(criterion);
    EXPECT_NEAR(prediction->objectVelocityAt(0.3), prediction->handAt(0.3).velocity, 1e-12) << nameOf(criterion);
  }
}

#define EXPECT_REFUSED(words, ...) EXPECT_TRUE(holds(refusalOf([&] { (void)(__VA_ARGS__); }), words))

TEST(PredictRefusals, OfATaskThatIsNone) {
  experiment::Experiment e = dingwell();
  e.task.reset();
  EXPECT_REFUSED("a prediction needs one", predict(e, MinHandJerk));
  e = dingwell();
  e.task->target = {1, 2};
  EXPECT_REFUSED("1 numbers each", predict(e, MinHandJerk));
  EXPECT_REFUSED("3 numbers each", predict(freely(dingwell(), {0}, {1, 0, 0}), MinHandJerk));
  EXPECT_REFUSED("3 numbers each", predict(freely(dingwell(), {0, 0, 0}, {1, 0}), MinHandJerk));
  EXPECT_REFUSED("the same position", predict(freely(dingwell(), {1, 0, 0}, {1, 0, 0}), MinHandJerk));
  PredictOptions options;
  for (const double duration : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    e = dingwell();
    e.task->duration = duration;
    EXPECT_REFUSED("0.001 to 3600 s", predict(e, MinHandJerk));
    options.duration = 1;
    EXPECT_EQ(predict(e, MinHandJerk, options)->duration, 1) << "an option goes before the task's";
  }
  options.duration = std::numeric_limits<double>::infinity();
  EXPECT_REFUSED("0.001 to 3600 s", predict(dingwell(), MinHandJerk, options));
}

TEST(PredictRefusals, OfAnObjectThatTheCriteriaDoNotKnow) {
  experiment::Experiment body = dingwell();
  body.object.kind = experiment::ObjectKind::Body;
  EXPECT_REFUSED("a body that turns", predict(body, MinHandJerk));
  EXPECT_REFUSED("a body that turns", (makeLineObject(body, 0, 0), 0));
  EXPECT_REFUSED("only with an object of kind point", predict(parallelPair(), MinHandJerk, asHand()));
  experiment::Experiment loose = dingwell();
  loose.coupling.reset();
  EXPECT_REFUSED("the spring between hand and object", predict(loose, MinHandJerk));
  experiment::Experiment few = chainModerate();
  few.object.stiffness.pop_back();
  EXPECT_REFUSED("as many springs", predict(few, MinHandJerk));
  experiment::Experiment light = chainModerate();
  light.object.masses[2] = 0;
  EXPECT_REFUSED("mass 3 is 0 kg", predict(light, MinHandJerk));
  experiment::Experiment soft = chainModerate();
  soft.object.stiffness[1] = -4;
  EXPECT_REFUSED("spring (the coupling is number 1) 3 is -4 N/m", predict(soft, MinHandJerk));
  PredictOptions options{.handMass = -1};
  EXPECT_REFUSED("hand_mass", predict(dingwell(), MinHandJerk, options));
  options.handMass = 0;
  options.handDamping = -1;
  EXPECT_REFUSED("hand_damping", predict(dingwell(), MinHandJerk, options));
}

TEST(PredictRefusals, OfAHandThatIsThePoint) {
  EXPECT_REFUSED("a point behind its spring", predict(makeChain(1, 2, 600, 1), MinTorqueChange, asHand()));
  for (const Criterion c : {MinHandForce, MinHandForceChange}) {
    PredictOptions damping = asHand();
    damping.handDamping = 1;
    EXPECT_REFUSED("is computed without damping", predict(makeChain(1, 2, 600, 1), c, damping));
    experiment::Experiment viscous = makeChain(1, 2, 600, 1);
    viscous.object.viscosity = 1;
    EXPECT_REFUSED("is computed without damping", predict(viscous, c, asHand()));
    EXPECT_EQ(refusalOf([&] { (void)predict(viscous, MinHandJerk, asHand()); }), "");
    EXPECT_EQ(refusalOf([&] { (void)predict(makeChain(1, 2, 600, 1), MinComAcceleration, damping); }), "");
  }
}

TEST(PredictRefusals, OfWhatIsDefinedOnALineAlone) {
  const auto bent = onCurve(makeChain(1, 1, 600, 1), {"0.1*cos(phi)", "0.1*sin(phi)", "0"}, 0, 1);
  for (const Criterion c : {MinTorqueChange, MinCrackle, MinHandForce, MinHandForceChange, MinComAcceleration, MinHandCrackle})
    EXPECT_REFUSED(std::string(nameOf(c)) + ": defined on a straight line", predict(bent, c));
  const auto surface = onSurface(chainModerate(), {"0.1*u", "0.1*v", "0.03*u*v"}, {0, 0.2}, {0.7, 0.9});
  EXPECT_REFUSED("what hangs behind a spring needs a curve", predict(surface, MinHandJerk));
  EXPECT_REFUSED("the line must lie along x", predict(onCurve(dingwell(), {"0.1*phi", "0", "0.001*phi"}, -1, 1), MinTorqueChange));
  experiment::Experiment heavy = onCurve(chainModerate(), {"0.1*cos(phi)", "0.1*sin(phi)", "0"}, 0, 1);
  heavy.object.gravity = {0, -9.81, 0};
  EXPECT_REFUSED("gravity has", predict(heavy, MinHandJerk));
}

TEST(PredictRefusals, OfAnArmThatDoesNotReach) {
  const auto straight = [](double from, double to) {
    experiment::Experiment e = freely(dingwell(), {from, 0, 0}, {to, 0, 0});
    e.arm.shoulder = {0, 0};
    return e;
  };
  // Links of 0.25 and 0.35 m: from 0.1 to 0.6 m, less a millimetre at either end.
  EXPECT_REFUSED("the arm cannot reach: the hand would be 0.600 m from the shoulder, the arm spans 0.100 to 0.600 m",
                 predict(straight(0.3, 0.5995), MinTorqueChange));
  EXPECT_REFUSED("the hand would be 0.100 m", predict(straight(0.1004, 0.5), MinTorqueChange));
  EXPECT_EQ(refusalOf([&] { (void)predict(straight(0.3, 0.5), MinTorqueChange); }), "");
  experiment::Experiment before = dingwell();  // both ends within reach, and the middle of the line too near
  before.arm.shoulder = {0, -0.05};
  EXPECT_REFUSED("0.050 m from the shoulder", predict(before, MinTorqueChange));
}

// Up, and partly up: the arm of the criterion knows no height.
TEST(PredictRefusals, OfAWayOutOfTheArmsPlane) {
  for (const double x : {-0.1, 0.0})
    EXPECT_TRUE(holds(refusalOf([=] { predict(freely(dingwell(), {-0.1, 0, 0}, {x, 0.1, 0}), MinTorqueChange); }), "leaves it")) << x;
}

TEST(PredictRefusals, OfACostBeyondTheLargestNumber) {
  experiment::Experiment e = makeChain(60, 0.1, 9000, 3);
  EXPECT_TRUE(holds(refusalOf([&] { predict(e, MinCrackle); }), "beyond the largest number"));
}

TEST(PredictRefusals, OfAnObjectOnACurve) {
  const auto bent = onCurve(chainModerate(), {"0.1*cos(phi)", "0.1*sin(phi)", "0"}, 0, 1);
  PredictOptions options{.unknowns = 10};
  EXPECT_REFUSED("more than 10 here, twice the number of masses", predict(bent, MinHandJerk, options));
  options.unknowns = 14;
  const auto few = predict(bent, MinHandJerk, options);
  const auto chosen = predict(bent, MinHandJerk);
  double differs = 0;
  for (int i = 0; i <= 100; ++i)
    differs = std::max(differs, std::abs(few->handAt(i / 100.0).velocity - chosen->handAt(i / 100.0).velocity));
  ASSERT_TRUE(few->profileError.has_value());
  EXPECT_GT(*few->profileError, 0.3 * differs / chosen->handPeak) << "what is said of few unknowns";
  EXPECT_LT(*few->profileError, 3 * differs / chosen->handPeak);
  ASSERT_TRUE(chosen->profileError.has_value());
  EXPECT_GE(*chosen->profileError, 1e-12);
  EXPECT_LT(*chosen->profileError, 1e-6);
  EXPECT_TRUE(chosen->warnings.empty());
  experiment::Experiment fast = bent;
  fast.object.viscosity = 6000;
  EXPECT_REFUSED("the object is too fast for the movement time", predict(fast, MinHandJerk));
}

TEST(TogetherPrediction, OfSeveralHandsIsThatOfOneBodyThatTheyMove) {
  experiment::Experiment line = dingwell();
  line.hands = {{1, {100}, {1}, {}}, {1, {200}, {1}, {}}};
  const auto p = predict(line, MinHandJerk);
  EXPECT_NEAR(p->cost / (720 * 0.04 / std::pow(1.35, 5)), 1, 1e-12);
  EXPECT_NEAR(p->distance, 0.2, 1e-15);
  EXPECT_EQ(p->point, PointIs::Hand);
  EXPECT_REFUSED("min-hand-force: defined for one hand, and 2 hold the object", predict(line, MinHandForce));
  experiment::Experiment curve = onCurve(line, {"0.1*cos(phi)", "0.1*sin(phi)", "0"}, 0, 2);
  const auto bent = predict(curve, MinHandJerk);
  EXPECT_NEAR(bent->distance, 0.2, 1e-9);
  EXPECT_GT(bent->cost, p->cost);
  line.hands.pop_back();
  EXPECT_EQ(predict(line, MinHandJerk)->point, PointIs::BehindSpring) << "one hand is no several";
}

// Along any straight way, however it is written, the movement is that along the line of the catalogue.
TEST(StraightTasks, AreTheSameMovementHoweverTheLineIsWritten) {
  const auto line = predict(chainModerate(), MinHandForceChange);
  const auto same = [&](const experiment::Experiment& e) {
    const auto p = predict(e, MinHandForceChange);
    EXPECT_NEAR(p->distance, 0.2, 1e-15);
    EXPECT_NEAR(p->cost / line->cost, 1, 1e-12);
    EXPECT_NEAR(p->handPeak / line->handPeak, 1, 1e-12);
    EXPECT_EQ(p->travelTime, line->travelTime);
  };
  same(freely(chainModerate(), {0.3, -0.1, 0.2}, {0.42, -0.1, 0.36}));
  same(onCurve(chainModerate(), {"0.012*phi", "1 - 0.016*phi", "0"}, 3, -7));
  experiment::Experiment back = chainModerate();
  std::swap(back.task->start, back.task->target);
  same(back);
}

TEST(StraightTasks, GravityAlongTheWayIsSaid) {
  experiment::Experiment e = chainModerate();
  EXPECT_TRUE(predict(e, MinHandJerk)->warnings.empty());
  e.object.gravity = {0, -9.81, 0};
  EXPECT_TRUE(predict(e, MinHandJerk)->warnings.empty()) << "across the way";
  for (const double along : {-9.81, 1.0}) {
    e.object.gravity = {along, 0, 0};
    const auto p = predict(e, MinHandJerk);
    ASSERT_EQ(p->warnings.size(), 1u);
    EXPECT_TRUE(holds(p->warnings[0], "gravity along the line shifts the rest position"));
  }
}

TEST(StraightTasks, ForcesOnTheHandAreSaid) {
  experiment::Experiment e = makeChain(2, 1, 300, 1.3);
  e.environment = {{experiment::ChannelForce{}}};
  EXPECT_TRUE(predict(e, MinHandJerk)->warnings.empty()) << "its cost has no force";
  ASSERT_EQ(predict(e, MinHandForce)->warnings.size(), 1u);
  EXPECT_TRUE(holds(predict(e, MinHandForce)->warnings[0], "environment"));
}

TEST(TravelTime, IsTwiceTheSumOfEachMasssOnItsSpring) {
  experiment::Experiment e = unevenChain();
  const double once = std::sqrt(0.5 / 700) + std::sqrt(1.0 / 300) + std::sqrt(1.4 / 500);
  EXPECT_NEAR(*predict(e, MinHandJerk)->travelTime, 2 * once, 1e-15);
  PredictOptions options{.duration = 2 * once * 1.0001};
  EXPECT_TRUE(predict(e, MinHandJerk, options)->warnings.empty());
  options.duration = 2 * once * 0.9999;
  const auto hurried = predict(e, MinHandJerk, options);
  ASSERT_EQ(hurried->warnings.size(), 1u);
  EXPECT_TRUE(holds(hurried->warnings[0], "shorter than a wave's way"));
}

// Masses of the same frequency, decay and drag are one mass of their sum; each is told by where it stands in the experiment.
TEST(EqualFrequencies, OfMassesThatDifferAreOneMassOfTheirSum) {
  experiment::Experiment e = makeParallel({3, 1, 2, 1}, {60, 20, 90, 45}, 2);
  e.object.damping = {0.6, 0.2, 1, 0.5};
  std::vector<std::string> warnings;
  const LineObject merged = mergeEqualFrequencies(makeLineObject(e, 0.7, 0.3), 2, warnings);
  EXPECT_EQ(merged.masses, (std::vector<double>{4, 3}));
  EXPECT_EQ(merged.springs, (std::vector<double>{80, 135}));
  ASSERT_EQ(merged.dampers.size(), 2u);
  EXPECT_NEAR(merged.dampers[0], 0.8, 1e-15);
  EXPECT_NEAR(merged.dampers[1], 1.5, 1e-15);
  EXPECT_EQ(merged.source, (std::vector<int>{0, 0, 1, 1}));
  EXPECT_EQ(merged.handMass, 0.7);
  EXPECT_EQ(merged.handDamping, 0.3);
  EXPECT_NEAR(merged.totalMass(), 7.7, 1e-15);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(holds(warnings[0], "masses 1 and 2 have equal frequencies (4.47214 rad/s)"));
  EXPECT_TRUE(holds(warnings[1], "masses 3 and 4 have equal frequencies (6.7082 rad/s)"));
  e.object.damping = {0.6, 0.3, 1, 0.5};  // one decays faster: it moves for itself
  warnings.clear();
  EXPECT_EQ(mergeEqualFrequencies(makeLineObject(e, 0, 0), 2, warnings).count(), 3);
  EXPECT_EQ(warnings.size(), 1u);
  warnings.clear();
  EXPECT_EQ(mergeEqualFrequencies(makeLineObject(makeChain(3, 1, 50, 1), 0, 0), 2, warnings).count(), 3) << "a chain's are never one";
  EXPECT_TRUE(warnings.empty());
}

TEST(LineObject, IsTheExperimentsSpringsFromTheHandOn) {
  experiment::Experiment e = unevenChain();
  e.object.damping = {4, 6};
  e.coupling->damping = 2;
  e.object.viscosity = 0.3;
  const LineObject object = makeLineObject(e, 0.2, 0.1);
  EXPECT_FALSE(object.parallel);
  EXPECT_EQ(object.count(), 3);
  EXPECT_EQ(object.springs, (std::vector<double>{700, 300, 500}));
  EXPECT_EQ(object.dampers, (std::vector<double>{2, 4, 6}));
  EXPECT_EQ(object.viscosity, (std::vector<double>{0.3, 0.3, 0.3}));
  EXPECT_EQ(object.source, (std::vector<int>{0, 1, 2}));
  EXPECT_NEAR(object.totalMass(), 3.1, 1e-15);
  LineObject still = makeLineObject(unevenChain(), 0.2, 0);
  EXPECT_FALSE(still.damped(true));
  still.handDamping = 1;
  EXPECT_TRUE(still.damped(true));
  EXPECT_FALSE(still.damped(false));
  still.viscosity[1] = 0.1;
  EXPECT_TRUE(still.damped(false));
  still.viscosity[1] = 0;
  still.dampers[2] = 0.1;
  EXPECT_TRUE(still.damped(false));
}

// A hand that is given by `hands` holds by its own spring; where it holds another mass the criteria are not defined.
TEST(LineObject, TakesTheSpringsOfTheOneHand) {
  experiment::Experiment e = unevenChain();
  e.hands = {{.mass = 1, .stiffness = {900}, .damping = {7}, .fpOffset = {}}};
  const LineObject chain = makeLineObject(e, 0, 0);
  EXPECT_EQ(chain.springs, (std::vector<double>{900, 300, 500}));
  EXPECT_EQ(chain.dampers[0], 7);
  e.hands[0].mass = 2;
  EXPECT_TRUE(holds(refusalOf([&] { makeLineObject(e, 0, 0); }), "hands[0].mass: is 2"));
  experiment::Experiment pair = parallelPair();
  pair.hands = {{.mass = 0, .stiffness = {11, 12}, .damping = {1, 2}, .fpOffset = {}}};
  EXPECT_EQ(makeLineObject(pair, 0, 0).springs, (std::vector<double>{11, 12}));
}

TEST(RigidPrediction, EveryCriterionHasItsPolynomial) {
  constexpr double kMass = 3, kWay = 0.4, kTime = 1.7;
  const auto make = [&](Criterion c) { return makeRigidPrediction(kMass, c, kWay, kTime); };
  const double square = kWay * kWay;
  EXPECT_NEAR(make(MinHandJerk)->cost / (720 * square / std::pow(kTime, 5)), 1, 1e-12);
  EXPECT_NEAR(make(MinHandForce)->cost / (12 * kMass * kMass * square / std::pow(kTime, 3)), 1, 1e-12);
  EXPECT_NEAR(make(MinHandForceChange)->cost / (720 * kMass * kMass * square / std::pow(kTime, 5)), 1, 1e-12);
  EXPECT_NEAR(make(MinComAcceleration)->cost / (12 * square / std::pow(kTime, 3)), 1, 1e-12);
  for (const double s : {0.1, 0.45, 0.8}) {
    EXPECT_NEAR(make(MinHandJerk)->handAt(s * kTime).velocity, kWay / kTime * 30 * s * s * (1 - s) * (1 - s), 1e-12);
    EXPECT_NEAR(make(MinHandForce)->handAt(s * kTime).velocity, kWay / kTime * 6 * s * (1 - s), 1e-12);
    EXPECT_NEAR(make(MinHandForce)->handAt(s * kTime).position, kWay * s * s * (3 - 2 * s), 1e-12);
    EXPECT_NEAR(make(MinHandForce)->handAt(s * kTime).acceleration, kWay / (kTime * kTime) * 6 * (1 - 2 * s), 1e-12);
  }
}

// What is found by iteration for one time starts from those of others, and comes to the same movement; where those have too few unknowns it
// starts for itself.
TEST(NearPredictions, LeadToTheSameMovement) {
  const auto alone = predict(dingwell(), MinTorqueChange);
  for (const int unknowns : {12, 54}) {
    std::vector<std::unique_ptr<Prediction>> around;
    PredictOptions options{.unknowns = unknowns};
    for (const double duration : {1.2, 1.3, 1.45, 1.5}) {
      options.duration = duration;
      around.push_back(predict(dingwell(), MinTorqueChange, options));
      EXPECT_EQ(around.back()->unknowns.size(), static_cast<std::size_t>(unknowns));
    }
    std::vector<const Prediction*> near;
    for (const auto& p : around) near.push_back(p.get());
    const auto line = predict(dingwell(), MinHandJerk);
    near.push_back(line.get());  // was not found by iteration, and has nothing to give
    options = {};
    options.near = near;
    const auto led = predict(dingwell(), MinTorqueChange, options);
    EXPECT_EQ(led->unknowns.size() == static_cast<std::size_t>(unknowns), unknowns == 54);
    EXPECT_EQ(led->profileError.has_value(), unknowns == 12) << "of one number of unknowns none is known";
    EXPECT_NEAR(led->cost / alone->cost, 1, 1e-8);
    for (int i = 0; i <= 20; ++i) EXPECT_NEAR(led->handAt(1.35 * i / 20).velocity, alone->handAt(1.35 * i / 20).velocity, 1e-8);
  }
}

}  // namespace
}  // namespace reachlab::predict
