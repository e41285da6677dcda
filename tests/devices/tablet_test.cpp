#include "devices/input/tablet.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <utility>

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

TEST(Tablet, ThePensPlaceIsTheHands) {
  Events events;
  TabletNode node;
  node.x = {0, 10'000};
  node.y = {0, 6'000};
  const auto hand = makeTabletHand(node, 0.15, {-0.1, 0, 0}, events.open());
  EXPECT_EQ(hand->read().position, (Vec3{-0.1, 0, 0})) << "until the pen is near";
  events.send(EV_KEY, BTN_TOOL_PEN, 1);
  events.send(EV_ABS, ABS_X, 7'500);
  events.send(EV_ABS, ABS_Y, 1'500);
  events.sync(os::now());
  EXPECT_TRUE(until([&] { return norm(hand->read().position - Vec3{0.075, 0.075, 0}) < 1e-6; }));
  events.unplug();
  EXPECT_TRUE(until([&] { return !hand->read().valid; }));
  EXPECT_EQ(hand->health(), haptics::DeviceHealth::Lost);
}

}  // namespace
}  // namespace reachlab::devices
