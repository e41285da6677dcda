#include "analysis/measures/movement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/measures/measures.h"

namespace reachlab::analysis {
namespace {

constexpr double kSpeedRate = 100;

std::vector<double> bell(double before, double duration, double after, double height = 0.3) {
  std::vector<double> v;
  for (int i = 0; i <= static_cast<int>(std::lround((before + duration + after) * kSpeedRate)); ++i) {
    const double s = (i / kSpeedRate - before) / duration;
    v.push_back(s < 0 || s > 1 ? 0 : height * 16 * s * s * (1 - s) * (1 - s));
  }
  return v;
}

TEST(FindMovement, SaysWhereTheSignalBeginsOrEndsTooSoon) {
  std::vector<double> v = bell(0, 1, 0);
  v.erase(v.begin(), v.begin() + 30);
  v.resize(v.size() - 30);
  const Movement m = findMovement(v, kSpeedRate, {});
  EXPECT_TRUE(m.found);
  EXPECT_DOUBLE_EQ(m.onset, 0);
  EXPECT_DOUBLE_EQ(m.offset, static_cast<double>(v.size() - 1) / kSpeedRate);
}

// Of a hand that trembles, 5 % of the peak speed is passed at once and at last: the whole trial would be its movement.
TEST(FindMovement, FindsNoneWhereTheTrialEndedBecauseTheHandNeverLeft) {
  TrialData trial;
  trial.rate = kSpeedRate;
  for (int i = 0; i < 200; ++i) {
    trial.hand.push_back({2e-5 * std::sin(60.0 * i / kSpeedRate), 0, 0});
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

/// Up from 0 at `begin` to `height` at `top` and down to 0 at `end` in straight lines; samples.
std::vector<double> tent(std::size_t samples, double begin, double top, double end, double height = 1) {
  std::vector<double> v;
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i);
    v.push_back(std::max(0.0, height * std::min((t - begin) / (top - begin), (end - t) / (end - top))));
  }
  return v;
}

OnsetOptions above(double speed, double holdSeconds = 0.04) {
  OnsetOptions options;
  options.rule = OnsetRule::Absolute;
  options.speed = speed;
  options.holdSeconds = holdSeconds;
  return options;
}

TEST(FindMovement, BeginsAndEndsOnASampleThatIsAtTheThreshold) {
  const std::vector<double> v{0, 0, 0.25, 0.5, 1, 0.75, 0.25, 0, 0};
  const Movement m = findMovement(v, 1, above(0.25, 0));
  EXPECT_EQ(m.onset, 2);
  EXPECT_EQ(m.offset, 6);
}

TEST(FindMovement, NeedsAPeakAboveTheThreshold) {
  const std::vector<double> v{0, 0.5, 1, 0.5, 0};
  EXPECT_FALSE(findMovement(v, 10, above(1)).found);
  EXPECT_TRUE(findMovement(v, 10, above(0.999)).found);
  OnsetOptions whole;
  whole.percent = 100;
  EXPECT_FALSE(findMovement(v, 10, whole).found);
  EXPECT_FALSE(findMovement(std::vector<double>{1, 2}, 10, {}).found) << "two samples are none";
  EXPECT_TRUE(findMovement(std::vector<double>{0, 2, 0}, 10, {}).found);
}

// 40 ms at 100 Hz are four samples above the threshold; the movement itself may be shorter.
TEST(FindMovement, EndsAfterTheLastStretchThatIsHeld) {
  const auto offsetWith = [](std::size_t samples, double hold) {
    std::vector<double> v = tent(60, 5, 10, 15);
    for (std::size_t i = 30; i < 30 + samples; ++i) v[i] = 0.5;
    return findMovement(v, kSpeedRate, above(0.25, hold)).offset;
  };
  EXPECT_NEAR(offsetWith(3, 0.04), 0.1375, 1e-12) << "a twitch";
  EXPECT_NEAR(offsetWith(4, 0.04), 0.335, 1e-12);
  EXPECT_NEAR(offsetWith(1, 0), 0.305, 1e-12) << "whatever is asked for, a sample is enough";
  EXPECT_NEAR(offsetWith(3, OnsetOptions{}.holdSeconds), 0.1375, 1e-12);
  EXPECT_NEAR(findMovement(tent(30, 5, 6, 7), kSpeedRate, above(0.5, 0.04)).offset, 0.065, 1e-12) << "two samples are the movement";
}

// The first hump that reaches half the peak begins the movement, though the hand rested between the two.
TEST(FindMovement, BeginsWithTheFirstHumpOfHalfThePeak) {
  const auto onsetOf = [](double first) {
    std::vector<double> v = tent(80, 5, 15, 25, first);
    const std::vector<double> second = tent(80, 40, 50, 60, 2);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += second[i];
    return findMovement(v, kSpeedRate, above(0.1)).onset;
  };
  EXPECT_NEAR(onsetOf(1), 0.06, 1e-12);
  EXPECT_NEAR(onsetOf(0.99), 0.405, 1e-12);
}

TEST(MovementWithin, LooksForThePeakInsideTheWindowAlone) {
  const std::vector<double> v{9, 1, 2, 5, 3, 2, 8, 9};
  const Movement m = movementWithin(v, 10, 0.1, 0.5);
  EXPECT_TRUE(m.found);
  EXPECT_EQ(m.onset, 0.1);
  EXPECT_EQ(m.offset, 0.5);
  EXPECT_EQ(m.peak, 5);
  EXPECT_NEAR(m.peakTime, 0.3 + 0.05 * (2.0 - 3) / (2 - 10 + 3), 1e-12);
  EXPECT_EQ(movementWithin(v, 10, 0.1, 0.599).peak, 5) << "sample 6 is not reached";
  EXPECT_EQ(movementWithin(v, 10, 0.1, 0.6).peak, 8);
  EXPECT_EQ(movementWithin(v, 10, 0.3, 0.5).peak, 5) << "3 is 0.3 times 10 but for rounding";
  EXPECT_EQ(movementWithin(v, 10, 0.301, 0.5).peak, 3);
  EXPECT_EQ(movementWithin(v, 10, -3, 9).peak, 9);
}

TEST(MovementWithin, OfNoWindowIsNone) {
  const std::vector<double> v{0, 1, 2, 1, 0};
  EXPECT_FALSE(movementWithin(v, 10, 0.2, 0.2).found);
  EXPECT_FALSE(movementWithin(v, 10, 0.3, 0.2).found);
  EXPECT_FALSE(movementWithin(v, 10, 0.11, 0.19).found) << "no sample lies in it";
  EXPECT_FALSE(movementWithin(v, 10, 0.16, 0.24).found) << "one alone";
  EXPECT_TRUE(movementWithin(v, 10, 0.16, 0.31).found);
  EXPECT_FALSE(movementWithin(std::vector<double>{0, 1}, 10, 0, 0.1).found);
  EXPECT_FALSE(movementWithin(v, 10, std::nan(""), 0.2).found);
}

TEST(NormaliseTime, LeadsFromTheOnsetToTheOffsetInEvenSteps) {
  std::vector<double> line;
  for (int i = 0; i < 300; ++i) line.push_back(2.0 * i / kSpeedRate);
  const std::vector<double> normal = normaliseTime(line, kSpeedRate, 0.5, 1.75);
  for (std::size_t i = 0; i < normal.size(); ++i)
    EXPECT_NEAR(normal[i], 2 * (0.5 + 1.25 * static_cast<double>(i) / static_cast<double>(normal.size() - 1)), 1e-12);
}

}  // namespace
}  // namespace reachlab::analysis
