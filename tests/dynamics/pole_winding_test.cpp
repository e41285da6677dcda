#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {

// The plane by polar parameters that wind k times round its pole while the angle runs through 2 pi. The law is a straight line.
TEST(PoleWinding, AMassPassesAPoleStraightWhateverItsWinding) {
  for (const char* radius : {"v", "sinh(v)"})
    for (const double k : {0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 7.0})
      for (const double offset : {0.0, 1e-9, 1e-8, 1e-7, 1e-3}) {
        SCOPED_TRACE(fmt::format("radius {}, {} windings, offset {}", radius, k, offset));
        Scene scene = freeScene(onSurface(fmt::format("0.1*{}*cos({}*u)", radius, k), fmt::format("0.1*{}*sin({}*u)", radius, k), "0"),
                                {0.3, 1}, {offset, -1});
        const bool plain = radius == std::string("v");
        const double r = plain ? 0.1 : 0.1 * std::sinh(1.0), slope = plain ? 0.1 : 0.1 * std::cosh(1.0);
        const double c = std::cos(0.3 * k), s = std::sin(0.3 * k), turn = r * k * offset;
        const Vec3 start{r * c, r * s, 0}, v{-slope * c - turn * s, -slope * s + turn * c, 0};
        ASSERT_EQ(run(*scene.plant, noHand, 1.6), StepStatus::Ok) << scene.plant->stopReason();
        EXPECT_LT(norm(observed(*scene.plant)[0].r - (start + 1.6 * v)), 1e-9);
      }
}

}  // namespace reachlab::dynamics
