#include "devices/mouse/mouse_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <tuple>
#include <vector>

#include "base/math/minimum_jerk.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/tick_engine.h"
#include "sim/haptics/tick_order.h"
#include "tests/devices/invented_clock.h"

namespace reachlab::devices {
namespace {

/// A window that hands the pointer's events over once a frame, each with the tick in which it came.
struct Window {
  // One tick, and whether a frame ends with it.
  void tick(MouseDevice& mouse, bool frameEnds, double speed) {
    waiting.push_back(inventedNs);
    if (frameEnds) {
      for (const std::int64_t ns : waiting) mouse.point({1e-9 * speed * static_cast<double>(ns % 1'000'000'000'000), 0, 0}, ns);
      waiting.clear();
    }
    mouse.read();
    inventedNs += 1'000'000;
  }
  std::vector<std::int64_t> waiting;
};
double playbackOf(const MouseDevice& mouse) { return mouse.delay() - 2 * MouseDevice::kSmoothing; }

class Mouse : public ::testing::Test {
 protected:
  Mouse() { inventedNs = 3'000'000'000; }
  Vec3 placeInNextTick() {
    inventedNs += 1'000'000;
    return mouse.read().position;
  }
  MouseDevice mouse{{-0.1, 0, 0}, inventedNow};
};

TEST_F(Mouse, StaysWhereItIsUntilThePointerIsAtAPlace) {
  for (int i = 0; i < 200; ++i) {
    if (i == 100) mouse.point({std::numeric_limits<double>::quiet_NaN(), 0, 0}, inventedNow());
    EXPECT_EQ(placeInNextTick(), (Vec3{-0.1, 0, 0}));
  }
}

TEST(MouseDevice, TakesPlacesFromAnotherThreadWhole) {
  MouseDevice mouse({});
  std::jthread window([&] {
    for (int i = 1; i <= 20'000; ++i) mouse.point({1.0 * i, 1.0 * i, 1.0 * i}, os::now());
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
  inventedNs = 5'000'000'000;
  MouseDevice mouse({-0.1, 0, 0}, inventedNow);
  haptics::TickEngine engine(experiment::readExperiment("chain-slow"), {});
  const auto place = [&](double t) {
    const double within = std::fmod(t, 2.0);
    return -0.1 + 0.2 * (within < 1 ? minimumJerk(within) : 1 - minimumJerk(within - 1));
  };
  const auto velocity = [&](double t) { return (place(t + 1e-5) - place(t - 1e-5)) / 2e-5; };
  std::vector<std::pair<double, std::int64_t>> waiting;
  double nextEvent = 0, nextFrame = 0, squares = 0, power = 0, delays = 0;
  int counted = 0;
  for (int tick = 0; tick < 8000; ++tick, inventedNs += 1'000'000) {
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
    input.devices[0] = mouse.read();
    haptics::runTick(engine, input);
    if (tick < 4000) continue;
    // The pointer's stamps are whole milliseconds, rounded down: half of one earlier on the average.
    const double truth = velocity(t - mouse.delay() + 0.5e-3), error = engine.state().hands[0].hip.velocity.x - truth;
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
TEST_F(Mouse, HowLateItIsChangesByAPartOfTheTimesPace) {
  Window window;
  double before = 0, atFirst = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    window.tick(mouse, tick % (tick < 1000 ? 8 : 30) == 0, 0.2);
    const double delay = mouse.delay();
    if (tick > 500) {
      EXPECT_LE(std::abs(delay - before), 1e-3 * MouseDevice::kMostDrift + 1e-8) << tick;
    }
    if (tick == 900) atFirst = delay;
    before = delay;
  }
  EXPECT_GT(before, atFirst + 0.01);
}

// Events at the ticks' own rate and at once: the hand is the ramp of 12 ms of playback and twice 8 ms of smoothing ago, at its very speed.
TEST(MouseDevice, ARampIsFollowedAtItsSpeedByItsDelay) {
  inventedNs = 3'000'000'000;
  MouseDevice mouse({}, inventedNow);
  EXPECT_NEAR(mouse.delay(), 0.012 + 2 * 0.008, 1e-15);
  const Vec3 speed{0.3, -0.2, 0.1};
  for (int tick = 0; tick < 1000; ++tick, inventedNs += 1'000'000) {
    mouse.point(1e-3 * tick * speed, inventedNs - 77'000'000'000);  // the clock of the events is another one
    const haptics::DeviceSample sample = mouse.read();
    ASSERT_TRUE(sample.hasVelocity);
    if (tick < 300) continue;
    // The smoothing's target is held over the tick that follows it: half of one less.
    ASSERT_LT(norm(sample.position - (1e-3 * tick - mouse.delay() + 0.5e-3) * speed), 0.05e-3 * norm(speed)) << tick;
    ASSERT_LT(norm(sample.velocity - speed), 2e-3 * norm(speed)) << tick;  // half a tick of T, squared
    ASSERT_NEAR(mouse.delay(), 0.028, 1e-4);
  }
  EXPECT_EQ(mouse.info().name, "mouse");
  EXPECT_EQ(mouse.info().version, "2");
  EXPECT_FALSE(mouse.info().rendersForce);
}

// A jump, long after anything moved: x = 1 - (1 + t/T) e^{-t/T} from when it is played on, T = 8 ms.
TEST_F(Mouse, AJumpIsTakenAsACriticallyDampedSystemDoes) {
  for (int i = 0; i < 200; ++i) placeInNextTick();
  mouse.point({0, 0, 0}, inventedNow());
  std::vector<double> moved;
  for (int i = 0; i < 200; ++i) moved.push_back((placeInNextTick().x + 0.1) / 0.1);
  const auto begin = static_cast<std::size_t>(std::find_if(moved.begin(), moved.end(), [](double x) { return x > 0; }) - moved.begin());
  ASSERT_LT(begin, 160u);
  // Before the event is reached the way to it is made in the last 60 ms: what comes before is a ramp, after it the system alone.
  std::size_t end = 0;
  for (std::size_t i = 1; i < moved.size(); ++i)
    if (moved[i] > 0.999 && end == 0) end = i;
  EXPECT_GT(end, begin + 20);
  for (std::size_t i = begin + 1; i < moved.size(); ++i) EXPECT_GE(moved[i], moved[i - 1] - 1e-12) << "it does not swing";
  EXPECT_NEAR(moved.back(), 1, 1e-6);
}

// Handed over by 8 ms for a second: the playback is as late as the latest of the heap and the next one's gap, and bounded from above.
TEST(MouseDevice, ItsPlaybackIsAsLateAsTheWindowAndNoLaterThanItMayBe) {
  for (const auto& [frame, least, most] : {std::tuple{30, 0.029, 0.034}, {100, 0.099, 0.104}, {400, 0.135, 0.15}}) {
    inventedNs = 3'000'000'000;
    MouseDevice mouse({}, inventedNow);
    Window window;
    for (int tick = 0; tick < 12'000; ++tick) window.tick(mouse, tick % frame == frame - 1, 1e-3);
    const double playback = playbackOf(mouse);
    EXPECT_GE(playback, least - 2e-3) << frame;
    EXPECT_LE(playback, most + 2e-3) << frame;
  }
}

// Slow for a while, then prompt: within 5 s all but 1/e of what it was too late is forgotten, within 20 s nearly all.
TEST_F(Mouse, ASlowWindowIsForgotten) {
  const auto run = [&](int ticks, int frame) {
    Window window;
    for (int tick = 0; tick < ticks; ++tick) window.tick(mouse, tick % frame == frame - 1, 0.1);
    return playbackOf(mouse) - 0.012;
  };
  const double slow = run(6000, 60);
  EXPECT_GT(slow, 0.03);
  EXPECT_NEAR(run(5000, 1) / slow, std::exp(-1.0), 0.08);
  EXPECT_LT(run(20'000, 1), 0.03 * slow);
}

TEST_F(Mouse, OfEventsOutOfOrderTheLaterWordCounts) {
  mouse.point({1, 0, 0}, 50'000'000);
  mouse.point({2, 0, 0}, 50'000'000);
  mouse.point({3, 0, 0}, 40'000'000);
  for (int i = 0; i < 400; ++i) placeInNextTick();
  EXPECT_NEAR(placeInNextTick().x, 3, 1e-9);
}

}  // namespace
}  // namespace reachlab::devices
