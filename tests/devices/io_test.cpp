// What stands between a device's own pace and the tick's: a transport behind its I/O thread, and a hand that is steered by its speed.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "devices/io/polled_device.h"
#include "devices/io/rate_hand.h"
#include "tests/devices/invented_clock.h"
#include "tests/refusal.h"
#include "tests/until.h"

namespace reachlab::devices {
namespace {

using haptics::DeviceHealth;
using test::until;

/// Answers as the test says, and keeps what it was told.
struct Scripted final : Transport {
  haptics::DeviceInfo info() const override { return {.name = "scripted"}; }
  Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) override {
    ++exchanges;
    told = force.newest();
    sample.position = place;
    sample.buttons = 5;
    return answer;
  }
  std::int64_t period() const override { return pace; }
  bool tellZero() noexcept override { return ++zeros, takesZero; }
  bool reopen() override { return ++reopened, comesBack; }
  std::string lossText() const override { return why; }
  bool stopForce() noexcept override { return ++stopped, false; }
  void close() noexcept override { ++closed; }
  std::string calibrationHint() const override { return "hold it"; }
  std::string calibrate() override { return ++calibrated, refusal; }

  std::atomic<Exchange> answer{Exchange::Report};
  Vec3 place, told;
  std::atomic<int> exchanges{0}, zeros{0}, reopened{0}, stopped{0}, closed{0}, calibrated{0};
  std::atomic<bool> takesZero{true}, comesBack{false};
  std::int64_t pace = 0;
  std::string why, refusal;
};

class Polled : public ::testing::Test {
 protected:
  Polled() { inventedNs = 1000 * kMs; }
  std::shared_ptr<Scripted> transport = std::make_shared<Scripted>();
  PolledDevice device{transport, inventedNow};
};

TEST_F(Polled, EachReportIsCountedAndStampedWithItsTime) {
  EXPECT_EQ(device.info().name, "scripted");
  transport->place = {1, 2, 3};
  device.step();
  inventedNs += 7;
  EXPECT_EQ(device.read().position, (Vec3{1, 2, 3}));
  EXPECT_EQ(device.read().reports, 1u);
  EXPECT_EQ(device.read().takenNs, 1000 * kMs);
  EXPECT_EQ(device.read().buttons, 5u);
  EXPECT_TRUE(device.read().valid);
  transport->place = {4, 5, 6};
  device.step();
  EXPECT_EQ(device.read().reports, 2u);
  EXPECT_EQ(device.read().takenNs, 1000 * kMs + 7);
  EXPECT_EQ(device.read().position, (Vec3{4, 5, 6}));
  transport->answer = Exchange::Nothing;
  device.step();
  EXPECT_EQ(device.read().reports, 2u) << "no news";
  EXPECT_TRUE(device.read().valid);
  EXPECT_EQ(device.health(), DeviceHealth::Ready);
  EXPECT_EQ(device.healthText(), "");
}

TEST_F(Polled, AForceHoldsForTwentyMilliseconds) {
  device.step();
  EXPECT_EQ(transport->told, Vec3{}) << "none was left yet";
  device.write({1, -2, 3});
  const auto toldAfter = [&](std::int64_t ns) {
    inventedNs = 1000 * kMs + ns;
    device.step();
    return transport->told;
  };
  EXPECT_EQ(toldAfter(0), (Vec3{1, -2, 3}));
  EXPECT_EQ(toldAfter(20 * kMs), (Vec3{1, -2, 3}));
  EXPECT_EQ(toldAfter(20 * kMs + 1), Vec3{});
  device.write({4, 5, 6});
  device.step();
  EXPECT_EQ(transport->told, (Vec3{4, 5, 6}));
}

TEST_F(Polled, AStoppedForceIsNoneUntilAnotherIsLeft) {
  device.write({1, 0, 0});
  EXPECT_TRUE(device.stopForce());
  device.step();
  EXPECT_EQ(transport->told, Vec3{});
  device.write({2, 0, 0});
  device.step();
  EXPECT_EQ(transport->told, (Vec3{2, 0, 0}));
}

TEST_F(Polled, ALostDeviceIsToldZeroUntilItTakesItAndAskedForEveryFifthOfASecond) {
  device.step();
  transport->answer = Exchange::Lost;
  transport->takesZero = false;
  transport->why = "its cable is out";
  device.write({1, 0, 0});
  device.step();
  EXPECT_FALSE(device.read().valid);
  EXPECT_EQ(device.health(), DeviceHealth::Lost);
  EXPECT_EQ(device.healthText(), "its cable is out");
  EXPECT_EQ(transport->zeros, 1);
  device.step();
  EXPECT_EQ(transport->zeros, 2) << "it has not taken it yet";
  transport->takesZero = true;
  device.step();
  EXPECT_EQ(transport->zeros, 3);
  device.step();
  EXPECT_EQ(transport->zeros, 3);
  EXPECT_EQ(transport->reopened, 0);
  EXPECT_EQ(transport->exchanges, 2);
  inventedNs += 200 * kMs - 1;
  device.step();
  EXPECT_EQ(transport->reopened, 0);
  inventedNs += 1;
  device.step();
  EXPECT_EQ(transport->reopened, 1);
  device.step();
  inventedNs += 199 * kMs;
  device.step();
  EXPECT_EQ(transport->reopened, 1);
  inventedNs += kMs;
  transport->comesBack = true;
  transport->answer = Exchange::Report;
  device.write({3, 0, 0});
  device.step();
  EXPECT_EQ(transport->told, Vec3{}) << "what it is told first is no force";
  EXPECT_TRUE(device.read().valid);
  EXPECT_EQ(device.health(), DeviceHealth::Ready);
  EXPECT_EQ(device.healthText(), "");
  device.step();
  EXPECT_EQ(transport->told, (Vec3{3, 0, 0}));
}

TEST_F(Polled, OneThatIsLostAgainAtItsFirstExchangeIsAskedForLater) {
  transport->answer = Exchange::Lost;
  transport->comesBack = true;
  device.step();
  inventedNs += 200 * kMs;
  device.step();
  EXPECT_EQ(transport->reopened, 1);
  EXPECT_EQ(transport->exchanges, 2);
  EXPECT_EQ(transport->zeros, 2);
  inventedNs += 199 * kMs;
  device.step();
  EXPECT_EQ(transport->reopened, 1);
}

TEST(PolledDevice, IsClosedAtItsEnd) {
  const auto transport = std::make_shared<Scripted>();
  { const PolledDevice device(transport, inventedNow); }
  EXPECT_EQ(transport->closed, 1);
  { PolledDevice device(transport); }
  EXPECT_EQ(transport->closed, 2);
}

TEST(PolledDevice, IsCalibratedByItsOwnThread) {
  const auto transport = std::make_shared<Scripted>();
  PolledDevice device(transport);
  EXPECT_EQ(device.calibrationHint(), "hold it");
  device.calibrate();
  EXPECT_EQ(transport->calibrated, 1);
  const int exchanged = transport->exchanges;
  EXPECT_TRUE(until([&] { return transport->exchanges > exchanged + 3; }));
  EXPECT_EQ(transport->calibrated, 1) << "once";
  transport->refusal = "it is held wrongly";
  EXPECT_EQ(reachlab::refusalOf([&] { device.calibrate(); }), "device scripted: it is held wrongly");
  transport->refusal.clear();
  EXPECT_NO_THROW(device.calibrate());
}

TEST(PolledDevice, OneThatNeverReportsIsRefusedWithItsReasonAndClosed) {
  const auto refusalOf = [](const std::string& why) {
    const auto transport = std::make_shared<Scripted>();
    transport->answer = Exchange::Nothing;
    transport->why = why;
    const std::string said = reachlab::refusalOf<ResourceError>([&] { PolledDevice device(transport, 20); }, "opened");
    EXPECT_EQ(transport->closed, 1);
    return said;
  };
  EXPECT_EQ(refusalOf(""), "scripted: it was opened, but no report came within 20 ms");
  EXPECT_EQ(refusalOf("too old"), "scripted: it was opened, but no report came within 20 ms: too old");
}

// By the transport's own pace: a hundredth of a second between two exchanges lets no more than some through.
TEST(PolledDevice, KeepsTheTransportsPace) {
  const auto transport = std::make_shared<Scripted>();
  transport->pace = 10 * kMs;
  const auto begin = std::chrono::steady_clock::now();
  PolledDevice device(transport);
  ASSERT_TRUE(until([&] { return transport->exchanges >= 10; }));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_LE(transport->exchanges, seconds / 0.01 + 2);
}

/// Says what the test hands it, once each.
struct Pushes final : DeflectionSource {
  bool wait(Deflection& newest, bool& isLost) override {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    const std::lock_guard lock(mutex);
    isLost = lost;
    if (!fresh) return false;
    newest = next;
    fresh = false;
    return true;
  }
  void say(const Deflection& d) {
    const std::lock_guard lock(mutex);
    next = d, fresh = true;
  }
  std::mutex mutex;
  Deflection next;
  bool fresh = false, lost = false;
};

class Steered : public ::testing::Test {
 protected:
  void make(const RateHand::Options& options) {
    hand = std::make_unique<RateHand>(haptics::DeviceInfo{.name = "steered"}, options, start, source);
  }
  // The first sample with this push: `before` ticks have none of it yet.
  haptics::DeviceSample first(const Vec3& push, std::uint32_t buttons = 0) {
    const std::uint64_t seen = hand->read().reports;
    source->say({push, buttons});
    haptics::DeviceSample sample;
    EXPECT_TRUE(until([&] { return (sample = hand->read()).reports > seen; }));
    return sample;
  }
  const Vec3 start{0.1, -0.2, 0.3};
  std::shared_ptr<Pushes> source = std::make_shared<Pushes>();
  std::unique_ptr<RateHand> hand;
};

TEST_F(Steered, ItsSpeedIsThePushBeyondTheDeadZone) {
  make({.gain = 2, .deadZone = 0.2, .reach = 100});
  EXPECT_EQ(hand->info().name, "steered");
  EXPECT_EQ(hand->read().position, start);
  EXPECT_TRUE(hand->read().hasVelocity);
  const haptics::DeviceSample sample = first({0.6, -1, 0.2}, 6);
  EXPECT_NEAR(sample.velocity.x, 2 * 0.5, 1e-15);
  EXPECT_NEAR(sample.velocity.y, -2, 1e-15);
  EXPECT_EQ(sample.velocity.z, 0) << "within the dead zone";
  EXPECT_EQ(sample.buttons, 6u);
  EXPECT_EQ(first({-1.5, 0.1, -0.6}).velocity.x, -2) << "no faster than full";
  EXPECT_NEAR(hand->read().velocity.z, -1, 1e-15);
}

// Held over 40 ticks without news, then less by 1/e each 20; each tick moves it by its speed.
TEST_F(Steered, APushIsHeldAndThenFades) {
  make({.gain = 1, .deadZone = 0, .reach = 100});
  double x = first({0.5, 0, 0}).position.x;
  for (int age = 1; age <= 200; ++age) {
    const haptics::DeviceSample sample = hand->read();
    const double speed = age <= 40 ? 0.5 : 0.5 * std::exp(-(age - 40) / 20.0);
    ASSERT_NEAR(sample.velocity.x, speed, 1e-12) << age;
    ASSERT_NEAR(sample.position.x - x, 1e-3 * speed, 1e-12) << age;
    x = sample.position.x;
  }
  EXPECT_EQ(first({0.5, 0, 0}).velocity.x, 0.5) << "news begin anew";
}

TEST_F(Steered, ItStopsAtItsReachOnEachAxis) {
  make({.gain = 1000, .deadZone = 0, .reach = 0.25});
  EXPECT_NEAR(first({1, -1, 0}).velocity.x, 0.25 / 1e-3, 1e-9) << "in the tick that reaches the end it is what is left";
  for (int i = 0; i < 3; ++i) hand->read();
  const haptics::DeviceSample sample = hand->read();
  EXPECT_NEAR(sample.position.x, 0.35, 1e-15);
  EXPECT_NEAR(sample.position.y, -0.45, 1e-15);
  EXPECT_EQ(sample.position.z, 0.3);
  EXPECT_EQ(sample.velocity, Vec3{}) << "it stands there";
  const haptics::DeviceSample back = first({-0.0001, 0.0001, 0});
  EXPECT_NEAR(back.velocity.x, -0.1, 1e-12);
  EXPECT_NEAR(back.velocity.y, 0.1, 1e-12);
}

TEST_F(Steered, PlacedItIsAtItsStartAgain) {
  make({.gain = 1, .deadZone = 0, .reach = 1});
  first({1, 1, 1});
  for (int i = 0; i < 50; ++i) hand->read();
  hand->cue(haptics::Cue::Go);
  EXPECT_GT(hand->read().position.x, start.x + 0.04);
  first({0, 0, 0});
  hand->cue(haptics::Cue::Place);
  EXPECT_EQ(hand->read().position, start);
}

TEST_F(Steered, WhatIsNoNumberIsNoPushAndALossShows) {
  make({.gain = 1, .deadZone = 0, .reach = 1});
  first({1, 0, 0});
  source->say({{std::numeric_limits<double>::quiet_NaN(), 0, 0}, 0});
  EXPECT_TRUE(until([&] {
    const std::lock_guard lock(source->mutex);
    return !source->fresh;
  }));
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(isFinite(hand->read().position));
  EXPECT_EQ(hand->health(), DeviceHealth::Ready);
  {
    const std::lock_guard lock(source->mutex);
    source->lost = true;
  }
  EXPECT_TRUE(until([&] { return !hand->read().valid; }));
  EXPECT_EQ(hand->health(), DeviceHealth::Lost);
}

}  // namespace
}  // namespace reachlab::devices
