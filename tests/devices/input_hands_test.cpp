#include "devices/input/input_hands.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "base/error.h"
#include "base/system/os.h"
#include "tests/until.h"

namespace reachlab::devices {
namespace {

using test::until;

/// A node that the test writes events into: this kernel's own may not be there.
class Events {
 public:
  Events() {
    if (::pipe(ends_) != 0) throw std::runtime_error("pipe");
  }
  ~Events() {
    unplug();
    if (!given_) ::close(ends_[0]);
  }
  OpenInput open() {
    return [this]() -> std::unique_ptr<InputPort> {
      if (std::exchange(given_, true)) throw ResourceError("it is gone");
      return std::make_unique<InputPort>(ends_[0]);
    };
  }
  void send(std::uint16_t type, std::uint16_t code, std::int32_t value, std::int64_t ns = 0) {
    input_event event{};
    event.input_event_sec = ns / 1'000'000'000;
    event.input_event_usec = ns % 1'000'000'000 / 1000;
    event.type = type, event.code = code, event.value = value;
    ASSERT_EQ(::write(ends_[1], &event, sizeof event), static_cast<ssize_t>(sizeof event));
  }
  void sync(std::int64_t ns = 0) { send(EV_SYN, SYN_REPORT, 0, ns); }
  void unplug() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2] = {-1, -1};
  bool given_ = false;
};

input_event event(std::uint16_t type, std::uint16_t code, std::int32_t value) {
  input_event e{};
  e.type = type, e.code = code, e.value = value;
  return e;
}

TEST(InputState, KeysPushAlongTheirWays) {
  InputNode node;
  InputState state(node);
  state.take(event(EV_KEY, KEY_RIGHT, 1));
  state.take(event(EV_KEY, KEY_DOWN, 1));
  EXPECT_TRUE(state.take(event(EV_SYN, SYN_REPORT, 0)));
  EXPECT_EQ(state.deflection().push, (Vec3{1, -1, 0}));
  state.take(event(EV_KEY, KEY_LEFT, 1));
  EXPECT_EQ(state.deflection().push.x, 0) << "both at once: none";
  state.take(event(EV_KEY, KEY_RIGHT, 0));
  state.take(event(EV_KEY, KEY_DOWN, 0));
  state.take(event(EV_KEY, KEY_PAGEDOWN, 2));
  EXPECT_EQ(state.deflection().push, (Vec3{-1, 0, 1})) << "a key that repeats is down";
}

TEST(InputState, SticksAreSharesOfTheirRangeAndUpIsUp) {
  InputNode node;
  node.kind = InputKind::Gamepad;
  node.axes[ABS_X] = {0, 255};
  node.axes[ABS_Y] = {-32768, 32767};
  InputState state(node);
  EXPECT_EQ(state.deflection().push, Vec3{}) << "an axis that has said nothing is at rest";
  state.take(event(EV_ABS, ABS_X, 255));
  state.take(event(EV_ABS, ABS_Y, -32768));
  state.take(event(EV_KEY, BTN_GAMEPAD, 1));
  EXPECT_NEAR(state.deflection().push.x, 1, 1e-12);
  EXPECT_NEAR(state.deflection().push.y, 1, 1e-12);
  EXPECT_EQ(state.deflection().buttons, 1u);
  state.take(event(EV_ABS, ABS_X, 100'000));
  EXPECT_EQ(state.deflection().push.x, 1) << "no further than its end";
}

TEST(InputHands, AHeldKeyMovesTheHandAndAPulledCableStopsIt) {
  Events events;
  InputNode node;
  RateHand::Options options;
  options.gain = 0.15;
  options.deadZone = 0;
  RateHand hand({}, options, {}, makeInputSource(node, events.open()));
  events.send(EV_KEY, KEY_RIGHT, 1);
  events.sync();
  ASSERT_TRUE(until([&] { return std::abs(hand.read().velocity.x - 0.15) < 1e-12; }));
  for (int i = 0; i < 200; ++i) hand.read();
  ASSERT_TRUE(until([&] { return hand.read().velocity.x > 0; })) << "it goes on though no event comes";
  events.unplug();
  EXPECT_TRUE(until([&] { return !hand.read().valid; }));
  EXPECT_EQ(hand.health(), haptics::DeviceHealth::Lost);
}

TEST(InputHands, ThePensPlaceIsTheHands) {
  Events events;
  InputNode node;
  node.kind = InputKind::Tablet;
  node.axes[ABS_X] = {0, 10'000};
  node.axes[ABS_Y] = {0, 6'000};
  const auto hand = makeTabletHand(node, 0.15, {-0.1, 0, 0}, events.open());
  EXPECT_EQ(hand->read().position, (Vec3{-0.1, 0, 0})) << "until the pen is near";
  events.send(EV_KEY, BTN_TOOL_PEN, 1);
  events.send(EV_ABS, ABS_X, 7'500);
  events.send(EV_ABS, ABS_Y, 1'500);
  events.sync(os::now());
  EXPECT_TRUE(until([&] { return norm(hand->read().position - Vec3{0.075, 0.075, 0}) < 1e-6; }));
  events.unplug();
  EXPECT_TRUE(until([&] { return !hand->read().valid; }));
}

}  // namespace
}  // namespace reachlab::devices
