#include <gtest/gtest.h>

#include <cmath>

#include "sim/predict/predict.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

// The table of known values prints 12 significant digits of a cost, 10 of a hand peak, 7 of an object peak and 6 of a time.
constexpr double kCostDigits = 1e-11, kPeakDigits = 1e-9, kObjectDigits = 1e-6, kTimeDigits = 1e-5;

struct KnownCase {
  experiment::Experiment (*experiment)();
  Criterion criterion;
  double cost, handPeak, handPeakTime, objectPeak;
};

class KnownValues : public testing::TestWithParam<KnownCase> {};

TEST_P(KnownValues, AreReproduced) {
  const KnownCase& known = GetParam();
  const auto prediction = predict(known.experiment(), known.criterion);
  EXPECT_NEAR(prediction->cost / known.cost, 1, kCostDigits);
  EXPECT_NEAR(prediction->handPeak / known.handPeak, 1, kPeakDigits);
  EXPECT_NEAR(prediction->handPeakTime, known.handPeakTime, kTimeDigits);
  EXPECT_NEAR(prediction->objectPeak / known.objectPeak, 1, kObjectDigits);
}

INSTANTIATE_TEST_SUITE_P(Table, KnownValues,
                         testing::Values(KnownCase{dingwell, Criterion::MinHandJerk, 16.5196433594, 0.2096247949, 0.444958, 0.3792369},
                                         KnownCase{dingwell, Criterion::MinHandForceChange, 57.8050997194, 0.2168114617, 0.675, 0.2777778},
                                         KnownCase{chainModerate, Criterion::MinHandJerk, 6.76284544993, 0.2881958938, 0.675, 0.4106285},
                                         KnownCase{parallelPair, Criterion::MinHandJerk, 0.378717793518, 0.1315335137, 1.18458,
                                                   0.1419976}));

}  // namespace
}  // namespace reachlab::predict
