#include "devices/input/event_node.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/fault.h"
#include "base/system/os.h"
#include "devices/driver/registry.h"
#include "sim/trial/task_places.h"
#include "tests/devices/driver_answers.h"
#include "tests/devices/fakes/fake_input.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/until.h"

namespace reachlab::devices {
namespace {

using test::fakeInputs;

/// A folder of files that stand for event nodes.
class EventNodes : public ::testing::Test {
 protected:
  ~EventNodes() override {
    fakeInputs().nodes.clear();
    fakeInputs().listed.reset();
  }
  std::string put(const std::string& name, const test::FakeInput& node) const {
    const std::string path = (folder / name).string();
    std::ofstream out(path);
    fakeInputs().nodes[path] = node;
    return path;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const TabletNode& node : findTablets(folder.path())) found.push_back(node.name);
    return found;
  }
  TemporaryFolder folder;
};

using Names = std::vector<std::string>;

TEST_F(EventNodes, ATabletHasAPenAndBothAxes) {
  put("event0", {.name = "pen", .keys = {BTN_TOOL_PEN, BTN_TOUCH}, .axes = {ABS_X, ABS_Y}});
  put("event1", {.name = "no pen", .keys = {BTN_GAMEPAD}, .axes = {ABS_X, ABS_Y}});
  put("event2", {.name = "no y", .keys = {BTN_TOOL_PEN}, .axes = {ABS_X}});
  put("event3", {.name = "no x", .keys = {BTN_TOOL_PEN}, .axes = {ABS_Y}});
  put("mouse0", {.name = "no event node", .keys = {BTN_TOOL_PEN}, .axes = {ABS_X, ABS_Y}});
  EXPECT_EQ(names(), Names{"pen"});
}

TEST_F(EventNodes, AreInTheOrderOfTheirNumbers) {
  for (const char* number : {"10", "9", "2", "100"})
    put(std::string("event") + number, {.name = number, .keys = {BTN_TOOL_PEN}, .axes = {ABS_X, ABS_Y}});
  EXPECT_EQ(names(), (Names{"2", "9", "10", "100"}));
}

TEST_F(EventNodes, TellTheRangesOfTheirAxes) {
  const std::string path =
      put("event7", {.name = "pen", .keys = {BTN_TOOL_PEN}, .axes = {ABS_X, ABS_Y}, .ranges = {{ABS_X, {-5, 250, 20}}}});
  const auto found = findTablets(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, path);
  EXPECT_EQ(found[0].whyNot, "");
  EXPECT_EQ(found[0].x.least, -5);
  EXPECT_EQ(found[0].x.most, 250);
  EXPECT_EQ(found[0].x.perMm, 20);
  EXPECT_FALSE(found[0].y.there());
}

TEST_F(EventNodes, OneThatCannotBeOpenedIsListedWithTheSystemsWords) {
  std::filesystem::create_symlink(folder / "nowhere", folder / "event3");
  const auto found = findTablets(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].whyNot, (folder / "event3").string() + ": No such file or directory");
  EXPECT_TRUE(findTablets((folder / "none").string()).empty());
}

TEST(InputAxis, ValuesAreAboutItsMiddleAndWithinItsRange) {
  const InputAxis axis{-10, 30};
  EXPECT_TRUE(axis.there());
  for (const auto& [value, from] : {std::pair{10, 0}, {15, 5}, {-10, -20}, {30, 20}, {31, 20}, {-99, -20}})
    EXPECT_EQ(axis.fromMiddle(value), from) << value;
  const InputAxis all{INT32_MIN, INT32_MAX};
  EXPECT_EQ(all.fromMiddle(INT32_MAX), all.half()) << "beyond what an int holds";
  for (const InputAxis& none : {InputAxis{}, InputAxis{5, 5}, InputAxis{5, 4}}) {
    EXPECT_FALSE(none.there());
    EXPECT_EQ(none.fromMiddle(7), 0);
  }
}

using Told = std::vector<std::array<int, 3>>;

PenState told(const Told& events, int perMmX = 0, int perMmY = 0) {
  PenState state({.path = {}, .name = {}, .x = {0, 100, perMmX}, .y = {0, 200, perMmY}, .whyNot = {}});
  for (const auto& [type, code, value] : events) {
    input_event e{};
    e.type = static_cast<std::uint16_t>(type), e.code = static_cast<std::uint16_t>(code), e.value = value;
    EXPECT_EQ(state.take(e), type == EV_SYN && code == SYN_REPORT);
  }
  return state;
}

TEST(PenState, TheOnlyButtonIsThePensTouch) {
  EXPECT_EQ(told({{EV_KEY, BTN_TOUCH, 1}}).buttons(), 1u);
  EXPECT_EQ(told({{EV_KEY, BTN_TOUCH, 1}, {EV_KEY, BTN_TOUCH, 0}}).buttons(), 0u);
  for (const int code : {int{KEY_SPACE}, int{BTN_TOOL_PEN}}) EXPECT_EQ(told({{EV_KEY, code, 1}}).buttons(), 0u) << code;
}

TEST(PenState, APenIsAtItsPlaceWhileItIsNear) {
  EXPECT_FALSE(told({{EV_KEY, BTN_TOOL_PEN, 1}, {EV_ABS, ABS_X, 75}, {EV_SYN, SYN_REPORT, 0}}).position()) << "y is not told";
  EXPECT_FALSE(told({{EV_KEY, BTN_TOOL_PEN, 1}, {EV_ABS, ABS_Y, 75}}).position());
  const Told near{{EV_KEY, BTN_TOOL_PEN, 1}, {EV_ABS, ABS_X, 75}, {EV_ABS, ABS_Y, 50}};
  EXPECT_EQ(told(near).position(), (Vec3{0.5, 1, 0})) << "up is up, and a unit is a unit";
  EXPECT_EQ(told(near, 4, 8).position(), (Vec3{0.5, 0.5, 0})) << "6.25 mm along either axis of a tablet of 25 mm by 25 mm";
  EXPECT_EQ(told(near, 4, 0).position(), (Vec3{0.5, 1, 0}));
  Told away = near;
  away.push_back({EV_KEY, BTN_TOOL_PEN, 0});
  EXPECT_FALSE(told(away).position());
}

TEST(InputPort, GivesWholeEventsAndIsGoneAtTheEnd) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  InputPort port("/proc/self/fd/" + std::to_string(ends[0]));
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
  ::close(ends[0]);
}

TEST(InputPort, APathThatIsNotThereIsRefusedInTheSystemsWords) {
  EXPECT_EQ(reachlab::refusalOf([&] { InputPort port("/dev/input/no-such-event"); }),
            "/dev/input/no-such-event: No such file or directory");
}

/// Nodes that the system is said to have, behind the driver.
class TabletDevices : public EventNodes, public DriverAnswers {
 protected:
  TabletNode fifo(const std::string& name, const std::string& title) {
    const TabletNode node{.path = (folder / name).string(), .name = title, .x = {0, 100}, .y = {0, 100}, .whyNot = {}};
    EXPECT_EQ(::mkfifo(node.path.c_str(), 0600), 0);
    return node;
  }
  static TabletNode closed() { return {.path = "/dev/input/event99", .name = {}, .x = {}, .y = {}, .whyNot = "not for you"}; }
};

TEST_F(TabletDevices, AreListedByTheNameThatOpensThem) {
  const TabletNode pen = fifo("event1", "Pen");
  fakeInputs().listed = {closed(), pen};
  const auto found = rows("tablet");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "tablet:" + pen.path);
  EXPECT_EQ(found[0].description, "Pen");
  EXPECT_TRUE(found[0].present);
  EXPECT_EQ(found[0].rate, make("tablet")->info().rate);
  EXPECT_EQ(found[0].degreesOfFreedom, 2);
  fakeInputs().listed = {closed()};
  EXPECT_FALSE(rows("tablet").at(0).present);
  EXPECT_EQ(rows("tablet").at(0).whyNot, "not for you");
  fakeInputs().listed.emplace();
  EXPECT_EQ(rows("tablet").at(0).whyNot, "no tablet is among /dev/input/event*");
}

TEST_F(TabletDevices, TheFirstThatCanBeOpenedIsTakenOrTheOneThatIsNamed) {
  const TabletNode one = fifo("event0", "One"), two = fifo("event1", "");
  fakeInputs().listed = {closed(), one, two};
  EXPECT_EQ(make("tablet")->info().name, "One");
  EXPECT_EQ(make("tablet:" + two.path)->info().name, "tablet") << "a tablet without a name";
  EXPECT_EQ(refusalOf("tablet:" + closed().path), "device tablet:" + closed().path + ": not for you");
  EXPECT_EQ(refusalOf("tablet:/nowhere"), "device tablet:/nowhere: no tablet is among /dev/input/event*");
}

TEST_F(TabletDevices, TheirOptionsAreBounded) {
  fakeInputs().listed = {fifo("event2", "")};
  for (const char* good : {"half-width=0.01", "half-width=2"}) EXPECT_EQ(refusalOf(std::string("tablet,") + good), "made") << good;
  for (const char* bad : {"half-width=0.0099", "half-width=2.01", "gain=1"})
    EXPECT_THROW(make(std::string("tablet,") + bad), FaultError) << bad;
}

// Half a tablet to the right of its middle and as far up. Unplugged it is lost.
TEST_F(TabletDevices, ATabletsHalfWidthIsFifteenCentimetresUnlessItIsTold) {
  const TabletNode pen = fifo("event2", "Pen");
  fakeInputs().listed = {pen};
  for (const auto& [spec, place] : {std::pair{"tablet", 0.075}, {"tablet,half-width=0.4", 0.2}}) {
    const auto hand = make(spec);
    EXPECT_EQ(hand->info().name, "Pen");
    EXPECT_EQ(hand->info().version, "evdev");
    EXPECT_EQ(hand->info().rate, 200);
    EXPECT_EQ(hand->info().degreesOfFreedom, 2);
    EXPECT_EQ(hand->health(), haptics::DeviceHealth::Ready);
    EXPECT_EQ(hand->read().position, trial::startOf(experiment::CompiledExperiment(experiment))) << "until the pen is near";
    std::ofstream wire(pen.path, std::ios::binary | std::ios::in);
    const std::int64_t now = os::now();
    const auto send = [&](std::uint16_t type, std::uint16_t code, int value) {
      input_event e{};
      e.input_event_sec = now / 1'000'000'000, e.input_event_usec = now % 1'000'000'000 / 1000;
      e.type = type, e.code = code, e.value = value;
      wire.write(reinterpret_cast<const char*>(&e), sizeof e).flush();
    };
    send(EV_KEY, BTN_TOOL_PEN, 1), send(EV_KEY, BTN_TOUCH, 1), send(EV_ABS, ABS_X, 75), send(EV_ABS, ABS_Y, 25),
        send(EV_SYN, SYN_REPORT, 0);
    haptics::DeviceSample sample;
    const Vec3 there{place, place, 0};
    EXPECT_TRUE(test::until([&] { return norm((sample = hand->read()).position - there) < 1e-6; })) << sample.position.x;
    EXPECT_EQ(sample.buttons, 1u);
    EXPECT_TRUE(sample.valid);
    wire.close();
    EXPECT_TRUE(test::until([&] { return !hand->read().valid && hand->health() == haptics::DeviceHealth::Lost; }));
  }
}

}  // namespace
}  // namespace reachlab::devices
