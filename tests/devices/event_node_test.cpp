#include "devices/input/event_node.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/os.h"
#include "devices/driver/registry.h"
#include "devices/make_device.h"
#include "tests/devices/driver_answers.h"
#include "tests/devices/fakes/fake_input.h"
#include "tests/until.h"

namespace reachlab::devices {
namespace {

using test::fakeInputs;

/// A folder of files that stand for event nodes.
class EventNodes : public ::testing::Test {
 protected:
  EventNodes() : folder(std::filesystem::temp_directory_path() / ("reach-input-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder);
    folder = std::filesystem::canonical(folder);
  }
  ~EventNodes() override {
    std::filesystem::remove_all(folder);
    fakeInputs().nodes.clear();
    fakeInputs().listed.reset();
  }
  std::string put(const std::string& name, const test::FakeInput& node) const {
    const std::string path = (folder / name).string();
    std::ofstream out(path);
    fakeInputs().nodes[path] = node;
    return path;
  }
  std::vector<std::string> names(InputKind kind) const {
    std::vector<std::string> found;
    for (const InputNode& node : findInputNodes(kind, folder.string())) found.push_back(node.name);
    return found;
  }
  std::filesystem::path folder;
};

const std::vector<int> kArrows{KEY_LEFT, KEY_RIGHT, KEY_UP, KEY_DOWN, KEY_A};
using Names = std::vector<std::string>;

std::vector<int> without(std::vector<int> list, int one) {
  std::erase(list, one);
  return list;
}

TEST_F(EventNodes, AreToldApartByWhatTheyHave) {
  put("event0", {.name = "keys", .keys = kArrows});
  put("event1", {.name = "pad", .keys = {BTN_GAMEPAD}, .axes = {ABS_X, ABS_Y}});
  put("event2", {.name = "stick", .keys = {BTN_JOYSTICK}, .axes = {ABS_X, ABS_Y}});
  put("event3", {.name = "pen", .keys = {BTN_TOOL_PEN}, .axes = {ABS_X, ABS_Y}});
  put("event4", {.name = "neither", .keys = {KEY_A}, .axes = {ABS_X}});
  put("mouse0", {.name = "no event node", .keys = kArrows});
  EXPECT_EQ(names(InputKind::Keyboard), Names{"keys"});
  EXPECT_EQ(names(InputKind::Gamepad), (Names{"pad", "stick"}));
  EXPECT_EQ(names(InputKind::Tablet), Names{"pen"});
}

TEST_F(EventNodes, NothingMayBeMissing) {
  for (const int key : kArrows) put("event" + std::to_string(key), {.name = "k", .keys = without(kArrows, key)});
  put("event500", {.name = "a", .keys = {BTN_GAMEPAD, BTN_TOOL_PEN}, .axes = {ABS_X}});
  put("event501", {.name = "b", .keys = {BTN_JOYSTICK, BTN_TOOL_PEN}, .axes = {ABS_Y}});
  put("event502", {.name = "c", .axes = {ABS_X, ABS_Y}});
  for (const InputKind kind : {InputKind::Keyboard, InputKind::Gamepad, InputKind::Tablet}) EXPECT_EQ(names(kind), Names{});
}

TEST_F(EventNodes, AreInTheOrderOfTheirNumbers) {
  for (const char* number : {"10", "9", "2", "100"}) put(std::string("event") + number, {.name = number, .keys = kArrows});
  EXPECT_EQ(names(InputKind::Keyboard), (Names{"2", "9", "10", "100"}));
}

TEST_F(EventNodes, TellTheRangesOfTheirAxes) {
  test::FakeInput pad{.name = "pad", .keys = {BTN_GAMEPAD}, .axes = {ABS_X, ABS_Y}, .ranges = {{ABS_X, {-5, 250}}, {ABS_RY, {0, 9}}}};
  const std::string path = put("event7", pad);
  const auto found = findInputNodes(InputKind::Gamepad, folder.string());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, path);
  EXPECT_EQ(found[0].whyNot, "");
  EXPECT_EQ(found[0].kind, InputKind::Gamepad);
  EXPECT_EQ(found[0].axes[ABS_X].least, -5);
  EXPECT_EQ(found[0].axes[ABS_X].most, 250);
  EXPECT_EQ(found[0].axes[ABS_RY].most, 9);
  EXPECT_FALSE(found[0].axes[ABS_Y].there());
}

TEST_F(EventNodes, OneThatCannotBeOpenedIsListedWithTheSystemsWords) {
  std::filesystem::create_symlink(folder / "nowhere", folder / "event3");
  const auto found = findInputNodes(InputKind::Tablet, folder.string());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].whyNot, (folder / "event3").string() + ": No such file or directory");
  EXPECT_TRUE(findInputNodes(InputKind::Tablet, (folder / "none").string()).empty());
}

TEST(InputAxis, SharesAreAboutItsMiddle) {
  const InputAxis axis{-10, 30};
  EXPECT_TRUE(axis.there());
  EXPECT_EQ(axis.share(10), 0);
  EXPECT_EQ(axis.share(15), 0.25);
  EXPECT_EQ(axis.share(-10), -1);
  EXPECT_EQ(axis.share(30), 1);
  EXPECT_EQ(axis.share(31), 1);
  EXPECT_EQ(axis.share(-99), -1);
  EXPECT_EQ((InputAxis{INT32_MIN, INT32_MAX}.share(INT32_MAX)), 1) << "beyond what an int holds";
  for (const InputAxis& none : {InputAxis{}, InputAxis{5, 5}, InputAxis{5, 4}}) {
    EXPECT_FALSE(none.there());
    EXPECT_EQ(none.share(7), 0);
  }
}

InputState told(InputKind kind, const std::vector<std::array<int, 3>>& events) {
  InputNode node;
  node.kind = kind;
  node.axes[ABS_X] = {0, 100}, node.axes[ABS_Y] = {0, 200}, node.axes[ABS_RY] = {-50, 50};
  InputState state(node);
  for (const auto& [type, code, value] : events) {
    input_event e{};
    e.type = static_cast<std::uint16_t>(type), e.code = static_cast<std::uint16_t>(code), e.value = value;
    EXPECT_EQ(state.take(e), type == EV_SYN && code == SYN_REPORT);
  }
  return state;
}

TEST(InputState, EachKeyHasItsWay) {
  const std::vector<std::pair<int, Vec3>> ways{{KEY_RIGHT, {1, 0, 0}}, {KEY_LEFT, {-1, 0, 0}},   {KEY_UP, {0, 1, 0}},
                                               {KEY_DOWN, {0, -1, 0}}, {KEY_PAGEUP, {0, 0, -1}}, {KEY_PAGEDOWN, {0, 0, 1}}};
  for (const auto& [key, way] : ways) {
    EXPECT_EQ(told(InputKind::Keyboard, {{EV_KEY, key, 1}}).deflection().push, way) << key;
    EXPECT_EQ(told(InputKind::Keyboard, {{EV_KEY, key, 1}, {EV_KEY, key, 0}}).deflection().push, Vec3{}) << key;
  }
  EXPECT_EQ(told(InputKind::Keyboard, {{EV_REL, KEY_RIGHT, 1}, {EV_SYN, SYN_DROPPED, 0}}).deflection().push, Vec3{});
}

TEST(InputState, TheRightSticksSecondAxisIsTowardsTheUser) {
  const Deflection d = told(InputKind::Gamepad, {{EV_ABS, ABS_X, 75}, {EV_ABS, ABS_Y, 150}, {EV_ABS, ABS_RY, 10}}).deflection();
  EXPECT_EQ(d.push, (Vec3{0.5, -0.5, 0.2}));
  EXPECT_EQ(told(InputKind::Gamepad, {{EV_ABS, ABS_CNT, 5}}).deflection().push, Vec3{}) << "no axis that there is";
}

TEST(InputState, ButtonsAreCountedFromTheFirstOfTheirKind) {
  const auto buttons = [](int code) { return told(InputKind::Gamepad, {{EV_KEY, code, 1}}).buttons(); };
  EXPECT_EQ(buttons(KEY_SPACE), 1u);
  EXPECT_EQ(buttons(BTN_TOUCH), 1u);
  EXPECT_EQ(buttons(BTN_JOYSTICK), 1u);
  EXPECT_EQ(buttons(BTN_JOYSTICK + 5), 1u << 5);
  EXPECT_EQ(buttons(BTN_JOYSTICK + 15), 1u << 15);
  EXPECT_EQ(buttons(BTN_GAMEPAD), 1u);
  EXPECT_EQ(buttons(BTN_GAMEPAD + 14), 1u << 14);
  for (const int code : {BTN_JOYSTICK - 1, BTN_GAMEPAD + 15, int{KEY_A}, int{BTN_TOOL_PEN}}) EXPECT_EQ(buttons(code), 0u) << code;
  const InputState two = told(InputKind::Gamepad, {{EV_KEY, BTN_GAMEPAD, 1}, {EV_KEY, BTN_GAMEPAD + 2, 1}, {EV_KEY, BTN_GAMEPAD, 0}});
  EXPECT_EQ(two.buttons(), 4u);
  EXPECT_EQ(two.deflection().buttons, 4u);
}

TEST(InputState, APenIsAtItsPlaceWhileItIsNear) {
  double x = 9, y = 9;
  EXPECT_FALSE(told(InputKind::Tablet, {{EV_KEY, BTN_TOOL_PEN, 1}, {EV_ABS, ABS_X, 75}}).pen(x, y)) << "half a place is none";
  EXPECT_FALSE(told(InputKind::Tablet, {{EV_KEY, BTN_TOOL_PEN, 1}, {EV_ABS, ABS_Y, 75}}).pen(x, y));
  EXPECT_EQ(x, 9);
  const std::vector<std::array<int, 3>> near{{EV_KEY, BTN_TOOL_PEN, 1}, {EV_ABS, ABS_X, 75}, {EV_ABS, ABS_Y, 50}};
  EXPECT_TRUE(told(InputKind::Tablet, near).pen(x, y));
  EXPECT_EQ(x, 0.5);
  EXPECT_EQ(y, 0.5) << "up is up";
  auto away = near;
  away.push_back({EV_KEY, BTN_TOOL_PEN, 0});
  EXPECT_FALSE(told(InputKind::Tablet, away).pen(x, y));
}

TEST(InputPort, GivesWholeEventsAndIsGoneAtTheEnd) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  InputPort port(ends[0]);
  std::array<input_event, 4> events{};
  EXPECT_EQ(port.read(events, 0), 0) << "none";
  std::array<input_event, 6> sent{};
  for (int i = 0; i < 6; ++i) sent[static_cast<std::size_t>(i)].value = 10 + i;
  ASSERT_EQ(::write(ends[1], sent.data(), sizeof sent), static_cast<ssize_t>(sizeof sent));
  EXPECT_EQ(port.read(events, 0), 4);
  EXPECT_EQ(events[3].value, 13);
  EXPECT_EQ(port.read(events, 0), 2);
  EXPECT_EQ(events[1].value, 15);
  ::close(ends[1]);
  EXPECT_EQ(port.read(events, 0), -1);
}

TEST(InputPort, APathThatIsNotThereIsRefusedInTheSystemsWords) {
  try {
    InputPort port("/dev/input/no-such-event");
    FAIL();
  } catch (const ResourceError& error) {
    EXPECT_STREQ(error.what(), "/dev/input/no-such-event: No such file or directory");
  }
}

/// Nodes that the system is said to have, behind the drivers.
class InputDevices : public EventNodes, public DriverAnswers {
 protected:
  InputNode fifo(const std::string& name, InputKind kind, const std::string& title) {
    InputNode node;
    node.path = (folder / name).string();
    node.name = title;
    node.kind = kind;
    node.axes[ABS_X] = {0, 100}, node.axes[ABS_Y] = {0, 100};
    EXPECT_EQ(::mkfifo(node.path.c_str(), 0600), 0);
    return node;
  }
};

TEST_F(InputDevices, AreListedByTheNameThatOpensThem) {
  const InputNode keys = fifo("event0", InputKind::Keyboard, "Keys"), pen = fifo("event1", InputKind::Tablet, "");
  InputNode closed = keys;
  closed.whyNot = "not for you";
  fakeInputs().listed = {closed, keys, pen};
  const auto found = rows("keyboard");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "keyboard:" + keys.path);
  EXPECT_EQ(found[0].description, "Keys");
  EXPECT_TRUE(found[0].present);
  EXPECT_EQ(found[0].rate, 125);
  EXPECT_EQ(found[0].degreesOfFreedom, 3);
  EXPECT_EQ(rows("tablet").at(0).degreesOfFreedom, 2);
  EXPECT_EQ(rows("gamepad").at(0).whyNot, "no gamepad is among /dev/input/event*");
  fakeInputs().listed = {closed};
  EXPECT_FALSE(rows("keyboard").at(0).present);
  EXPECT_EQ(rows("keyboard").at(0).whyNot, "not for you");
  EXPECT_EQ(rows("tablet").at(0).whyNot, "no tablet is among /dev/input/event*");
}

TEST_F(InputDevices, TheFirstThatCanBeOpenedIsTakenOrTheOneThatIsNamed) {
  const InputNode one = fifo("event0", InputKind::Keyboard, "One"), two = fifo("event1", InputKind::Keyboard, "");
  InputNode closed = one;
  closed.path += "x";
  closed.whyNot = "not for you";
  fakeInputs().listed = {closed, one, two};
  EXPECT_EQ(make("keyboard")->info().name, "One");
  EXPECT_EQ(make("keyboard:" + two.path)->info().name, "keyboard") << "one that has no name";
  EXPECT_EQ(make("keyboard")->info().version, "evdev");
  EXPECT_EQ(make("keyboard")->info().rate, 125);
  EXPECT_EQ(refusalOf("keyboard:" + closed.path), "device keyboard:" + closed.path + ": not for you");
  EXPECT_EQ(refusalOf("keyboard:/nowhere"), "device keyboard:/nowhere: no keyboard is among /dev/input/event*");
  EXPECT_EQ(refusalOf("gamepad"), "device gamepad: no gamepad is among /dev/input/event*");
  EXPECT_EQ(refusalOf("tablet"), "device tablet: no tablet is among /dev/input/event*");
}

TEST_F(InputDevices, TheirOptionsAreBounded) {
  fakeInputs().listed = {fifo("event0", InputKind::Keyboard, ""), fifo("event1", InputKind::Gamepad, ""),
                         fifo("event2", InputKind::Tablet, "")};
  for (const std::string kind : {"keyboard", "gamepad"}) {
    for (const char* good : {"gain=0.01", "gain=5", "dead-zone=0", "dead-zone=0.5"})
      EXPECT_EQ(refusalOf(kind + "," + good), "made") << good;
    for (const char* bad : {"gain=0.0099", "gain=5.01", "dead-zone=-0.01", "dead-zone=0.51", "half-width=1"})
      EXPECT_THROW(make(kind + "," + bad), FaultError) << kind << bad;
  }
  for (const char* good : {"half-width=0.01", "half-width=2"}) EXPECT_EQ(refusalOf(std::string("tablet,") + good), "made") << good;
  for (const char* bad : {"half-width=0.0099", "half-width=2.01", "gain=1"})
    EXPECT_THROW(make(std::string("tablet,") + bad), FaultError) << bad;
}

// Held to the right by a key, or by a stick at its end: the hand's speed is the gain.
TEST_F(InputDevices, MoveByTheirUsualGain) {
  const InputNode keys = fifo("event0", InputKind::Keyboard, ""), pad = fifo("event1", InputKind::Gamepad, "");
  fakeInputs().listed = {keys, pad};
  const auto speedOf = [&](const std::string& spec, const InputNode& node, std::uint16_t type, std::uint16_t code, int value) {
    std::ofstream keepsOpen;
    const auto hand = make(spec);
    keepsOpen.open(node.path, std::ios::binary | std::ios::in);
    input_event sent[2] = {};
    sent[0].type = type, sent[0].code = code, sent[0].value = value;
    sent[1].type = EV_SYN;
    keepsOpen.write(reinterpret_cast<const char*>(sent), sizeof sent).flush();
    double speed = 0;
    test::until([&] { return (speed = hand->read().velocity.x) > 0; });
    return speed;
  };
  EXPECT_EQ(speedOf("keyboard", keys, EV_KEY, KEY_RIGHT, 1), 0.15);
  EXPECT_EQ(speedOf("gamepad", pad, EV_ABS, ABS_X, 100), 0.5);
  EXPECT_NEAR(speedOf("gamepad,gain=2", pad, EV_ABS, ABS_X, 75), 2 * (0.5 - 0.1) / 0.9, 1e-12) << "beyond a dead zone of a tenth";
}

// Half a tablet to the right of its middle.
TEST_F(InputDevices, ATabletsHalfWidthIsFifteenCentimetresUnlessItIsTold) {
  const InputNode pen = fifo("event2", InputKind::Tablet, "Pen");
  fakeInputs().listed = {pen};
  for (const auto& [spec, place] : {std::pair{"tablet", 0.075}, {"tablet,half-width=0.4", 0.2}}) {
    const auto hand = make(spec);
    EXPECT_EQ(hand->info().name, "Pen");
    EXPECT_EQ(hand->info().version, "evdev");
    EXPECT_EQ(hand->info().rate, 200);
    EXPECT_EQ(hand->info().degreesOfFreedom, 2);
    EXPECT_EQ(hand->health(), haptics::DeviceHealth::Ready);
    std::ofstream wire(pen.path, std::ios::binary | std::ios::in);
    const std::int64_t now = os::now();
    const auto send = [&](std::uint16_t type, std::uint16_t code, int value) {
      input_event e{};
      e.input_event_sec = now / 1'000'000'000, e.input_event_usec = now % 1'000'000'000 / 1000;
      e.type = type, e.code = code, e.value = value;
      wire.write(reinterpret_cast<const char*>(&e), sizeof e).flush();
    };
    send(EV_KEY, BTN_TOOL_PEN, 1), send(EV_KEY, BTN_TOUCH, 1), send(EV_ABS, ABS_X, 75), send(EV_ABS, ABS_Y, 50),
        send(EV_SYN, SYN_REPORT, 0);
    haptics::DeviceSample sample;
    EXPECT_TRUE(test::until([&] { return std::abs((sample = hand->read()).position.x - place) < 1e-6; })) << sample.position.x;
    EXPECT_EQ(sample.buttons, 1u);
    EXPECT_TRUE(sample.valid);
  }
}

}  // namespace
}  // namespace reachlab::devices
