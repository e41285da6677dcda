#include "devices/registry.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "base/fault.h"
#include "devices/make_device.h"
#include "devices/options.h"
#include "tests/devices/fakes/fake_dhd.h"
#include "tests/devices/fakes/fake_hd.h"

namespace reachlab::devices {
namespace {

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

TEST(Registry, AnUnknownDeviceIsRefusedWithAllThatThereAre) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  try {
    makeDevice("joystick", experiment, 1);
    FAIL();
  } catch (const FaultError& error) {
    for (const DeviceDriver& driver : deviceDrivers())
      EXPECT_NE(std::string(error.what()).find(driver.name), std::string::npos) << driver.name;
  }
}

// What is asked for is read before the arm is looked for, which is not connected.
TEST(HidOptions, TheLargestCurrentIsFromTenMilliamperesToSixAmperes) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  for (const char* good : {"0.01", "0.012", "6"})
    EXPECT_THROW(makeDevice(std::string("hid:no-such-arm,max-current=") + good, experiment, 1), ResourceError) << good;
  for (const char* bad : {"0.0099", "6.01", "0", "-1"})
    EXPECT_THROW(makeDevice(std::string("hid:no-such-arm,max-current=") + bad, experiment, 1), FaultError) << bad;
}

TEST(DeviceOptions, TakeWhatIsKnownAndRefuseTheRest) {
  DeviceOptions options("SN1,gain=0.5,mode=fast,other=1", "device x");
  EXPECT_EQ(options.plain(), "SN1");
  EXPECT_EQ(options.number("gain", 1, 0, 2), 0.5);
  EXPECT_EQ(options.number("absent", 7, 0, 9), 7);
  EXPECT_EQ(options.word("mode", {"slow", "fast"}), "fast");
  EXPECT_THROW(options.done(), FaultError);
  EXPECT_EQ(options.rest(), "other=1");
  EXPECT_NO_THROW(options.done());
  EXPECT_THROW(DeviceOptions("a=1,a=2", "device x"), FaultError);
  for (const char* bad : {"gain=3", "gain=-1", "gain=", "gain=1x", "gain=nan"}) {
    DeviceOptions wrong(bad, "device x");
    EXPECT_THROW(wrong.number("gain", 1, 0, 2), FaultError) << bad;
  }
}

}  // namespace
}  // namespace reachlab::devices
