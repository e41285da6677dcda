#include "devices/mouse/mouse_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "sim/haptics/tick_engine.h"

namespace reachlab::devices {
namespace {

thread_local std::int64_t clockNs = 0;  // the tests' own
std::int64_t now() { return clockNs; }

TEST(MouseDevice, StaysWhereItIsUntilThePointerMoves) {
  clockNs = 1'000'000'000;
  MouseDevice mouse({-0.1, 0, 0}, now);
  for (int i = 0; i < 100; ++i, clockNs += 1'000'000) EXPECT_EQ(mouse.read().position, (Vec3{-0.1, 0, 0}));
}

TEST(MouseDevice, IgnoresWhatIsNotAPlace) {
  clockNs = 1'000'000'000;
  MouseDevice mouse({}, now);
  mouse.setTarget({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  for (int i = 0; i < 100; ++i, clockNs += 1'000'000) EXPECT_EQ(mouse.read().position, Vec3{});
}

TEST(MouseDevice, ArrivesWhereThePointerStopped) {
  clockNs = 1'000'000'000;
  MouseDevice mouse({}, now);
  for (int i = 0; i < 50; ++i) {
    mouse.setTarget({0.001 * i, 0, 0});
    for (int k = 0; k < 8; ++k, clockNs += 1'000'000) mouse.read();
  }
  for (int i = 0; i < 300; ++i, clockNs += 1'000'000) mouse.read();
  EXPECT_NEAR(mouse.read().position.x, 0.049, 1e-9);
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

struct Drag {
  double rate;   // [Hz] of the pointer's events
  double frame;  // [s] the window hands them over once a frame
  double pixel;  // [m]
};

// A smooth drag there and back, 0.2 m a second each way (minimum jerk), with pixels and time stamps of whole milliseconds, handed over at the
// frames' ends. What the engine logs as the hand's velocity, held against the true one `delay` earlier: RMS error over RMS velocity, over the
// drags after the first, in which the playback learns how late this window is.
double velocityError(const Drag& drag, double& delay) {
  clockNs = 5'000'000'000;
  MouseDevice mouse({-0.1, 0, 0}, now);
  haptics::TickEngine engine(experiment::readExperiment("chain-slow"), {});
  const auto law = [](double s) { return s * s * s * (10 + s * (6 * s - 15)); };
  const auto place = [&](double t) {
    const double within = std::fmod(t, 2.0);
    return -0.1 + 0.2 * (within < 1 ? law(within) : 1 - law(within - 1));
  };
  const auto velocity = [&](double t) { return (place(t + 1e-5) - place(t - 1e-5)) / 2e-5; };
  std::vector<std::pair<double, std::int64_t>> waiting;
  double nextEvent = 0, nextFrame = 0, squares = 0, power = 0, delays = 0;
  int counted = 0;
  for (int tick = 0; tick < 8000; ++tick, clockNs += 1'000'000) {
    const double t = tick * 1e-3;
    for (; nextEvent <= t; nextEvent += 1 / drag.rate)
      waiting.emplace_back(drag.pixel * std::round(place(nextEvent) / drag.pixel),
                           static_cast<std::int64_t>(nextEvent * 1e3) * 1'000'000 + 123'000'000'000);
    if (t >= nextFrame) {
      for (const auto& [x, ns] : waiting) mouse.point({x, 0, 0}, ns);
      waiting.clear();
      nextFrame += drag.frame;
    }
    haptics::TickInput input;
    input.device = mouse.read();
    engine.tick(input);
    if (tick < 4000) continue;
    // The pointer's stamps are whole milliseconds, rounded down: half of one earlier on the average.
    const double truth = velocity(t - mouse.delay() + 0.5e-3), error = engine.state().hand.velocity.x - truth;
    squares += error * error, power += truth * truth, delays += mouse.delay();
    ++counted;
  }
  delay = delays / counted;
  return std::sqrt(squares / power);
}

TEST(MouseDevice, ASmoothDragArrivesWithinFivePercentAtAnyRateAndFrameRate) {
  for (const double rate : {125.0, 200.0, 250.0, 500.0, 1000.0})
    for (const double framesPerSecond : {1000.0, 144.0, 60.0, 30.0, 12.0}) {
      double delay = 0;
      const double error = velocityError({rate, 1 / framesPerSecond, 0.25e-3}, delay);
      EXPECT_LT(error, 0.05) << rate << " Hz, " << framesPerSecond << " frames/s, delay " << delay;
      EXPECT_LT(delay, 1 / framesPerSecond + 2 / rate + 0.012 + 2 * MouseDevice::kSmoothing) << rate << " Hz, " << framesPerSecond;
    }
}

// Where the window becomes slower in the middle of a drag, the playback falls behind by and by.
TEST(MouseDevice, HowLateItIsChangesByAPartOfTheTimesPace) {
  clockNs = 5'000'000'000;
  MouseDevice mouse({}, now);
  std::vector<std::int64_t> waiting;
  double before = 0, atFirst = 0;
  for (int tick = 0; tick < 3000; ++tick, clockNs += 1'000'000) {
    waiting.push_back(clockNs);
    if (tick % (tick < 1000 ? 8 : 30) == 0) {
      for (const std::int64_t ns : waiting) mouse.point({0.2e-9 * static_cast<double>(ns - 5'000'000'000), 0, 0}, ns);
      waiting.clear();
    }
    (void)mouse.read();
    const double delay = mouse.delay();
    if (tick > 500) {
      EXPECT_LE(std::abs(delay - before), 1e-3 * MouseDevice::kMostDrift + 1e-8) << tick;
    }
    if (tick == 900) atFirst = delay;
    before = delay;
  }
  EXPECT_GT(before, atFirst + 0.01);
}

}  // namespace
}  // namespace reachlab::devices
