#include "sim/haptics/device_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/haptics/watchdog.h"
#include "tests/refusal.h"

namespace reachlab::haptics {
namespace {

constexpr std::int64_t kTickNs = 1'000'000;

DeviceInfo forceDevice() { return {.rendersForce = true, .speedLimit = 3, .silenceLimit = 0.02}; }

// A device that counts its reports, looked at once a tick.
class Watch : public ::testing::Test {
 protected:
  DeviceSample look(const Vec3& position, bool isNew = true, std::uint32_t missed = 0) {
    return see({.position = position}, isNew, missed);
  }
  DeviceSample see(DeviceSample sample, bool isNew = true, std::uint32_t missed = 0) {
    if (isNew) ++reports;
    sample.reports = reports;
    now += kTickNs * (1 + missed);
    context.nowNs = now;
    context.missed = missed;
    return watch.look(sample, context);
  }
  void settle(const Vec3& position) {
    for (int i = 0; i < 20; ++i) look(position);
  }

  DeviceWatch watch{forceDevice()};
  WatchContext context{true, 0, 0};
  std::uint64_t reports = 0;
  std::int64_t now = 0;
};

TEST_F(Watch, PassesAnOrdinaryReachUntouched) {
  for (int i = 0; i < 1000; ++i) {
    const double x = 0.2 * 0.5 * (1 - std::cos(i * 3.14159265 / 1000));
    const DeviceSample sample = look({x, 0, 0});
    ASSERT_TRUE(sample.valid) << i;
    ASSERT_EQ(sample.position.x, x);
  }
  EXPECT_EQ(watch.fault(), DeviceFault::None);
}

// However little is felt: an arm that is unplugged would otherwise end trial after trial, and the run without a word. A hand held still goes on
// reporting.
TEST_F(Watch, MissingReportsInATrialAreLatchedAfterTheDevicesBound) {
  for (const int bound : {20, 10}) {
    DeviceInfo info = forceDevice();
    info.silenceLimit = 1e-3 * bound;
    watch = DeviceWatch(info);
    for (int i = 0; i < 5000; ++i) ASSERT_TRUE(look({0.1, 0, 0}).valid);
    for (int i = 1; i < bound; ++i) ASSERT_TRUE(look({0.1, 0, 0}, false).valid) << i;
    EXPECT_FALSE(look({0.1, 0, 0}, false).valid) << bound << " ms without a report";
    EXPECT_EQ(watch.fault(), DeviceFault::Silent);
  }
}

TEST_F(Watch, MissingReportsBetweenTrialsAreNoFault) {
  settle({0.1, 0, 0});
  context.engaged = false;
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(look({0.1, 0, 0}, false).valid) << i;
  EXPECT_EQ(watch.fault(), DeviceFault::None);
}

TEST_F(Watch, ADeviceThatDoesNotCountItsReportsIsNotJudgedByThem) {
  for (int i = 0; i < 1000; ++i) {
    context.nowNs = now += kTickNs;
    ASSERT_TRUE(watch.look({}, context).valid);
  }
}

// A virtual hand is carried from the target back to the start in one tick, and is engaged there at once.
TEST_F(Watch, AHandThatWasCarriedToTheStartIsNotFastThere) {
  settle({0.3, 0, 0});
  context.engaged = false;
  look({0.3, 0, 0});
  EXPECT_TRUE(look({}).valid) << "while the object is put up the hand may jump";
  context.engaged = true;
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(look({}).valid) << i;
  EXPECT_EQ(watch.fault(), DeviceFault::None);
}

TEST_F(Watch, TheLimitIsTheSameHoweverLongAHandHasBeenLookedAt) {
  for (int before = 10; before < 50; ++before)
    for (const double speed : {2.95, 3.05}) {
      watch = DeviceWatch(forceDevice());
      for (int i = 0; i < before; ++i) look({});
      for (int i = 1; i <= 10; ++i) look({speed * 1e-3 * i, 0, 0});
      EXPECT_EQ(watch.fault(), speed < 3 ? DeviceFault::None : DeviceFault::Speed) << speed << " m/s after " << before << " ticks";
    }
}

TEST_F(Watch, ASlowDevicesStepsAreHeldAgainstTheTimeTheyTook) {
  // 125 Hz at 1 m/s: steps of 8 mm every eighth tick.
  double x = 0;
  for (int i = 0; i < 800; ++i) {
    if (i % 8 == 0) x += 8e-3;
    ASSERT_TRUE(look({x, 0, 0}, i % 8 == 0).valid) << i;
  }
}

TEST_F(Watch, ALatchedFaultStaysUntilReset) {
  settle({});
  look({0.1, 0, 0});
  ASSERT_NE(watch.fault(), DeviceFault::None);
  for (int i = 0; i < 1000; ++i) ASSERT_FALSE(look({0.1, 0, 0}).valid);
  watch.latch(DeviceFault::Device);
  EXPECT_EQ(watch.fault(), DeviceFault::Jump) << "the first one is told";
  watch.reset();
  EXPECT_TRUE(look({0.1, 0, 0}).valid);
  EXPECT_EQ(watch.fault(), DeviceFault::None);
}

TEST_F(Watch, AnOpenDeadManSwitchTakesTheForceAndLeavesNoLatch) {
  settle({});
  DeviceSample sample{.released = true};
  EXPECT_FALSE(see(sample).valid);
  EXPECT_TRUE(see(sample).released) << "known, so that the trial goes on";
  sample.valid = false;
  EXPECT_FALSE(see(sample).released) << "lost, and not let go of";
  EXPECT_TRUE(look({}).valid);
}

TEST_F(Watch, AHandThatWasLostMayComeBackElsewhere) {
  settle({});
  EXPECT_FALSE(see({.valid = false}, false).valid);
  EXPECT_TRUE(look({0.2, 0, 0}).valid);
}

// Told by its clock, a report is as old as the device says, but never from a time to come.
TEST_F(Watch, AReportIsAsOldAsTheDeviceSays) {
  for (const std::int64_t age : {19'999'999, 20'000'000, -1'000'000'000}) {
    watch = DeviceWatch(forceDevice());
    settle({});
    EXPECT_EQ(see({.takenNs = now + kTickNs - age}).valid, age < 20'000'000) << age;
    EXPECT_EQ(watch.fault(), age < 20'000'000 ? DeviceFault::None : DeviceFault::Silent);
    if (age > 0) continue;
    for (int i = 1; i < 20; ++i) ASSERT_TRUE(look({}, false).valid) << i;
    EXPECT_FALSE(look({}, false).valid) << "20 ms after it came";
  }
}

TEST_F(Watch, TheVelocityThatADeviceMeasuresIsHeldToTheSameLimit) {
  for (const double speed : {2.99, 3.01})
    for (const bool measures : {false, true}) {
      watch = DeviceWatch(forceDevice());
      settle({});
      EXPECT_EQ(see({.velocity = {0, 0.6 * speed, -0.8 * speed}, .hasVelocity = measures}).valid, !measures || speed < 3) << speed;
    }
}

// A hand may have gone on at its limit while it was not seen: 20 mm more than that is a jump.
TEST_F(Watch, HowFarAHandMayBeGrowsWithTheTimeItWasNotSeen) {
  DeviceInfo info = forceDevice();
  info.speedLimit = 2;
  for (const int silent : {0, 3})
    for (const std::uint32_t missed : {0u, 4u})
      for (const double beyond : {-1e-5, 1e-5}) {
        watch = DeviceWatch(info);
        settle({});
        for (int i = 0; i < silent; ++i) look({}, false);
        look({0.6 * (0.02 + 2e-3 * (silent + missed) + beyond), 0.8 * (0.02 + 2e-3 * (silent + missed) + beyond), 0}, true, missed);
        EXPECT_EQ(watch.fault() == DeviceFault::Jump, beyond > 0) << silent << " silent, " << missed << " missed";
      }
}

// A computer that was held up asks twice at once: ten ticks are never taken for less than 10 ms, and for what the clock says if it is more.
TEST_F(Watch, TheSpeedIsTakenOverTenTicksOrTheirTimeOnTheClock) {
  for (const std::uint32_t missed : {0u, 1u})
    for (const double speed : {2.9, 3.1}) {
      watch = DeviceWatch(forceDevice());
      for (int i = 0; i < 25; ++i) look({}, true, missed);
      for (int i = 1; i <= 10; ++i) look({0, 0, speed * 1e-3 * (1 + missed) * i}, true, missed);
      EXPECT_EQ(watch.fault(), speed < 3 ? DeviceFault::None : DeviceFault::Speed) << speed;
    }
  watch = DeviceWatch(forceDevice());
  settle({});
  for (int i = 1; i <= 10; ++i) {
    now -= kTickNs / 2;
    ASSERT_TRUE(look({2e-3 * i, 0, 0}).valid) << "4 m/s if the clock were believed";
  }
}

TEST_F(Watch, APlaceThatIsNoNumberIsNotLookedAt) {
  settle({});
  look({0, std::numeric_limits<double>::quiet_NaN(), 0});
  EXPECT_EQ(watch.fault(), DeviceFault::None);
  EXPECT_TRUE(look({0.2, 0, 0}).valid) << "as after a loss";
}

TEST(DeviceWatch, LeavesDevicesWithoutForceAlone) {
  DeviceWatch watch{DeviceInfo{}};
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(watch.look({.position = {1.0 * i, 0, 0}}, {true, 0, i * kTickNs}).valid);
}

TEST(Watchdog, FiresWhenNoTickIsCompletedUnderForceOrTheDevicesClockDoesNotCall) {
  constexpr std::int64_t kMs = 1'000'000, kLast = 1000 * kMs;
  EXPECT_EQ(judgeLoop({kLast + 20 * kMs, kLast, true, false}), DeviceFault::None);
  EXPECT_EQ(judgeLoop({kLast + 20 * kMs + 1, kLast, true, false}), DeviceFault::Stalled);
  EXPECT_EQ(judgeLoop({kLast + 501 * kMs, kLast, false, false}), DeviceFault::None) << "no force, no haste; our own clock need not call";
  EXPECT_EQ(judgeLoop({kLast + 400 * kMs, 0, true, false}), DeviceFault::None) << "no tick yet";
  EXPECT_EQ(judgeLoop({kLast + 500 * kMs, kLast, false, true}), DeviceFault::None);
  EXPECT_EQ(judgeLoop({kLast + 501 * kMs, kLast, false, true}), DeviceFault::NoClock);
}

TEST(DeviceFault, EverySentenceNamesDeviceAndFaultAndSaysWhatHappened) {
  const std::vector<std::pair<std::string_view, const char*>> all{
      {"none", "is in order"},       {"silent", "no new report"},     {"jump", "more than 20 mm within a tick"},
      {"speed", "speed limit"},      {"not_finite", "not a number"},  {"stalled", "more than 20 ms"},
      {"no_clock", "does not call"}, {"device", "a fault of its own"}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto fault = static_cast<DeviceFault>(i);
    const std::string text = describe(fault, "Omni");
    EXPECT_TRUE(holds(text, "device Omni "));
    EXPECT_TRUE(holds(text, all[i].second));
    EXPECT_TRUE(holds(text, "(fault: " + std::string(all[i].first) + ")"));
  }
}

}  // namespace
}  // namespace reachlab::haptics
