#include "devices/vendor/phantom_device.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/os.h"
#include "devices/clock_timing.h"
#include "devices/driver/registry.h"
#include "devices/vendor/shared_library.h"
#include "sim/experiment/experiment.h"
#include "tests/devices/fakes/fake_hd.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

using test::fakeHd;

// Servo steps are taken by the test, one by one.
class Phantom : public ::testing::Test {
 protected:
  Phantom() { test::resetFakeHd(); }
  // A device that is served at each call, and told this force.
  struct Ticks {
    explicit Ticks(const Vec3& f = {}, const PhantomDevice::Options& options = {}, bool starts = true) : force(f), device(options) {
      if (starts) start();
    }
    void start() {
      device.startClock(
          [](void* context) noexcept {
            auto& ticks = *static_cast<Ticks*>(context);
            ++ticks.count;
            ticks.sample = ticks.device.read();
            ticks.device.write(ticks.force);
          },
          this);
    }
    int count = 0;
    Vec3 force;
    haptics::DeviceSample sample;
    PhantomDevice device;
  };
  static double feltAlongX(const std::string& name = "") { return fakeHd().devices[name].force[0]; }
};

std::string refusalOfPhantom(const PhantomDevice::Options& options = {}) {
  return refusalOf([&] { const PhantomDevice device(options); });
}

TEST_F(Phantom, ReadsItsLimitsFromTheDevice) {
  const PhantomDevice device({});
  const haptics::DeviceInfo info = device.info();
  EXPECT_EQ(info.maxForce, 3.3);
  EXPECT_EQ(info.maxContinuousForce, 0.88);
  EXPECT_NEAR(info.workspaceRadius, 0.035, 1e-15);
  EXPECT_TRUE(holds(info.name, "Omni"));
  EXPECT_TRUE(info.drivesClock);
  EXPECT_TRUE(info.rendersForce);
}

TEST_F(Phantom, OneCallIsOneFrameWithOneTickInMetresAndNewtons) {
  Ticks ticks({1, -2, 0.5});
  fakeHd().devices[""].position[0] = 12;
  fakeHd().devices[""].position[2] = -34;
  test::stepFakeHd();
  EXPECT_EQ(ticks.count, 1);
  EXPECT_NEAR(ticks.sample.position.x, 0.012, 1e-15);
  EXPECT_NEAR(ticks.sample.position.z, -0.034, 1e-15);
  EXPECT_EQ(feltAlongX(), 1);
  EXPECT_EQ(fakeHd().devices[""].force[1], -2);
  ticks.device.stopClock();
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, CallsInTheDocumentedOrder) {
  {
    Ticks ticks({1, 0, 0});
    test::stepFakeHd();
    ticks.device.stopClock();
  }
  const std::vector<std::string> expected{"hdInitDevice:",    "hdEnable:force",  "hdEnable",     "hdEnable",       "hdScheduleAsynchronous",
                                          "hdStartScheduler", "hdStopScheduler", "hdUnschedule", "hdDisableDevice"};
  EXPECT_EQ(fakeHd().calls, expected);
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, TwoDevicesShareTheSchedulerAndNotTheForce) {
  fakeHd().devices["Left"], fakeHd().devices["Right"];
  Ticks first({1, 0, 0}, {"Left"}, false), second({2, 0, 0}, {"Right"}, false);
  first.start(), second.start();
  test::stepFakeHd();
  EXPECT_EQ(feltAlongX("Left"), 1);
  EXPECT_EQ(feltAlongX("Right"), 2);
  first.device.stopClock();
  test::stepFakeHd();
  EXPECT_TRUE(fakeHd().schedulerRuns) << "the other one still needs it";
  EXPECT_EQ(second.count, 2);
  second.device.stopClock();
  EXPECT_FALSE(fakeHd().schedulerRuns);
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, EveryRefusalAtOpeningIsSaidInTheLibrarysWordsAndLeavesNothingOpen) {
  for (const char* call : {"hdInitDevice", "hdEnable"}) {
    test::resetFakeHd();
    fakeHd().failures[call] = 0x0600;
    const std::string said = refusalOfPhantom();
    EXPECT_TRUE(holds(said, "HD_INVALID_LICENSE (0x0600)")) << call << ": " << said;
    EXPECT_TRUE(holds(said, "device phantom"));
    EXPECT_FALSE(fakeHd().devices[""].open);
  }
  for (const char* call : {"hdScheduleAsynchronous", "hdStartScheduler"}) {
    test::resetFakeHd();
    fakeHd().failures[call] = 0x0304;
    EXPECT_THROW(Ticks(), ResourceError) << call;
  }
}

// Whatever a call of a frame leaves as its error: no force that was not asked for, none at all once the device is lost or failed, the rules kept.
TEST_F(Phantom, AnErrorAtEachCallOfAFrameNeverLeavesAForceThatNobodyAskedFor) {
  for (const char* call : {"hdBeginFrame", "hdGetDoublev", "hdSetDoublev", "hdEndFrame"})
    for (const std::uint32_t error :
         {0x0100u, 0x0101u, 0x0102u, 0x0103u, 0x0104u, 0x0200u, 0x0201u, 0x0202u, 0x0203u, 0x0204u, 0x02FFu, 0x0300u,
          0x0301u, 0x0302u, 0x0303u, 0x0304u, 0x0305u, 0x0400u, 0x0401u, 0x0402u, 0x0500u, 0x0501u, 0x0600u}) {
      test::resetFakeHd();
      fakeHd().devices[""].position[0] = 40;
      Ticks ticks({0.5, 0, 0});
      test::stepFakeHd();
      ASSERT_EQ(feltAlongX(), 0.5);
      fakeHd().failures[call] = error;
      for (int i = 0; i < 30; ++i) {
        test::stepFakeHd();
        const bool off = ticks.device.health() == haptics::DeviceHealth::Lost || ticks.device.health() == haptics::DeviceHealth::Failed;
        ASSERT_LE(std::abs(feltAlongX()), 0.5) << call << std::hex << error;
        ASSERT_TRUE(i == 0 || !off || feltAlongX() == 0) << call << std::hex << error;
        ASSERT_TRUE(!ticks.sample.valid || std::abs(ticks.sample.position.x - 0.04) < 1e-12) << call << std::hex << error << ": a jump";
      }
      const bool isFault = error >= 0x0300 && error <= 0x0304;
      ASSERT_EQ(ticks.device.health() == haptics::DeviceHealth::Lost, isFault) << call << std::hex << error << ": every fault is a loss";
      ASSERT_EQ(fakeHd().violations, 0) << call << std::hex << error;
    }
}

TEST_F(Phantom, AFailedDeviceIsReadyAgainAfterASecondWithoutAnErrorAndItsForcesAreSwitchedOn) {
  Ticks ticks({1, 0, 0});
  fakeHd().failures["hdEndFrame"] = 0x0203;
  test::stepFakeHd();
  fakeHd().devices[""].forceOutput = false;  // by its own software
  ASSERT_EQ(ticks.device.health(), haptics::DeviceHealth::Failed);
  for (int i = 0; i < 900; ++i) test::stepFakeHd();
  ASSERT_EQ(feltAlongX(), 0);
  for (int i = 0; i < 200; ++i) test::stepFakeHd();
  EXPECT_EQ(ticks.device.health(), haptics::DeviceHealth::Ready) << "what latches the force off until it is reset is the loop";
  EXPECT_EQ(feltAlongX(), 1);
}

TEST_F(Phantom, AnErrorIsTheDevicesThatItNames) {
  fakeHd().devices["Left"], fakeHd().devices["Right"];
  Ticks first({1, 0, 0}, {"Left"}, false), second({2, 0, 0}, {"Right"}, false);
  first.start(), second.start();
  test::stepFakeHd();
  fakeHd().errors.push_back({0x0302, test::fakeHdHandle("Right")});  // asked for first in the left one's frame
  test::stepFakeHd();
  EXPECT_EQ(first.device.health(), haptics::DeviceHealth::Ready);
  EXPECT_EQ(second.device.health(), haptics::DeviceHealth::Lost);
  EXPECT_EQ(feltAlongX("Left"), 1);
  EXPECT_EQ(feltAlongX("Right"), 0);
}

TEST_F(Phantom, ASampledDeviceGivesItsNewestPlaceAndTakesTheNewestForce) {
  fakeHd().devices[""].position[0] = 12;
  PhantomDevice device({.drivesClock = false});
  EXPECT_FALSE(device.info().drivesClock);
  EXPECT_TRUE(fakeHd().schedulerRuns) << "from the beginning on";
  test::stepFakeHd();
  const haptics::DeviceSample sample = device.read();
  EXPECT_NEAR(sample.position.x, 0.012, 1e-15);
  EXPECT_EQ(sample.reports, 1u);
  EXPECT_EQ(device.read().reports, 1u) << "no newer one";
  device.write({1, 0, 0});
  EXPECT_EQ(feltAlongX(), 0) << "in effect with the next frame";
  test::stepFakeHd();
  EXPECT_EQ(feltAlongX(), 1);
  os::sleepUntil(os::now() + 25'000'000);
  test::stepFakeHd();
  EXPECT_EQ(feltAlongX(), 0) << "a force that is not renewed is none";
  fakeHd().failures["hdEndFrame"] = 0x0302;
  test::stepFakeHd();
  test::stepFakeHd();
  EXPECT_FALSE(device.read().valid);
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, ASampledDeviceKnowsHowOldTheSampleBehindItsForceWas) {
  PhantomDevice device({.drivesClock = false});
  test::stepFakeHd();
  const haptics::DeviceSample sample = device.read();
  EXPECT_EQ(device.times().age.max(), 0) << "no force has gone out yet";
  os::sleepUntil(sample.takenNs + 3'000'000);
  device.write({1, 0, 0});
  test::stepFakeHd();
  const double age = device.times().age.max();
  EXPECT_GE(age, 3e6);
  EXPECT_LE(age, static_cast<double>(os::now() - sample.takenNs));
}

TEST_F(Phantom, AnOpenSafetySwitchReleasesItWhereItIsAskedFor) {
  for (const bool deadMan : {true, false}) {
    test::resetFakeHd();
    Ticks ticks({}, {.deadMan = deadMan});
    for (const bool closed : {true, false, true}) {
      fakeHd().devices[""].switchClosed = closed;
      test::stepFakeHd();
      EXPECT_EQ(ticks.sample.released, deadMan && !closed);
    }
    EXPECT_EQ(fakeHd().violations, 0);
  }
}

TEST_F(Phantom, ASecondDeviceIsOpenedWhileTheSchedulerStandsStill) {
  fakeHd().devices["Left"], fakeHd().devices["Right"];
  const PhantomDevice left({.name = "Left", .drivesClock = false}), right({.name = "Right", .drivesClock = false});
  const auto& calls = fakeHd().calls;
  const auto second = std::find(calls.begin(), calls.end(), "hdInitDevice:Right");
  ASSERT_NE(second, calls.end());
  EXPECT_EQ(*std::prev(second), "hdStopScheduler");
  EXPECT_TRUE(fakeHd().schedulerRuns);
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, ACallThatComesAfterTheEndTouchesNothing) {
  {
    Ticks ticks({1, 0, 0});
    test::stepFakeHd();
    ticks.device.stopClock();
    const int ticked = ticks.count;
    test::callLateFakeHd();
    EXPECT_EQ(ticks.count, ticked);
  }
  const int frames = fakeHd().devices[""].frames;
  test::callLateFakeHd();
  EXPECT_EQ(fakeHd().devices[""].frames, frames);
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, OneThatIsInUseIsRefusedAndLeftToItsUser) {
  PhantomDevice device({});
  EXPECT_TRUE(holds(refusalOfPhantom(), "another program has it"));
  EXPECT_TRUE(fakeHd().devices[""].open);
  const auto rows = findDriver("phantom")->find(*findDriver("phantom"));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_TRUE(rows[0].present) << rows[0].whyNot;
}

TEST_F(Phantom, AnErrorOfWhatIsOnlyDescribedIsNoReasonAgainstIt) {
  fakeHd().failures["hdGetString"] = 0x0100;
  EXPECT_EQ(refusalOfPhantom(), "");
}

TEST_F(Phantom, AForceThatIsNoNumberIsNoForce) {
  Ticks ticks({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  test::stepFakeHd();
  EXPECT_EQ(feltAlongX(), 0);
}

TEST_F(Phantom, TheSecondPathSwitchesItsForcesOff) {
  Ticks ticks({1, 0, 0});
  test::stepFakeHd();
  EXPECT_TRUE(ticks.device.stopForce());
  EXPECT_EQ(feltAlongX(), 0);
  test::stepFakeHd();
  EXPECT_EQ(feltAlongX(), 1) << "and a new force switches them on again";
}

TEST_F(Phantom, GivesButtonsAndVelocity) {
  Ticks ticks({}, {.deviceVelocity = true});
  auto& one = fakeHd().devices[""];
  one.buttons = 5;
  one.velocity[0] = 100, one.velocity[1] = -200, one.velocity[2] = 300;
  one.position[1] = 7;
  test::stepFakeHd();
  EXPECT_EQ(ticks.sample.buttons, 5u);
  EXPECT_TRUE(ticks.sample.hasVelocity);
  EXPECT_LT(norm(ticks.sample.velocity - Vec3{0.1, -0.2, 0.3}), 1e-15);
  EXPECT_NEAR(ticks.sample.position.y, 0.007, 1e-15);
  EXPECT_EQ(ticks.sample.reports, 1u);
  ticks.device.stopClock();
  test::resetFakeHd();
  Ticks others;
  test::stepFakeHd();
  EXPECT_FALSE(others.sample.hasVelocity) << "unless it is asked for";
}

TEST_F(Phantom, AContinuousForceThatIsNoneIsUnknown) {
  for (const double told : {-1.0, std::numeric_limits<double>::quiet_NaN(), 0.0}) {
    fakeHd().continuousForce = told;
    EXPECT_EQ(PhantomDevice({}).info().maxContinuousForce, 0);
  }
  for (const double told : {-3.3, std::numeric_limits<double>::infinity()}) {
    fakeHd().maxForce = told;
    EXPECT_TRUE(holds(refusalOfPhantom(), "it does not tell its largest force (HD_NOMINAL_MAX_FORCE)"));
  }
}

TEST_F(Phantom, IsCalibratedByTheStyleThatNeedsTheFewestHands) {
  for (const auto& [styles, used] : {std::pair{7u, 2u}, {2u, 2u}, {5u, 4u}, {4u, 4u}, {1u, 1u}, {0u, 1u}}) {
    test::resetFakeHd();
    fakeHd().calibration = 0x5001;
    fakeHd().styles = styles;
    EXPECT_EQ(refusalOfPhantom(), "");
    EXPECT_EQ(fakeHd().updatedBy, used) << styles;
  }
  test::resetFakeHd();
  EXPECT_EQ(refusalOfPhantom(), "");
  EXPECT_EQ(fakeHd().updatedBy, 0u) << "nothing is to be done";
  PhantomDevice device({});
  fakeHd().calibration = 0x5001;
  EXPECT_NO_THROW(device.calibrate());
  EXPECT_EQ(fakeHd().calibration, 0x5000u);
  fakeHd().calibration = 0x5002;
  EXPECT_THROW(device.calibrate(), ResourceError);
}

TEST_F(Phantom, WhatIsWrongIsToldInTheLibrarysWords) {
  Ticks ticks;
  test::stepFakeHd();
  EXPECT_EQ(ticks.device.healthText(), "");
  for (const auto& [code, health] : {std::pair{0x0200u, haptics::DeviceHealth::Warm},
                                     {0x0203u, haptics::DeviceHealth::Failed},
                                     {0x0200u, haptics::DeviceHealth::Failed},
                                     {0x0302u, haptics::DeviceHealth::Lost},
                                     {0x0203u, haptics::DeviceHealth::Lost}}) {
    fakeHd().failures["hdEndFrame"] = code;
    test::stepFakeHd();
    EXPECT_EQ(ticks.device.health(), health) << std::hex << code;
  }
  EXPECT_EQ(ticks.device.healthText(), "HD_EXCEEDED_MAX_VELOCITY (0x0203)");
}

// Warm: held to the continuous force in its own direction, where that is known and the force is larger.
TEST_F(Phantom, WarmMotorsKeepTheForcesDirection) {
  for (const double continuous : {1.0, 0.0}) {
    test::resetFakeHd();
    fakeHd().continuousForce = continuous;
    Ticks ticks({1.2, 0, -1.6});
    fakeHd().failures["hdEndFrame"] = 0x0200;
    test::stepFakeHd();
    test::stepFakeHd();
    EXPECT_NEAR(feltAlongX(), continuous > 0 ? 0.6 : 1.2, 1e-12);
    EXPECT_NEAR(fakeHd().devices[""].force[2], continuous > 0 ? -0.8 : -1.6, 1e-12);
    ticks.force = {0.3, 0, 0};
    test::stepFakeHd();
    EXPECT_NEAR(feltAlongX(), 0.3, 1e-12);
    ticks.force = {1.2, 0, -1.6};
    for (int i = 0; i < 1100; ++i) test::stepFakeHd();
    EXPECT_NEAR(feltAlongX(), 1.2, 1e-12) << "a second without the warning: cool again";
  }
}

TEST_F(Phantom, NoneThereIsSaidInTheLibrarysWords) {
  fakeHd().devices.clear();
  const DeviceDriver& driver = *findDriver("phantom");
  const auto rows = driver.find(driver);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FALSE(rows[0].present);
  EXPECT_TRUE(holds(refusalOfPhantom({"Nowhere"}), "phantom:Nowhere"));
  EXPECT_TRUE(holds(rows[0].whyNot, "HD_DEVICE_FAULT (0x0300); is it connected, switched on"));
  for (const auto& [code, hint] : {std::pair{0x0302u, "is it connected"}, {0x0303u, "is it connected"}, {0x0600u, "licence manager"}}) {
    test::resetFakeHd();
    fakeHd().failures["hdInitDevice"] = code;
    EXPECT_TRUE(holds(refusalOfPhantom(), hint));
  }
  test::resetFakeHd();
  fakeHd().failures["hdInitDevice"] = 0x0304;
  EXPECT_TRUE(refusalOfPhantom().ends_with("HD_OTHER (0x0304)")) << "no hint where there is none";
}

// By themselves as the vendor's scheduler runs: the device's own clock first, then the computer's.
TEST_F(Phantom, BothWaysToServeItAreTimed) {
  ::setenv("FAKE_HD_ALONE", "1", 1);
  const auto rows = measureLatency("phantom", 0.2);
  ::unsetenv("FAKE_HD_ALONE");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].clock, "device");
  EXPECT_EQ(rows[1].clock, "computer");
  for (const ClockTiming& row : rows) {
    EXPECT_GT(row.ticks, 0u);
    EXPECT_LT(row.ticks, 2000u);
    EXPECT_GT(row.rate, 0);
    EXPECT_LE(row.jitterP50, row.jitterP99);
    EXPECT_LE(row.jitterP99, row.jitterMax * 1.1);
    EXPECT_GT(row.jitterMax, 0);
    EXPECT_LT(row.jitterMax, 10) << "seconds";
    EXPECT_LE(row.ageP50, row.ageP99);
    EXPECT_GT(row.ageMax, 0);
    EXPECT_LT(row.ageMax, 10);
  }
}

TEST(SharedLibrary, OneThatIsNotThereIsRefusedWithAllNamesAndTheLoadersWords) {
  const std::string said = refusalOf<ResourceError>([] { const SharedLibrary library({"libnowhere.so.7", "libnowhere.so"}); });
  EXPECT_TRUE(said.starts_with("libnowhere.so.7: ")) << said;
  EXPECT_TRUE(holds(said, "; looked for libnowhere.so.7, libnowhere.so where the loader looks"));
  const SharedLibrary found({"libnowhere.so", "libm.so.6", "libc.so.6"});
  EXPECT_EQ(found.name(), "libm.so.6") << "the first that there is";
  EXPECT_NE(found.find("cos").address, nullptr);
  EXPECT_EQ(found.find("no_such_function").address, nullptr);
  EXPECT_EQ(refusalOf([&] { (void)found.require("no_such_function"); }),
            "libm.so.6: has no function no_such_function; is it another version?");
}

// A file that is there but is no library tells more than one that is not there.
TEST(SharedLibrary, OneThatCannotBeLoadedIsSaidBeforeOneThatIsNotThere) {
  const std::string broken = (std::filesystem::temp_directory_path() / ("reach-broken-" + std::to_string(::getpid()) + ".so")).string();
  std::ofstream(broken) << "no library";
  EXPECT_TRUE(refusalOf([&] { const SharedLibrary library({"libnowhere.so", broken, "libm.so.6"}); }).starts_with(broken));
  std::filesystem::remove(broken);
}

}  // namespace
}  // namespace reachlab::devices
