#include "devices/mapping/mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include <unistd.h>

#include "base/fault.h"
#include "devices/make_device.h"
#include "devices/mapping/guarded_device.h"

namespace reachlab::devices {
namespace {

/// A device that is where it was put and keeps what it was told.
class Recorded final : public haptics::HapticDevice {
 public:
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info;
    info.name = "recorded";
    info.rendersForce = true;
    info.workspaceRadius = 0.1;
    info.resolution = 1e-5;
    return info;
  }
  haptics::DeviceSample read() noexcept override { return sample; }
  void write(const Vec3& force) noexcept override { told = force; }
  haptics::DeviceSample sample;
  Vec3 told;
};

struct Guarded {
  explicit Guarded(const HandOptions& options) {
    auto owned = std::make_unique<Recorded>();
    inner = owned.get();
    device = guardDevice(std::move(owned), options);
  }
  Recorded* inner;
  std::unique_ptr<haptics::HapticDevice> device;
};

HandOptions mapped(const Mapping& mapping) {
  HandOptions options;
  options.mapping = mapping;
  options.mapped = true;
  return options;
}

TEST(DeadManButton, GivesForceOnlyWhileItIsHeld) {
  HandOptions options;
  options.deadManButton = 2;
  Guarded guarded(options);
  EXPECT_TRUE(guarded.device->read().released);
  guarded.inner->sample.buttons = 0b01;
  EXPECT_TRUE(guarded.device->read().released) << "another button";
  guarded.inner->sample.buttons = 0b10;
  EXPECT_FALSE(guarded.device->read().released);
  guarded.inner->sample.released = true;
  EXPECT_TRUE(guarded.device->read().released) << "the device's own switch holds besides";
}

TEST(DeadManButton, IsRefusedWhereThereIsNoForceToTake) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-slow");
  EXPECT_THROW(makeDevice("simulated,dead-man-button=1", experiment, 1), FaultError);
  EXPECT_THROW(makeDevice("virtual:omni,dead-man-button=33", experiment, 1), FaultError);
  EXPECT_NO_THROW(makeDevice("virtual:omni,dead-man-button=1", experiment, 1));
}

// Power: F_device . v_device = F . v / scale for every mapping. Seeded; to rounding.
TEST(Mapping, TheDeviceDoesTheWorkThatTheHandFeelsDividedByTheScale) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3{any(random), any(random), any(random)}; };
  for (int i = 0; i < 1000; ++i) {
    const Mapping mapping{std::exp(any(random)), vector(), 3 * vector(), i % 2 == 0};
    Guarded guarded(mapped(mapping));
    guarded.inner->sample.velocity = vector();
    guarded.inner->sample.hasVelocity = true;
    const Vec3 force = vector();
    guarded.device->write(force);
    const double outside = dot(force, guarded.device->read().velocity);
    ASSERT_NEAR(dot(guarded.inner->told, guarded.inner->sample.velocity), outside / mapping.scale, 1e-13);
    ASSERT_NEAR(norm(guarded.inner->told), norm(force), 1e-14) << "felt as it is computed";
  }
}

TEST(Mapping, MirrorsForTheLeftHandThenTurnsThenScalesThenShifts) {
  Mapping mapping{2, {0.1, 0, 0}, {0, std::numbers::pi / 2, 0}, true};
  Guarded guarded(mapped(mapping));
  guarded.inner->sample.position = {0.03, 0.02, 0};
  // Mirrored (-0.03, 0.02, 0); a quarter turn about y takes x to -z: (0, 0.02, 0.03); doubled and shifted.
  const Vec3 place = guarded.device->read().position;
  EXPECT_NEAR(place.x, 0.1, 1e-15);
  EXPECT_NEAR(place.y, 0.04, 1e-15);
  EXPECT_NEAR(place.z, 0.06, 1e-15);
  EXPECT_NEAR(guarded.device->info().workspaceRadius, 0.2, 1e-15);
  EXPECT_EQ(guarded.device->info().workspaceCentre, (Vec3{0.1, 0, 0}));
  EXPECT_FALSE(guarded.device->info().mapping.empty());
}

TEST(Mapping, ATurnedHandleTurnsInTheWorld) {
  Guarded guarded(mapped({1, {}, {0, 0, std::numbers::pi / 2}, false}));
  guarded.inner->sample.hasOrientation = true;  // not turned
  const auto q = guarded.device->read().orientation;
  EXPECT_NEAR(q[0], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(q[3], std::sqrt(0.5), 1e-15);
}

TEST(Mapping, IsReadBackAsItWasSaved) {
  const auto folder = std::filesystem::temp_directory_path() / ("reach-mapping-" + std::to_string(::getpid()));
  const std::string file = mappingFile(folder.string(), "03", "phantom");
  EXPECT_NE(file.find("sub-03_phantom.json"), std::string::npos);
  const Mapping mapping{1.5, {0.1, -0.2, 0.3}, {0.1, 0.2, -0.3}, true};
  saveMapping(mapping, file);
  const Mapping back = readMapping(file);
  EXPECT_EQ(back.scale, mapping.scale);
  EXPECT_EQ(back.offset, mapping.offset);
  EXPECT_LT(norm(back.rotation - mapping.rotation), 1e-15) << "degrees in the file";
  EXPECT_TRUE(back.mirrorX);
  std::filesystem::remove_all(folder);
}

TEST(Mapping, WhatIsNoMappingIsRefusedWithItsKey) {
  for (const char* text :
       {"[]", "{\"scale\": 0}", "{\"scale\": \"two\"}", "{\"offset_m\": [1, 2]}", "{\"colour\": 1}", "{\"mirror_x\": 1}"})
    EXPECT_THROW(mappingFromJson(text, "here"), FaultError) << text;
}

TEST(HandOptions, AreTakenBeforeTheDriversOwn) {
  const auto experiment = experiment::readExperiment("chain-slow");
  const auto device =
      makeDevice("virtual:omni,arm-mass=1,scale=2,wall=yes,speed-limit=1,stylus-mass=0.295,passivity=control", experiment, 1);
  const haptics::DeviceInfo info = device->info();
  EXPECT_NEAR(info.guards.wallRadius, 0.2, 1e-12);
  EXPECT_EQ(info.speedLimit, 1);
  EXPECT_NEAR(info.guards.compensation.y, 0.295 * 9.80665, 1e-12);
  EXPECT_TRUE(info.guards.passivityControl);
  const haptics::DeviceInfo plain = makeDevice("virtual:omni,arm-mass=1", experiment, 1)->info();
  EXPECT_EQ(plain.guards.compensation, Vec3{}) << "nothing is held up that nobody has weighed";
  EXPECT_EQ(plain.guards.wallRadius, haptics::DeviceInfo{}.guards.wallRadius);
  EXPECT_FALSE(plain.guards.passivityControl);
  EXPECT_THROW(makeDevice("virtual:omni,wall=maybe", experiment, 1), FaultError);
  EXPECT_THROW(makeDevice("virtual:omni,offset=1/2", experiment, 1), FaultError);
  EXPECT_THROW(makeDevice("virtual:omni,colour=red,scale=2", experiment, 1), FaultError);
}

}  // namespace
}  // namespace reachlab::devices
