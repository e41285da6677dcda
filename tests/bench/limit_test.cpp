#include <gtest/gtest.h>

#include "bench/measure.h"
#include "tests/bench/limit_forms.h"
#include "tests/bench/limit_sincos.h"

namespace reachlab::bench {
namespace {

// A form that serves as the measure of speed must itself be right: 1e-10, the error at which methods are compared.
TEST(LimitForms, MeetTheErrorAtWhichMethodsAreCompared) {
  constexpr double kComparedAt = 1e-10;
  for (const BenchScene& scene : benchScenes()) {
    if (scene.name == "S1b500") continue;  // the same code as S1b50; its reference takes seconds
    const std::optional<Contender> limit = makeLimit(scene);
    if (!limit) continue;
    SCOPED_TRACE(scene.name);
    Trajectory trajectory;
    limit->run(&trajectory);
    const Deviation error = computeError(trajectory, computeReference(scene));
    EXPECT_LT(error.state, kComparedAt);
    EXPECT_LT(error.position, kComparedAt);
  }
}

// One rounding of a number of order 1 is 1.1e-16; the reduced argument adds as much again.
TEST(LimitForms, InlinedSineAndCosineAreRightToTwoRoundings) {
  for (int i = -20000; i <= 20000; ++i) {
    const double x = i / 317.0;
    double s, c;
    sinCos(x, s, c);
    EXPECT_NEAR(s, std::sin(x), 2.3e-16);
    EXPECT_NEAR(c, std::cos(x), 2.3e-16);
  }
}

}  // namespace
}  // namespace reachlab::bench
