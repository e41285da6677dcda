#include "devices/mouse/mouse_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

namespace reachlab::devices {
namespace {

TEST(MouseDevice, StaysWhereItIsUntilThePointerMoves) {
  MouseDevice mouse({-0.1, 0, 0});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(mouse.read().position, (Vec3{-0.1, 0, 0}));
}

// x(t) = target (1 - (1 + t/T) exp(-t/T)) after a step; solved exactly each tick, so only rounding is left.
TEST(MouseDevice, FollowsAStepAsACriticallyDampedSystem) {
  MouseDevice mouse({});
  mouse.setTarget({1, 0, 0});
  for (int i = 1; i <= 200; ++i) {
    const haptics::DeviceSample sample = mouse.read();
    const double x = i * 1e-3 / MouseDevice::kSmoothing;
    EXPECT_NEAR(sample.position.x, 1 - (1 + x) * std::exp(-x), 1e-13);
    EXPECT_NEAR(sample.velocity.x, x * std::exp(-x) / MouseDevice::kSmoothing, 1e-11);
  }
}

TEST(MouseDevice, IgnoresWhatIsNotAPlace) {
  MouseDevice mouse({});
  mouse.setTarget({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  EXPECT_EQ(mouse.read().position, Vec3{});
}

TEST(MouseDevice, TakesPlacesFromAnotherThreadWhole) {
  MouseDevice mouse({});
  std::jthread window([&] {
    for (int i = 1; i <= 20'000; ++i) mouse.setTarget({1.0 * i, 1.0 * i, 1.0 * i});
  });
  for (int i = 0; i < 20'000; ++i) {
    const haptics::DeviceSample sample = mouse.read();
    ASSERT_EQ(sample.position.x, sample.position.y);
    ASSERT_EQ(sample.position.x, sample.position.z);
  }
}

}  // namespace
}  // namespace reachlab::devices
