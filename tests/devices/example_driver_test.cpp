#include "tests/devices/example_driver.h"

#include <gtest/gtest.h>

#include "base/text_file.h"
#include "test_paths.h"
#include "tests/until.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

using reachlab::test::until;

TEST(ExampleDriver, IsTheOneOfTheManualsPage) {
  const std::string example = readTextFile(REACHLAB_SOURCE_DIR "/tests/devices/example_driver.h"),
                    page = readTextFile(REACHLAB_SOURCE_DIR "/docs/write-a-driver.md");
  ASSERT_FALSE(example.empty());
  EXPECT_TRUE(holds(page, example)) << "docs/write-a-driver.md shows another text than the one that is tested";
}

TEST(ExampleDriver, GivesPlacesTakesForcesAndSurvivesAPulledCable) {
  const experiment::CompiledExperiment experiment = experiment::openExperiment("chain-moderate");
  const DeviceDriver driver = example::springHandleDriver();
  ASSERT_TRUE(driver.find(driver).front().present);
  const auto device = driver.make({driver.name, "", experiment});
  EXPECT_EQ(device->read().position, 1e-3 * Vec3(20, 30, -10));
  ASSERT_TRUE(until([&] {
    device->write({1, 2, 3});
    return example::vendorForce[0] == -3 && example::vendorForce[1] == 1 && example::vendorForce[2] == 2;
  }));
  example::vendorUnplugged = true;
  ASSERT_TRUE(until([&] { return !device->read().valid; }));
  EXPECT_EQ(device->healthText(), "its cable is out");
  EXPECT_FALSE(driver.find(driver).front().present);
  example::vendorUnplugged = false;
  EXPECT_TRUE(until([&] { return device->read().valid; }));
}

}  // namespace
}  // namespace reachlab::devices
