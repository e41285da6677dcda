#include "devices/driver/registry.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "base/device_options.h"
#include "base/error.h"
#include "base/fault.h"
#include "devices/hands/several_hands.h"
#include "devices/make_device.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/trial/task_places.h"
#include "tests/devices/driver_answers.h"
#include "tests/devices/fakes/fake_dhd.h"
#include "tests/devices/fakes/fake_hd.h"
#include "tests/haptics/set_device.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

using haptics::test::SetDevice;

TEST(Registry, EveryDriverIsListedOnceUnderItsNameAndSaysWhyItIsNotThere) {
  test::resetFakeHd();
  test::resetFakeDhd();
  std::set<std::string> kinds;
  for (const FoundDevice& row : findDevices()) {
    kinds.insert(row.kind);
    EXPECT_FALSE(row.description.empty()) << row.name;
    EXPECT_EQ(row.present, row.whyNot.empty()) << row.name;
    EXPECT_TRUE(row.name == row.kind || row.name.starts_with(row.kind + ":")) << row.name;
    EXPECT_NE(findDriver(row.kind), nullptr);
  }
  EXPECT_EQ(kinds.size(), deviceDrivers().size());
  EXPECT_EQ(findDriver("nothing"), nullptr);
}

class MakeDevice : public ::testing::Test, public DriverAnswers {};

TEST_F(MakeDevice, AnUnknownOneIsRefusedWithAllThatThereAreAndTheNearestName) {
  const std::string said = refusalOf("joystick");
  for (const DeviceDriver& driver : deviceDrivers()) EXPECT_TRUE(holds(said, driver.name)) << driver.name;
  EXPECT_TRUE(holds(refusalOf("phantm:Left"), "device: is phantm:Left, which is unknown; did you mean phantom?"));
}

// What is asked for is read before the arm is looked for, which is not connected.
TEST_F(MakeDevice, AnArmsLargestCurrentIsFromTenMilliamperesToSixAmperes) {
  for (const std::string good : {"0.01", "0.012", "6"}) EXPECT_THROW(make("hid:no-such-arm,max-current=" + good), ResourceError) << good;
  for (const std::string bad : {"0.0099", "6.01", "0", "-1"}) EXPECT_THROW(make("hid:no-such-arm,max-current=" + bad), FaultError) << bad;
}

TEST(DeviceOptions, TakeWhatIsKnownAndRefuseTheRest) {
  DeviceOptions options("SN1,gain=0.5,mode=fast,other=x=y,flag", "device x");
  EXPECT_EQ(options.plain(), "SN1");
  EXPECT_EQ(options.number("gain", 1, 0, 2), 0.5);
  EXPECT_EQ(options.number("absent", 7, 0, 9), 7);
  EXPECT_EQ(options.count("absent", 7, 0, 9), 7);
  EXPECT_EQ(options.word("mode", {"slow", "fast"}), "fast");
  EXPECT_EQ(options.take("flag"), "") << "a key without a value";
  EXPECT_EQ(options.take("mode"), std::nullopt) << "taken";
  EXPECT_THROW(options.done(), FaultError);
  EXPECT_EQ(options.rest(), "other=x=y");
  EXPECT_NO_THROW(options.done());
  for (const char* text : {"", "a=1"}) EXPECT_EQ(DeviceOptions(text, "device x").plain(), "");
  for (const char* bad : {"gain=3", "gain=-1", "gain=", "gain=1x", "gain=nan"}) {
    DeviceOptions wrong(bad, "device x");
    EXPECT_THROW(wrong.number("gain", 1, 0, 2), FaultError) << bad;
  }
}

TEST(DeviceOptions, WhatIsWrongIsSaidWithWhatIsAllowed) {
  EXPECT_EQ(refusalOf([] { DeviceOptions("a=1,b=1,a=2", "device x"); }), "device: device x: a is given twice");
  DeviceOptions options("gain=2.5,mode=slow,other=1", "device x");
  EXPECT_EQ(refusalOf([&] { DeviceOptions(options).number("gain", 1, 0, 2); }),
            "device: device x: gain=2.5; allowed: a number from 0 to 2");
  EXPECT_EQ(refusalOf([&] { DeviceOptions(options).count("gain", 1, 0, 9); }),
            "device: device x: gain=2.5; allowed: a whole number from 0 to 9");
  EXPECT_EQ(refusalOf([&] { DeviceOptions(options).word("mode", {"a", "b"}); }), "device: device x: mode=slow; allowed: a, b");
  EXPECT_EQ(refusalOf([&] { options.done(); }), "device: device x: gain is not known; allowed: nothing behind the name");
  EXPECT_EQ(options.number("gain", 1, 2.5, 2.5), 2.5) << "both bounds are within";
  EXPECT_EQ(options.word("absent", {"first", "second"}), "first");
  (void)options.word("mode", {"slow"});
  EXPECT_EQ(refusalOf([&] { options.done(); }), "device: device x: other is not known; allowed: gain, absent, mode");
}

TEST(Registry, AHandBeginsWhereItsTaskDoes) {
  experiment::Experiment experiment = experiment::readExperiment("free-point");
  experiment.task->start = {0.01, -0.02, 0.03};
  EXPECT_EQ(trial::startOf(experiment::CompiledExperiment(experiment)), (Vec3{0.01, -0.02, 0.03}));
  experiment.task.reset();
  EXPECT_EQ(trial::startOf(experiment::CompiledExperiment(experiment)), Vec3{});
}

TEST_F(MakeDevice, AResourcesWordsSayWhichDeviceWasAskedFor) {
  EXPECT_TRUE(refusalOf("replay:/nowhere").starts_with("device replay: /nowhere: no such file"));
}

// One of a kind that is not made by the program may be one device twice; those that are made there are as many of as are asked for.
TEST_F(MakeDevice, OfSeveralHandsEachHasADeviceOfItsOwn) {
  experiment = experiment::readExperiment("chain-two-hands");
  EXPECT_EQ(
      refusalOf("hid:A + hid"),
      "device: is hid:A + hid, which may be one device twice; allowed: hid[:SERIAL][,model=NAME,max-current=A,calibrate=start], each by a name "
      "of its own");
  EXPECT_TRUE(holds(refusalOf("hid + hid:A"), "twice"));
  EXPECT_TRUE(holds(refusalOf("hid:A + simulated + hid:A"), "twice"));
  EXPECT_FALSE(holds(refusalOf("hid:A + hid:B"), "twice")) << "two";
  EXPECT_EQ(refusalOf("simulated + simulated"), "made");
  // Subjects of one seed move each in its own way, and the first as it would alone.
  const auto device = makeDevice("simulated + simulated + simulated", experiment, 5);
  const auto alone = makeDevice("simulated", experiment, 5);
  ASSERT_EQ(device->hands().size(), 3u);
  for (haptics::HapticDevice* one : {device.get(), alone.get()}) {
    one->prepareTrial(0);
    one->cue(haptics::Cue::Place);
    one->cue(haptics::Cue::Go);
  }
  Vec3 first, second, third, own;
  for (int i = 0; i < 900; ++i) {
    first = device->read().position;
    second = device->hands()[1]->read().position;
    third = device->hands()[2]->read().position;
    own = alone->read().position;
  }
  EXPECT_EQ(first, own);
  EXPECT_FALSE(second == first);
  EXPECT_FALSE(third == first);
  EXPECT_FALSE(third == second);
}

TEST_F(MakeDevice, AReplayOffersEachOfItsReachesOnceAndAllElseOneTrial) {
  EXPECT_EQ(trialsOnOffer("simulated"), 1);
  EXPECT_EQ(trialsOnOffer("replay"), 1);
  const std::string reaches = "replay:" + experiment::resourceFolder() + "/reaches";
  EXPECT_EQ(trialsOnOffer(reaches), 19);
  EXPECT_EQ(trialsOnOffer("simulated + " + reaches), 19) << "the most of the hands";
  EXPECT_EQ(trialsOnOffer("simulated + mouse"), 1);
  EXPECT_THROW(trialsOnOffer("replay:/nowhere"), ResourceError);
}

TEST_F(MakeDevice, HandSettingsAreOfTheDeviceWithOrWithoutAName) {
  EXPECT_EQ(handSettingsOf("virtual:omni,scale=2").mapping.scale, 2);
  EXPECT_EQ(handSettingsOf("hid,scale=3").mapping.scale, 3);
  EXPECT_FALSE(handSettingsOf("hid").any());
  EXPECT_FALSE(handSettingsOf("replay:a,scale=2.csv").any()) << "what a file is called is its own business";
  EXPECT_EQ(make("simulated,scale=2,noise=0")->info().name, "simulated") << "the rest is the driver's own";
  EXPECT_EQ(make("simulated,wall=no,passivity=observe")->info().name, "simulated") << "as if they were not told";
  EXPECT_THROW(make("simulated,scale=2,colour=1"), FaultError);
}

using Devices = std::vector<std::unique_ptr<haptics::HapticDevice>>;

TEST(SeveralHands, AreOneDeviceInTheFirstOnesNameAndAllAreAsked) {
  std::vector<SetDevice*> parts;
  Devices owned;
  for (const char* name : {"one", "second", "third"}) {
    auto part = std::make_unique<SetDevice>(Vec3{}, name);
    part->about.virtualHand = true;
    parts.push_back(part.get());
    owned.push_back(std::move(part));
  }
  const auto device = joinDevices(std::move(owned));
  EXPECT_EQ(device->info().name, "one");
  EXPECT_TRUE(device->info().virtualHand);
  parts[2]->about.virtualHand = false;
  EXPECT_FALSE(device->info().virtualHand) << "all must be";
  device->prepareTrial(3);
  device->cue(haptics::Cue::Go);
  const std::array<dynamics::MassState, 2> masses{};
  device->see(masses);
  device->calibrate();
  device->startClock(nullptr, nullptr);
  device->stopClock();
  for (const SetDevice* part : parts)
    EXPECT_EQ(part->calls, std::string("prepare 3; go; see 2; calibrate; ") + (part == parts[0] ? "clock; no clock; " : ""));
  parts[0]->sample.position.x = 3;
  EXPECT_EQ(device->read().position.x, 3);
  device->write({1, 0, 0});
  EXPECT_EQ(parts[0]->written, (std::vector<Vec3>{{1, 0, 0}}));
  EXPECT_TRUE(parts[1]->written.empty()) << "each is told for itself";
  ASSERT_EQ(device->hands().size(), 3u);
  EXPECT_EQ(device->hands()[2], parts[2]);
  EXPECT_EQ(device->health(), haptics::DeviceHealth::Ready);
  parts[1]->is = haptics::DeviceHealth::Lost;
  parts[2]->is = haptics::DeviceHealth::Warm;
  EXPECT_EQ(device->health(), haptics::DeviceHealth::Lost) << "the worst of them";
  EXPECT_EQ(device->healthText(), "");
  parts[1]->says = "gone", parts[2]->says = "hot", parts[2]->hint = "hold it";
  EXPECT_EQ(device->healthText(), "second: gone; third: hot");
  EXPECT_EQ(device->calibrationHint(), "third: hold it");
  EXPECT_TRUE(device->stopForce());
  parts[0]->stops = false;
  EXPECT_FALSE(device->stopForce());
  for (const SetDevice* part : parts) EXPECT_TRUE(part->calls.ends_with("stop; stop; ")) << "whatever another says";
}

TEST(SeveralHands, OnlyTheFirstMayDriveTheClock) {
  const auto joined = [](const std::vector<bool>& drives) {
    Devices owned;
    for (const bool one : drives) {
      auto part = std::make_unique<SetDevice>(Vec3{}, "P");
      part->about.drivesClock = one;
      owned.push_back(std::move(part));
    }
    const haptics::HapticDevice* const first = owned[0].get();
    const auto device = joinDevices(std::move(owned));
    return std::pair{device->info().drivesClock, device.get() == first};
  };
  EXPECT_EQ(joined({true, false}), (std::pair{true, false}));
  EXPECT_EQ(reachlab::refusalOf([&] {
              joined({false, true});
            }),
            "device: P drives the clock, and is not the first; allowed: one device that drives the clock, named first");
  EXPECT_EQ(joined({false}), (std::pair{false, true})) << "one is itself";
}

TEST(SeveralHands, ALineOfDevicesIsTakenApartAndPutTogether) {
  EXPECT_EQ(splitHands("a"), std::vector<std::string>{"a"});
  EXPECT_EQ(splitHands("a:b,c=1 + d + e+f"), (std::vector<std::string>{"a:b,c=1", "d", "e+f"}));
  EXPECT_EQ(splitHands(" + "), (std::vector<std::string>{"", ""}));
  EXPECT_EQ(joinHands({"a", "b", "c"}), "a + b + c");
}

}  // namespace
}  // namespace reachlab::devices
