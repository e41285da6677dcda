#include "sim/dynamics/methods/dense_output.h"

#include <gtest/gtest.h>

#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

/// Largest error of one step's dense output for x'' = -x from (1, 0), the solution being the cosine.
double largestError(double h) {
  const auto rate = [](double, const Numbers<2>& y, Numbers<2>& dy) { dy.values = {y[1], -y[0]}; };
  const auto unit = [](int, double) { return 1.0; };
  auto k = dop853::makeStages<2>(2);
  Numbers<2> y, next, at;
  y.values = {1, 0};
  rate(0, y, k[0]);
  dop853::attempt<2>(rate, unit, 0, h, y, k, next);
  const auto dense = dop853::makeDenseOutput<2>(rate, 0, h, y, k, next);
  double largest = 0;
  for (int i = 0; i <= 40; ++i) {
    dense.at(i / 40.0, at);
    largest = std::max({largest, std::abs(at[0] - std::cos(i / 40.0 * h)), std::abs(at[1] + std::sin(i / 40.0 * h))});
  }
  return largest;
}

TEST(DenseOutput, FollowsTheMotionWithinAStepToOrderSeven) {
  EXPECT_LT(largestError(0.5), 1e-8);
  // A local error of order 8 falls 256-fold when the step is halved; 100 leaves room for the next order.
  EXPECT_GT(largestError(1.0) / largestError(0.5), 100);
  EXPECT_GT(largestError(0.5) / largestError(0.25), 100);
}

TEST(Ends, AreMetAtTheirMomentForAFewRightHandSides) {
  // Thrown up a cylinder whose ends are elastic, v goes up and down at constant speed: a triangle between -1 and 1.
  experiment::Experiment e = makePoint(0.5);
  e.constraint.name = "cylinder";
  const double rate = 7.3;
  const Scene scene = freeScene(e, {0.2, 0.4}, {3, rate});
  std::uint64_t before = scene.plant->rhsEvaluations(), most = 0;
  for (int i = 1; i <= 3000; ++i) {
    ASSERT_EQ(scene.plant->step(makeSegment(noHand, 0, 1e-3), 1e-3), StepStatus::Ok);
    most = std::max(most, scene.plant->rhsEvaluations() - before);
    before = scene.plant->rhsEvaluations();
    const double way = std::fmod(0.4 + 1 + rate * i * 1e-3, 4);  // from the lower end, there and back
    ASSERT_NEAR(observed(*scene.plant)[0].q[1], way < 2 ? way - 1 : 3 - way, 1e-10) << "after " << i << " ms of the default tolerance";
  }
  EXPECT_LT(most, 60u) << "the tick's step, the way to the end, four for its moment, the rest of the tick and a new start";
}

}  // namespace
}  // namespace reachlab::dynamics
