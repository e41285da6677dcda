#include "devices/vendor/phantom_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/os.h"
#include "devices/registry.h"
#include "tests/devices/fakes/fake_hd.h"

namespace reachlab::devices {
namespace {

using test::fakeHd;

// Servo steps are taken by the test, one by one.
class Phantom : public ::testing::Test {
 protected:
  Phantom() { test::resetFakeHd(); }
  struct Ticks {
    haptics::HapticDevice* device = nullptr;
    int count = 0;
    Vec3 force;
    haptics::DeviceSample sample;
  };
  static void tick(void* context) noexcept {
    auto& ticks = *static_cast<Ticks*>(context);
    ++ticks.count;
    ticks.sample = ticks.device->read();
    ticks.device->write(ticks.force);
  }
  static double feltAlongX(const std::string& name = "") { return fakeHd().devices[name].force[0]; }
};

std::string refusal(const PhantomDevice::Options& options = {}) {
  try {
    const PhantomDevice device(options);
  } catch (const ResourceError& error) {
    return error.what();
  }
  return {};
}

TEST_F(Phantom, ReadsItsLimitsFromTheDevice) {
  const PhantomDevice device({});
  const haptics::DeviceInfo info = device.info();
  EXPECT_EQ(info.maxForce, 3.3);
  EXPECT_EQ(info.maxContinuousForce, 0.88);
  EXPECT_NEAR(info.workspaceRadius, 0.035, 1e-15);
  EXPECT_NE(info.name.find("Omni"), std::string::npos);
  EXPECT_TRUE(info.drivesClock);
  EXPECT_TRUE(info.rendersForce);
}

TEST_F(Phantom, OneCallIsOneFrameWithOneTickInMetresAndNewtons) {
  PhantomDevice device({});
  Ticks ticks{&device, 0, {1, -2, 0.5}, {}};
  device.startClock(tick, &ticks);
  fakeHd().devices[""].position[0] = 12;
  fakeHd().devices[""].position[2] = -34;
  test::stepFakeHd();
  EXPECT_EQ(ticks.count, 1);
  EXPECT_NEAR(ticks.sample.position.x, 0.012, 1e-15);
  EXPECT_NEAR(ticks.sample.position.z, -0.034, 1e-15);
  EXPECT_TRUE(ticks.sample.hasOrientation);
  EXPECT_EQ(feltAlongX(), 1);
  EXPECT_EQ(fakeHd().devices[""].force[1], -2);
  device.stopClock();
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, CallsInTheDocumentedOrder) {
  {
    PhantomDevice device({});
    Ticks ticks{&device, 0, {1, 0, 0}, {}};
    device.startClock(tick, &ticks);
    test::stepFakeHd();
    device.stopClock();
  }
  const std::vector<std::string> expected{"hdInitDevice:",    "hdEnable:force",  "hdEnable",     "hdEnable",       "hdScheduleAsynchronous",
                                          "hdStartScheduler", "hdStopScheduler", "hdUnschedule", "hdDisableDevice"};
  EXPECT_EQ(fakeHd().calls, expected);
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, TwoDevicesShareTheSchedulerAndNotTheForce) {
  fakeHd().devices["Left"], fakeHd().devices["Right"];
  PhantomDevice left({"Left"}), right({"Right"});
  Ticks first{&left, 0, {1, 0, 0}, {}}, second{&right, 0, {2, 0, 0}, {}};
  left.startClock(tick, &first);
  right.startClock(tick, &second);
  test::stepFakeHd();
  EXPECT_EQ(feltAlongX("Left"), 1);
  EXPECT_EQ(feltAlongX("Right"), 2);
  left.stopClock();
  test::stepFakeHd();
  EXPECT_TRUE(fakeHd().schedulerRuns) << "the other one still needs it";
  EXPECT_EQ(second.count, 2);
  right.stopClock();
  EXPECT_FALSE(fakeHd().schedulerRuns);
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, EveryRefusalAtOpeningIsSaidInTheLibrarysWordsAndLeavesNothingOpen) {
  for (const char* call : {"hdInitDevice", "hdEnable"}) {
    test::resetFakeHd();
    fakeHd().failures[call] = 0x0600;
    const std::string said = refusal();
    EXPECT_NE(said.find("HD_INVALID_LICENSE (0x0600)"), std::string::npos) << call << ": " << said;
    EXPECT_NE(said.find("device phantom"), std::string::npos);
    EXPECT_FALSE(fakeHd().devices[""].open);
  }
  for (const char* call : {"hdScheduleAsynchronous", "hdStartScheduler"}) {
    test::resetFakeHd();
    PhantomDevice device({});
    Ticks ticks{&device, 0, {}, {}};
    fakeHd().failures[call] = 0x0304;
    EXPECT_THROW(device.startClock(tick, &ticks), ResourceError) << call;
  }
}

TEST_F(Phantom, ADeviceThatIsNotConfiguredIsRefusedByItsName) {
  const std::string said = refusal({"Nowhere"});
  EXPECT_NE(said.find("phantom:Nowhere"), std::string::npos) << said;
}

TEST_F(Phantom, WithoutItsLargestForceItIsNotDriven) {
  fakeHd().maxForce = 0;
  EXPECT_NE(refusal().find("largest force"), std::string::npos);
}

TEST_F(Phantom, ItIsCalibratedWhereThatNeedsNoHandsAndElseRefused) {
  fakeHd().calibration = 0x5001;
  EXPECT_EQ(refusal(), "");
  fakeHd().calibration = 0x5002;
  EXPECT_NE(refusal().find("inkwell"), std::string::npos);
}

TEST_F(Phantom, LostCommunicationTakesTheForceForGood) {
  PhantomDevice device({});
  Ticks ticks{&device, 0, {1, 0, 0}, {}};
  device.startClock(tick, &ticks);
  test::stepFakeHd();
  ASSERT_EQ(feltAlongX(), 1);
  fakeHd().failures["hdEndFrame"] = 0x0302;
  test::stepFakeHd();
  for (int i = 0; i < 20; ++i) {
    test::stepFakeHd();
    EXPECT_EQ(feltAlongX(), 0);
    EXPECT_FALSE(ticks.sample.valid);
  }
  EXPECT_EQ(device.health(), haptics::DeviceHealth::Lost);
  EXPECT_NE(device.healthText().find("HD_COMM_ERROR"), std::string::npos);
}

TEST_F(Phantom, AForceErrorIsAFaultOfTheDevice) {
  for (const std::uint32_t error : {0x0201u, 0x0202u, 0x0203u, 0x0204u, 0x0402u}) {
    test::resetFakeHd();
    PhantomDevice device({});
    Ticks ticks{&device, 0, {1, 0, 0}, {}};
    device.startClock(tick, &ticks);
    fakeHd().failures["hdSetDoublev"] = error;
    test::stepFakeHd();
    test::stepFakeHd();
    EXPECT_EQ(device.health(), haptics::DeviceHealth::Failed) << std::hex << error;
    EXPECT_EQ(feltAlongX(), 0);
  }
}

// Whatever a call of a frame leaves as its error: no force that was not asked for, none at all once the device is lost or failed, the rules kept.
TEST_F(Phantom, AnErrorAtEachCallOfAFrameNeverLeavesAForceThatNobodyAskedFor) {
  for (const char* call : {"hdBeginFrame", "hdGetDoublev", "hdSetDoublev", "hdEndFrame"})
    for (const std::uint32_t error : {0x0100u, 0x0101u, 0x0102u, 0x0103u, 0x0104u, 0x0200u, 0x0201u, 0x0202u, 0x0203u, 0x0204u, 0x0300u,
                                      0x0301u, 0x0302u, 0x0303u, 0x0304u, 0x0400u, 0x0401u, 0x0402u, 0x0500u, 0x0501u, 0x0600u}) {
      test::resetFakeHd();
      PhantomDevice device({});
      Ticks ticks{&device, 0, {0.5, 0, 0}, {}};
      fakeHd().devices[""].position[0] = 40;
      device.startClock(tick, &ticks);
      test::stepFakeHd();
      ASSERT_EQ(feltAlongX(), 0.5);
      fakeHd().failures[call] = error;
      for (int i = 0; i < 30; ++i) {
        test::stepFakeHd();
        const bool off = device.health() == haptics::DeviceHealth::Lost || device.health() == haptics::DeviceHealth::Failed;
        ASSERT_LE(std::abs(feltAlongX()), 0.5) << call << std::hex << error;
        ASSERT_TRUE(i == 0 || !off || feltAlongX() == 0) << call << std::hex << error;
        ASSERT_TRUE(!ticks.sample.valid || std::abs(ticks.sample.position.x - 0.04) < 1e-12) << call << std::hex << error << ": a jump";
      }
      ASSERT_EQ(fakeHd().violations, 0) << call << std::hex << error;
    }
}

TEST_F(Phantom, WarmMotorsHoldTheForceToTheContinuousOne) {
  PhantomDevice device({});
  Ticks ticks{&device, 0, {3, 0, 0}, {}};
  device.startClock(tick, &ticks);
  test::stepFakeHd();
  ASSERT_EQ(feltAlongX(), 3);
  fakeHd().failures["hdEndFrame"] = 0x0200;
  test::stepFakeHd();
  test::stepFakeHd();
  EXPECT_NEAR(feltAlongX(), 0.88, 1e-12);
  for (int i = 0; i < 1100; ++i) test::stepFakeHd();
  EXPECT_EQ(feltAlongX(), 3) << "a second without the warning: cool again";
}

TEST_F(Phantom, AFailedDeviceIsReadyAgainAfterASecondWithoutAnErrorAndItsForcesAreSwitchedOn) {
  PhantomDevice device({});
  Ticks ticks{&device, 0, {1, 0, 0}, {}};
  device.startClock(tick, &ticks);
  fakeHd().failures["hdEndFrame"] = 0x0203;
  test::stepFakeHd();
  fakeHd().devices[""].forceOutput = false;  // by its own software
  ASSERT_EQ(device.health(), haptics::DeviceHealth::Failed);
  for (int i = 0; i < 900; ++i) test::stepFakeHd();
  ASSERT_EQ(feltAlongX(), 0);
  for (int i = 0; i < 200; ++i) test::stepFakeHd();
  EXPECT_EQ(device.health(), haptics::DeviceHealth::Ready) << "what latches the force off until it is reset is the loop";
  EXPECT_EQ(feltAlongX(), 1);
}

TEST_F(Phantom, AnErrorIsTheDevicesThatItNames) {
  fakeHd().devices["Left"], fakeHd().devices["Right"];
  PhantomDevice left({"Left"}), right({"Right"});
  Ticks first{&left, 0, {1, 0, 0}, {}}, second{&right, 0, {2, 0, 0}, {}};
  left.startClock(tick, &first);
  right.startClock(tick, &second);
  test::stepFakeHd();
  fakeHd().errors.push_back({0x0302, test::fakeHdHandle("Right")});  // asked for first in the left one's frame
  test::stepFakeHd();
  EXPECT_EQ(left.health(), haptics::DeviceHealth::Ready);
  EXPECT_EQ(right.health(), haptics::DeviceHealth::Lost);
  EXPECT_EQ(feltAlongX("Left"), 1);
  EXPECT_EQ(feltAlongX("Right"), 0);
}

TEST_F(Phantom, ASampledDeviceGivesItsNewestPlaceAndTakesTheNewestForce) {
  fakeHd().devices[""].position[0] = 12;
  PhantomDevice::Options sampled;
  sampled.drivesClock = false;
  PhantomDevice device(sampled);
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
  PhantomDevice::Options sampled;
  sampled.drivesClock = false;
  PhantomDevice device(sampled);
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
    PhantomDevice::Options options;
    options.deadMan = deadMan;
    PhantomDevice device(options);
    Ticks ticks{&device, 0, {}, {}};
    device.startClock(tick, &ticks);
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
  PhantomDevice::Options sampled;
  sampled.drivesClock = false;
  sampled.name = "Left";
  PhantomDevice left(sampled);
  sampled.name = "Right";
  PhantomDevice right(sampled);
  const auto& calls = fakeHd().calls;
  const auto second = std::find(calls.begin(), calls.end(), "hdInitDevice:Right");
  ASSERT_NE(second, calls.end());
  EXPECT_EQ(*std::prev(second), "hdStopScheduler");
  EXPECT_TRUE(fakeHd().schedulerRuns);
  EXPECT_EQ(fakeHd().violations, 0);
}

TEST_F(Phantom, ACallThatComesAfterTheEndTouchesNothing) {
  {
    PhantomDevice device({});
    Ticks ticks{&device, 0, {1, 0, 0}, {}};
    device.startClock(tick, &ticks);
    test::stepFakeHd();
    device.stopClock();
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
  EXPECT_NE(refusal().find("another program has it"), std::string::npos) << refusal();
  EXPECT_TRUE(fakeHd().devices[""].open);
  const auto rows = findDriver("phantom")->find(*findDriver("phantom"));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_TRUE(rows[0].present) << rows[0].whyNot;
}

TEST_F(Phantom, AnErrorOfWhatIsOnlyDescribedIsNoReasonAgainstIt) {
  fakeHd().failures["hdGetString"] = 0x0100;
  EXPECT_EQ(refusal(), "");
}

TEST_F(Phantom, AForceThatIsNoNumberIsNoForce) {
  PhantomDevice device({});
  Ticks ticks{&device, 0, {std::numeric_limits<double>::quiet_NaN(), 0, 0}, {}};
  device.startClock(tick, &ticks);
  test::stepFakeHd();
  EXPECT_EQ(feltAlongX(), 0);
}

TEST_F(Phantom, TheSecondPathSwitchesItsForcesOff) {
  PhantomDevice device({});
  Ticks ticks{&device, 0, {1, 0, 0}, {}};
  device.startClock(tick, &ticks);
  test::stepFakeHd();
  EXPECT_TRUE(device.stopForce());
  EXPECT_EQ(feltAlongX(), 0);
  test::stepFakeHd();
  EXPECT_EQ(feltAlongX(), 1) << "and a new force switches them on again";
}

}  // namespace
}  // namespace reachlab::devices
