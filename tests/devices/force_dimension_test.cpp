#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <initializer_list>
#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/os.h"
#include "devices/vendor/force_dimension.h"
#include "tests/devices/driver_answers.h"
#include "tests/devices/fakes/fake_dhd.h"
#include "tests/devices/fakes/fake_message_line.h"
#include "tests/until.h"
#include "tests/refusal.h"

/// The driver behind its I/O thread; waits are for events.
namespace reachlab::devices {
namespace {

using reachlab::test::until;
using test::fakeDhd;

class ForceDimension : public ::testing::Test, public DriverAnswers {
 protected:
  ForceDimension() { test::resetFakeDhd(); }
  std::unique_ptr<haptics::HapticDevice> open(const std::string& spec = "forcedimension:0") { return make(spec); }
  // Newer samples than those that wait already.
  static haptics::DeviceSample newest(haptics::HapticDevice& device) {
    const std::uint64_t seen = device.read().reports;
    haptics::DeviceSample sample;
    until([&] { return (sample = device.read()).reports >= seen + 3; });
    return sample;
  }
  // A force along the world's x, which is the device's y, arrives.
  static bool isFelt(haptics::HapticDevice& device) {
    return until([&] {
      device.write({1, 0, 0});
      return fakeDhd().force[1] == 1;
    });
  }
  test::StandingForce wish{{1, 2, 3}};
};

TEST_F(ForceDimension, TurnsItsAxesIntoTheWorlds) {
  const auto device = open();
  fakeDhd().position[0] = 0.01, fakeDhd().position[1] = 0.02, fakeDhd().position[2] = 0.03;
  EXPECT_EQ(newest(*device).position, (Vec3{0.02, 0.03, 0.01}));
  ASSERT_TRUE(until([&] {
    device->write({1, 2, 3});
    return fakeDhd().force[0] == 3 && fakeDhd().force[1] == 1 && fakeDhd().force[2] == 2;
  })) << "F_device = R^T F_world";
}

TEST_F(ForceDimension, IsListedByTheNameThatOpensIt) {
  for (const FoundDevice& found : rows("forcedimension")) {
    EXPECT_TRUE(found.present) << found.whyNot;
    EXPECT_EQ(found.name, "forcedimension:0");
    EXPECT_EQ(found.maxForce, 12) << "CHAI3D's number for an omega.3: the library did not tell";
    EXPECT_NO_THROW(open(found.name));
  }
  EXPECT_FALSE(fakeDhd().open) << "left as it was";
}

TEST_F(ForceDimension, IsNamedWithItsSerialNumberWhereItTellsOne) {
  EXPECT_EQ(open()->info().name, "omega.3 4711");
  fakeDhd().tellsSerial = false;
  EXPECT_EQ(open()->info().name, "omega.3");
}

TEST_F(ForceDimension, NoneThereIsSaidInTheLibrarysWords) {
  test::fakeDhdCount() = 0;
  const auto found = rows("forcedimension");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].present);
  EXPECT_TRUE(holds(found[0].whyNot, "no device"));
  EXPECT_THROW(open(), ResourceError);
}

TEST_F(ForceDimension, AnErrorAtEachCallIsARefusalOrPassesAndNothingIsLeftOpen) {
  for (int calls = 0; calls < 20; ++calls) {
    test::resetFakeDhd();
    fakeDhd().callsUntilFailure = calls;
    try {
      PolledDevice device(openForceDimension(0, "device forcedimension:0", false), os::now);
      for (int i = 0; i < 20; ++i) {
        device.write({0, 0, 1});
        device.step();
        EXPECT_LE(std::abs(fakeDhd().force[0]), 1);
      }
      EXPECT_TRUE(device.read().valid) << calls << ": one error is passed over";
      EXPECT_EQ(device.read().reports, 19u + (fakeDhd().callsUntilFailure >= 0 ? 1u : 0u)) << calls;
    } catch (const ResourceError& error) {
      EXPECT_TRUE(holds(std::string(error.what()), "communication error")) << error.what();
      EXPECT_LT(calls, 2) << "opening and switching the forces on are two calls";
    }
    EXPECT_FALSE(fakeDhd().open) << calls;
    EXPECT_EQ(fakeDhd().force[0], 0) << calls;
  }
}

TEST_F(ForceDimension, AHangingCallIsLeftBehind) {
  auto device = open();
  fakeDhd().hangs = true;
  const std::uint64_t seen = device->read().reports;
  EXPECT_EQ(device->read().reports, seen) << "the tick does not wait";
  device.reset();
  fakeDhd().hangs = false;
  EXPECT_TRUE(until([&] { return !fakeDhd().open; })) << "and it is closed once the call returns";
}

TEST_F(ForceDimension, ACallThatHangsUnderForceIsToldOffByAnotherThreadAndTheForceComesBack) {
  const auto device = open();
  ASSERT_TRUE(isFelt(*device));
  fakeDhd().hangs = true;
  EXPECT_TRUE(until([&] {
    device->write({1, 0, 0});
    return !fakeDhd().forceOn;
  })) << "the controller still holds 1 N";
  fakeDhd().hangs = false;
  EXPECT_TRUE(until([&] { return fakeDhd().forceOn.load(); }));
}

TEST_F(ForceDimension, ItsOwnWatchdogTakesTheForceOffWhereTheLibraryOffersOne) {
  EXPECT_TRUE(holds(open()->info().secondPath, "its own watchdog"));
  EXPECT_EQ(fakeDhd().watchdog * 125, 20'000) << "[us]";
  fakeDhd().watchdog = -1;
  EXPECT_TRUE(holds(open()->info().secondPath, "no watchdog"));
}

TEST_F(ForceDimension, TheSameSampleAgainIsNoReport) {
  const auto device = open();
  fakeDhd().sameAgain = true;
  const int told = fakeDhd().forces;
  ASSERT_TRUE(until([&] { return fakeDhd().forces > told + 2; }));
  const std::uint64_t seen = device->read().reports;
  ASSERT_TRUE(until([&] { return fakeDhd().forces > told + 20; })) << "forces go on";
  EXPECT_EQ(device->read().reports, seen) << "a place that is believed for as long as the guard lasts";
}

TEST_F(ForceDimension, GivesItsOwnVelocityWhereItIsAskedFor) {
  fakeDhd().velocity[0] = 0.1, fakeDhd().velocity[1] = 0.2, fakeDhd().velocity[2] = 0.3;
  const haptics::DeviceSample sample = newest(*open("forcedimension:0,velocity=device"));
  EXPECT_TRUE(sample.hasVelocity);
  EXPECT_EQ(sample.velocity, (Vec3{0.2, 0.3, 0.1}));
  EXPECT_EQ(sample.buttons, 1u);
  EXPECT_FALSE(newest(*open()).hasVelocity);
  EXPECT_THROW(open("forcedimension,velocity=best"), FaultError);
}

// Peak force [N] and radius [mm] by the library's numbers of its models, and of any other the least of these.
TEST_F(ForceDimension, WhatTheLibraryDoesNotTellIsOfItsModel) {
  const auto infoOf = [](int type, double told) {
    fakeDhd().type = type;
    fakeDhd().maxForce = told;
    return openForceDimension(0, "device x", false)->info();
  };
  const auto expectModel = [&](std::initializer_list<int> types, double force, double millimetres) {
    for (const int type : types) {
      EXPECT_EQ(infoOf(type, -1).maxForce, force) << type;
      EXPECT_NEAR(infoOf(type, 0).workspaceRadius, 1e-3 * millimetres, 1e-15) << type;
    }
  };
  expectModel({63}, 20, 150);
  expectModel({33, 34, 36, 35, 37, 104, 105}, 12, 75);
  expectModel({60, -1, 38, 106}, 8, 40);
  EXPECT_EQ(infoOf(33, 7.5).maxForce, 7.5);
  EXPECT_EQ(infoOf(33, std::numeric_limits<double>::quiet_NaN()).maxForce, 12);
  const haptics::DeviceInfo info = infoOf(33, -1);
  EXPECT_TRUE(info.rendersForce);
  EXPECT_EQ(info.rate, 2000);
  EXPECT_EQ(openForceDimension(0, "device x", false)->period(), 500'000);
  EXPECT_TRUE(info.version.starts_with("DHD, libd")) << info.version;
  EXPECT_TRUE(holds(info.secondPath, "20 ms"));
}

TEST_F(ForceDimension, TwentyErrorsInARowAreALossAndOneThatSaysItIsGoneIsAtOnce) {
  haptics::DeviceSample sample;
  for (const auto& [error, calls] : {std::pair{2, 20}, {7, 20}, {12, 20}, {5, 1}, {6, 1}}) {
    test::resetFakeDhd();
    const auto device = openForceDimension(0, "device x", false);
    for (int i = 0; i < 19; ++i) {
      fakeDhd().error = 2;
      EXPECT_EQ(device->exchange(wish, sample), Exchange::Nothing);
    }
    fakeDhd().error = 0;
    EXPECT_EQ(device->exchange(wish, sample), Exchange::Report) << "one that is fine begins the count anew";
    fakeDhd().error = error;
    int lost = 1;
    while (device->exchange(wish, sample) != Exchange::Lost && lost < 100) ++lost;
    EXPECT_EQ(lost, calls) << error;
    fakeDhd().error = 0;
    ASSERT_TRUE(device->reopen());
    fakeDhd().error = 2;
    for (int i = 0; i < 19; ++i) EXPECT_EQ(device->exchange(wish, sample), Exchange::Nothing) << "opened again";
  }
}

TEST_F(ForceDimension, ZeroIsToldWhileItIsOpenAndItIsClosedOnce) {
  haptics::DeviceSample sample;
  const auto device = openForceDimension(0, "device x", false);
  device->exchange(wish, sample);
  EXPECT_EQ(fakeDhd().force[0], 3);
  EXPECT_TRUE(device->tellZero());
  for (const auto& part : fakeDhd().force) EXPECT_EQ(part, 0);
  fakeDhd().error = 2;
  EXPECT_FALSE(device->tellZero());
  EXPECT_THROW(device->reopen(), ResourceError);
  EXPECT_TRUE(device->tellZero()) << "it is closed: there is nobody to tell";
  fakeDhd().error = 0;
  EXPECT_TRUE(device->reopen());
  EXPECT_TRUE(fakeDhd().forceOn);
  device->exchange(wish, sample);
  device->close();
  EXPECT_FALSE(fakeDhd().forceOn);
  for (const auto& part : fakeDhd().force) EXPECT_EQ(part, 0);
}

TEST_F(ForceDimension, AVelocityThatCannotBeReadIsAnError) {
  haptics::DeviceSample sample;
  const auto device = openForceDimension(0, "device x", true);
  fakeDhd().callsUntilFailure = 1;  // the place is read
  EXPECT_EQ(device->exchange(wish, sample), Exchange::Nothing);
  EXPECT_EQ(fakeDhd().force[0], 3) << "its force is told all the same";
  EXPECT_EQ(device->exchange(wish, sample), Exchange::Report);
}

TEST_F(ForceDimension, OneThatCannotBeOpenedIsListedByItsNameWithTheLibrarysWords) {
  test::fakeDhdCount() = 2;
  fakeDhd(1).error = 2;
  const auto found = rows("forcedimension");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].present);
  EXPECT_FALSE(found[1].present);
  EXPECT_EQ(found[1].name, "forcedimension:1");
  EXPECT_TRUE(holds(found[1].whyNot, "device forcedimension:1: libd"));
  EXPECT_TRUE(holds(found[1].whyNot, "communication error (DHD error 2)"));
}

TEST_F(ForceDimension, AnIndexHasOneOrTwoDigits) {
  EXPECT_THROW(open("forcedimension:12"), ResourceError) << "there is no such device";
  EXPECT_THROW(open("forcedimension:123"), FaultError);
  EXPECT_THROW(open("forcedimension:-1"), FaultError);
  EXPECT_EQ(open("forcedimension")->info().name, "omega.3 4711") << "the first";
}

// Each has its place and its force, and the loss of one leaves the other to be told.
TEST_F(ForceDimension, TwoAreTwoHands) {
  test::fakeDhdCount() = 2;
  experiment = experiment::readExperiment("chain-two-hands");
  fakeDhd(0).position[1] = 0.01, fakeDhd(1).position[1] = 0.02;
  auto left = open("forcedimension:0 + forcedimension:1");
  ASSERT_EQ(left->hands().size(), 2u);
  haptics::HapticDevice& right = *left->hands()[1];
  ASSERT_TRUE(until([&] {
    left->write({1, 0, 0});
    right.write({2, 0, 0});
    return left->read().position.x == 0.01 && right.read().position.x == 0.02 && fakeDhd(0).force[1] == 1 && fakeDhd(1).force[1] == 2;
  }));
  fakeDhd(1).error = 2;
  ASSERT_TRUE(until([&] { return left->health() == haptics::DeviceHealth::Lost; }));
  EXPECT_TRUE(holds(left->healthText(), "4712")) << "by its serial number: " << left->healthText();
  EXPECT_TRUE(newest(*left).valid);
  ASSERT_TRUE(isFelt(*left));
  left.reset();
  EXPECT_EQ(fakeDhd(0).force[1], 0);
  EXPECT_FALSE(fakeDhd(0).open);
  EXPECT_FALSE(fakeDhd(1).open);
}

}  // namespace
}  // namespace reachlab::devices
