#include "bench/measure.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/system/os.h"
#include "bench/extrapolation.h"
#include "tests/refusal.h"

namespace reachlab::bench {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Reference threeNumbers() {
  Reference r;
  r.stateSize = 1, r.massCount = 1, r.samples = 3;
  r.states = {1, 2, 3};
  r.positions = {4, 5, 6};
  return r;
}
Trajectory along(std::vector<double> states, std::vector<double> positions) {
  Trajectory t;
  t.states = std::move(states), t.positions = std::move(positions);
  return t;
}

TEST(Measure, TheErrorIsTheLargestDifferenceOfAllNumbers) {
  const Deviation d = computeError(along({1, 2.25, 3.125}, {4.5, 5, 5.75}), threeNumbers());
  EXPECT_EQ(d.state, 0.25);
  EXPECT_EQ(d.position, 0.5);
  EXPECT_EQ(computeError(along({1, 2, 2}, {4, 5, 6}), threeNumbers()).state, 1) << "less counts as more does";
  EXPECT_EQ(computeError(along({1, 2, 3}, {4, 5, 6}), threeNumbers()).position, 0);
}

TEST(Measure, WhatIsNotThereHasNoError) {
  EXPECT_TRUE(std::isnan(computeError(along({1, 2}, {4, 5, 6}), threeNumbers()).state)) << "it ended early";
  EXPECT_EQ(computeError(along({1, 2}, {4, 5, 6}), threeNumbers()).position, 0);
  EXPECT_TRUE(std::isnan(computeError(along({1, kNan, 3}, {4, 5, 6}), threeNumbers()).state));
  EXPECT_TRUE(std::isnan(computeError(along({1, 2, 3}, {4, 5, INFINITY}), threeNumbers()).position));
  Trajectory failed = along({1, 2, 3}, {4, 5, 6});
  failed.failure = "stopped";
  EXPECT_TRUE(std::isnan(computeError(failed, threeNumbers()).state));
  EXPECT_TRUE(std::isnan(computeError(failed, threeNumbers()).position));
}

/// Counts its runs, and takes some processor time in each.
Contender counting(int& runs, double seconds, const std::string& failure = {}) {
  Contender c;
  c.method = "spin", c.form = "idle", c.step = 2e-3, c.tolerance = 1e-7;
  c.run = [&runs, seconds, failure](Trajectory* out) {
    ++runs;
    const std::int64_t start = os::threadProcessorTime();
    while (static_cast<double>(os::threadProcessorTime() - start) < seconds * 1e9) {}
    if (!out) return;
    out->states = {1, 2.5, 3}, out->positions = {4, 5, 6.25};
    out->steps = 11, out->rhsEvaluations = 22, out->worstTick = 3, out->failure = failure;
  };
  return c;
}
BenchScene tenTicks() {
  BenchScene scene;
  scene.name = "S0";
  scene.duration = 0.01;
  return scene;
}

TEST(Measure, ARowTellsWhatItsContenderDid) {
  int runs = 0;
  const std::vector<Row> rows = measure(tenTicks(), threeNumbers(), {counting(runs, 0)}, {.rounds = 3, .secondsPerRound = 0});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].scene, "S0");
  EXPECT_EQ(rows[0].method, "spin");
  EXPECT_EQ(rows[0].form, "idle");
  EXPECT_EQ(rows[0].step, 2e-3);
  EXPECT_EQ(rows[0].tolerance, 1e-7);
  EXPECT_EQ(rows[0].error.state, 0.5);
  EXPECT_EQ(rows[0].error.position, 0.25);
  EXPECT_EQ(rows[0].steps, 11u);
  EXPECT_EQ(rows[0].rhsEvaluations, 22u);
  EXPECT_EQ(rows[0].worstTick, 3u);
  EXPECT_EQ(rows[0].failure, "");
  EXPECT_EQ(runs, 1 + 1 + 3) << "for the errors, to warm up, and one a round";
}

TEST(Measure, ARowsBitsTellTheLastBitAndTheSignOfZero) {
  const auto bitsOf = [](std::vector<double> states) {
    Contender c;
    c.run = [states](Trajectory* out) {
      if (out) out->states = states;
    };
    return measure(tenTicks(), threeNumbers(), {c}, {.rounds = 1, .secondsPerRound = 0})[0].bits;
  };
  EXPECT_EQ(bitsOf({1, 2, 0.0}), bitsOf({1, 2, 0.0}));
  EXPECT_NE(bitsOf({1, 2, 0.0}), bitsOf({1, 2, -0.0}));
  EXPECT_NE(bitsOf({1, 2, 3}), bitsOf({1, 2, std::nextafter(3, 4)}));
  EXPECT_NE(bitsOf({1, 2, 3}), bitsOf({2, 1, 3}));
}

TEST(Measure, ARoundIsRepeatedUntilItHasTakenItsTime) {
  int runs = 0;
  (void)measure(tenTicks(), threeNumbers(), {counting(runs, 1e-3)}, {.rounds = 2, .secondsPerRound = 9.5e-3});
  EXPECT_GE(runs, 2 + 2 * 5);
  EXPECT_LE(runs, 2 + 2 * 10);
  runs = 0;
  (void)measure(tenTicks(), threeNumbers(), {counting(runs, 0)}, {.rounds = 1, .secondsPerRound = 1000});
  EXPECT_EQ(runs, 2 + 10'000) << "and no more often";
}

// Of two rounds the median lies in the middle, and the quarter points a quarter of the way from either.
TEST(Measure, ThePriceIsOfAMillisecondAndItsQuartersStandAboutTheMedian) {
  int runs = 0;
  const Row row = measure(tenTicks(), threeNumbers(), {counting(runs, 2e-3)}, {.rounds = 2, .secondsPerRound = 1e-3})[0];
  EXPECT_GE(row.nsPerMs, 2e6 / 10) << "2 ms of a processor for 10 ms";
  EXPECT_LT(row.nsPerMs, 2e6) << "of those it takes a little more";
  EXPECT_LE(row.nsLow, row.nsPerMs);
  EXPECT_NEAR(row.nsPerMs - row.nsLow, row.nsHigh - row.nsPerMs, 1e-6 * row.nsPerMs);
}

TEST(Measure, WhoeverDidNotReachTheEndIsGivenNoPrice) {
  int runs = 0, others = 0;
  const std::vector<Row> rows = measure(tenTicks(), threeNumbers(), {counting(runs, 0, "capped at 0.003 s"), counting(others, 0)},
                                        {.rounds = 4, .secondsPerRound = 0});
  EXPECT_EQ(rows[0].failure, "capped at 0.003 s");
  EXPECT_TRUE(std::isnan(rows[0].error.state));
  EXPECT_EQ(rows[0].nsPerMs, 0);
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(others, 6);
  EXPECT_GT(rows[1].nsPerMs, 0);
}

// --- contenders

TEST(Contender, StepsShorterThanATickAreCountedByTheTick) {
  const BenchScene scene = benchScene("S2a");
  for (const auto& [step, perTick] : {std::pair{1e-3, 1u}, {5e-4, 2u}, {2.5e-4, 4u}}) {
    const Contender c = makePlantContender(scene, "rk4", step, 0);
    EXPECT_EQ(c.method, "rk4");
    EXPECT_EQ(c.step, step);
    Trajectory out;
    c.run(&out);
    EXPECT_EQ(out.failure, "");
    EXPECT_EQ(out.steps, 1350 * perTick);
    EXPECT_EQ(out.rhsEvaluations, 4u * 1350 * perTick);
    EXPECT_EQ(out.worstTick, 4 * perTick);
    EXPECT_EQ(out.states.size(), 2u * 136);
    EXPECT_EQ(out.positions.size(), 3u * 136);
    Trajectory again;
    c.run(nullptr);
    c.run(&again);
    EXPECT_EQ(again.states, out.states) << "each run begins anew";
    EXPECT_EQ(again.rhsEvaluations, out.rhsEvaluations);
  }
}

// --- references

// e^-t and a circle, each to what the table of columns is asked for.
TEST(Extrapolation, FollowsAnEquationWhoseSolutionIsKnown) {
  const auto rate = [](double t, const double* y, double* dy) { dy[0] = -y[0] + t, dy[1] = y[2], dy[2] = -4 * y[1]; };
  for (const int columns : {8, 11}) {
    Extrapolation<double, decltype(rate)> integrator(rate, 3, columns, 1e-14);
    std::vector<double> y{2, 0.5, 1};
    double t = 0.5;
    for (const double end : {0.75, 3.0, 4.25}) {
      integrator.advance(t, end, y);
      t = end;
      EXPECT_NEAR(y[0], t - 1 + 2.5 * std::exp(-(t - 0.5)), 1e-12);
      EXPECT_NEAR(y[1], 0.5 * std::cos(2 * (t - 0.5)) + 0.5 * std::sin(2 * (t - 0.5)), 1e-12);
      EXPECT_NEAR(y[2], std::cos(2 * (t - 0.5)) - std::sin(2 * (t - 0.5)), 1e-12);
    }
  }
}

TEST(Extrapolation, GivesUpWhereNoStepIsShortEnough) {
  const auto rate = [](double t, const double*, double* dy) { dy[0] = t < 0.5 ? 1.0 : std::numeric_limits<double>::quiet_NaN(); };
  Extrapolation<double, decltype(rate)> integrator(rate, 1, 8, 1e-13);
  std::vector<double> y{0};
  EXPECT_TRUE(holds(refusalOf([&] { integrator.advance(0, 1, y); }), "step fell below 1e-14 s"));
  EXPECT_NEAR(y[0], 0.5, 1e-12) << "as far as there is an equation";
}

TEST(Quad, RootsSquareToWhatTheyAreOf) {
  for (const double x : {1e-20, 0.3, 2.0, 7e15}) {
    const Quad root = squareRoot(Quad(x));
    EXPECT_LT(std::abs(static_cast<double>((root * root - x) / x)), 1e-33) << x;
  }
  EXPECT_EQ(static_cast<double>(squareRoot(Quad(0))), 0);
  EXPECT_EQ(static_cast<double>(squareRoot(Quad(-1))), 0);
  EXPECT_EQ(static_cast<double>(absolute(Quad(-3))), 3);
  EXPECT_EQ(static_cast<double>(absolute(Quad(3))), 3);
  EXPECT_EQ(absolute(-3.0), 3);
  EXPECT_EQ(squareRoot(2.25), 1.5);
}

// Over half a second: a quintic is cut off nowhere, and a curve's series errs by its ninth term.
TEST(SceneHand, ASegmentOfManyTicksFollowsTheLawAsFarAsItsDegreeGoes) {
  for (const auto& [name, dt, within] : {std::tuple{"S1", 0.5, 1e-15}, {"S4", 0.3, 1e-15}, {"S2a", 0.03, 1e-10}, {"S5", 0.02, 1e-10}})
    for (const double t0 : {0.0, 0.35, 0.8}) {
      const SceneHand law = benchScene(name).hand;
      const dynamics::HandSegment segment = makeSegment(law, t0, dt);
      for (const double s : {0.25, 0.6, 1.0}) {
        const dynamics::HandSample found = dynamics::sampleAt(segment, s), truth = makeSample(law, t0 + s * dt);
        EXPECT_LT(norm(found.position - truth.position), within) << name << " " << t0;
        EXPECT_LT(norm(found.velocity - truth.velocity), 100 * within) << name << " " << t0;
      }
    }
  EXPECT_EQ(makeSegment(benchScene("S1").hand, 0.4, 1e-3).degree, 5);
  EXPECT_EQ(makeSegment(benchScene("S7d").hand, 0.4, 1e-3).degree, 0) << "nobody moves";
}

TEST(SceneHand, TheVelocityIsThePlacesRate) {
  for (const char* name : {"S1", "S4", "S2a", "S5"}) {
    const BenchScene scene = benchScene(name);
    for (const double t : {0.2, 0.7, 1.1}) {
      const Vec3 slope = (makeSample(scene.hand, t + 1e-5).position - makeSample(scene.hand, t - 1e-5).position) / 2e-5;
      EXPECT_LT(norm(makeSample(scene.hand, t).velocity - slope), 1e-8) << name << " " << t;
    }
  }
}

}  // namespace
}  // namespace reachlab::bench
