#include "devices/mapping/mapping.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "base/error.h"
#include "base/fault.h"
#include "devices/kept_mapping.h"
#include "devices/make_device.h"
#include "devices/mapping/guarded_device.h"
#include "sim/experiment/experiment.h"
#include "tests/devices/fakes/fake_input.h"
#include "tests/haptics/set_device.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace reachlab::devices {
namespace {

using haptics::test::SetDevice;

struct Guarded {
  explicit Guarded(const HandSettings& options) {
    auto owned = std::make_unique<SetDevice>();
    inner = owned.get();
    inner->about.rendersForce = true;
    inner->about.workspaceRadius = 0.1;
    inner->about.resolution = 1e-5;
    device = guardDevice(std::move(owned), options);
  }
  SetDevice* inner;
  std::unique_ptr<haptics::HapticDevice> device;
};

TEST(GuardedDevice, PassesOnWhatIsAskedOfTheDevice) {
  Guarded guarded({.speedLimit = 1});
  haptics::HapticDevice& device = *guarded.device;
  guarded.inner->is = haptics::DeviceHealth::Warm, guarded.inner->says = "warm", guarded.inner->hint = "hold it";
  device.prepareTrial(7);
  device.cue(haptics::Cue::Go);
  const std::array<dynamics::MassState, 3> masses{};
  device.see(masses);
  device.calibrate();
  EXPECT_TRUE(device.stopForce());
  bool ticked = false;
  device.startClock([](void* flag) noexcept { *static_cast<bool*>(flag) = true; }, &ticked);
  device.stopClock();
  EXPECT_TRUE(ticked);
  EXPECT_EQ(guarded.inner->calls, "prepare 7; go; see 3; calibrate; stop; clock; no clock; ");
  EXPECT_EQ(device.health(), haptics::DeviceHealth::Warm);
  EXPECT_EQ(device.healthText(), "warm");
  EXPECT_EQ(device.calibrationHint(), "hold it");
  EXPECT_EQ(device.info().speedLimit, 1);
  EXPECT_EQ(device.info().mapping, "");
}

HandSettings mapped(const Mapping& mapping) { return {.mapping = mapping, .mapped = true}; }

TEST(DeadManButton, GivesForceOnlyWhileItIsHeld) {
  Guarded guarded({.deadManButton = 2});
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
  EXPECT_THROW(makeDevice("virtual:omni,dead-man-button=1", experiment, 1), FaultError) << "no hand presses it";
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
    ASSERT_NEAR(dot(guarded.inner->written.back(), guarded.inner->sample.velocity), outside / mapping.scale, 1e-13);
    ASSERT_NEAR(norm(guarded.inner->written.back()), norm(force), 1e-14) << "felt as it is computed";
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

// Twice as large in the world: lengths, steps and speeds as well. The stylus' weight is held along the device's own upwards.
TEST(Mapping, WhatTheDeviceTellsOfItselfIsOfTheWorld) {
  HandSettings options = mapped({2, {0.1, 0, 0}, {0, 0, std::numbers::pi / 2}, false});
  options.wall = 0;
  options.stylusMass = 0.5;
  const haptics::DeviceInfo info = Guarded(options).device->info();
  EXPECT_NEAR(info.resolution, 2e-5, 1e-18);
  EXPECT_NEAR(info.speedLimit, 2 * haptics::DeviceInfo{}.speedLimit, 1e-15);
  EXPECT_NEAR(info.guards.wallRadius, 0.2, 1e-15);
  EXPECT_EQ(info.guards.wallCentre, (Vec3{0.1, 0, 0}));
  EXPECT_LT(norm(info.guards.compensation - Vec3{-0.5 * 9.80665, 0, 0}), 1e-14);
  options.wall = 0.07;
  EXPECT_EQ(Guarded(options).device->info().guards.wallRadius, 0.07);
}

TEST(Mapping, IsWrittenInDegreesAndReadWithEveryKeyLeftOut) {
  EXPECT_EQ(toJson({1.5, {0.1, -0.2, 0.3}, {std::numbers::pi, 0, -std::numbers::pi / 2}, true}),
            R"({"scale":1.5,"offset_m":[0.1,-0.2,0.3],"rotation_deg":[180.0,0.0,-90.0],"mirror_x":true})");
  const Mapping none = mappingFromJson("{}", "here");
  EXPECT_EQ(none.scale, 1);
  EXPECT_EQ(none.offset, Vec3{});
  EXPECT_EQ(none.rotation, Vec3{});
  EXPECT_FALSE(none.mirrorX);
}

TEST(Mapping, OneThatCannotBeSavedIsSaid) {
  EXPECT_THROW(saveMapping({}, "/proc/nowhere/mapping.json"), ResourceError);
  EXPECT_EQ(mappingFile("/data", "03", "phantom"), "/data/sourcedata/mappings/sub-03_phantom.json");
}

TEST(Mapping, IsReadBackAsItWasSaved) {
  const TemporaryFolder folder;
  const std::string file = mappingFile(folder.path(), "03", "phantom");
  EXPECT_TRUE(holds(file, "sub-03_phantom.json"));
  const Mapping mapping{1.5, {0.1, -0.2, 0.3}, {0.1, 0.2, -0.3}, true};
  saveMapping(mapping, file);
  const Mapping back = readMapping(file);
  EXPECT_EQ(back.scale, mapping.scale);
  EXPECT_EQ(back.offset, mapping.offset);
  EXPECT_LT(norm(back.rotation - mapping.rotation), 1e-15) << "degrees in the file";
  EXPECT_TRUE(back.mirrorX);
}

TEST(Mapping, WhatIsNoMappingIsRefusedWithItsKey) {
  for (const char* text :
       {"[]", "{\"scale\": 0}", "{\"scale\": \"two\"}", "{\"offset_m\": [1, 2]}", "{\"colour\": 1}", "{\"mirror_x\": 1}"})
    EXPECT_THROW(mappingFromJson(text, "here"), FaultError) << text;
}

TEST(HandSettings, AreTakenBeforeTheDriversOwn) {
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
  EXPECT_TRUE(holds(refusalOf([&] { makeDevice("virtual:omni,colour=red,scale=2", experiment, 1); }),
                    "device virtual:omni,colour=red: colour is not known; allowed: arm-mass"));
}

std::string refusalOfSettings(const std::string& options) {
  DeviceOptions asked(options, "device x");
  return refusalOf(
      [&] {
        (void)takeHandSettings(asked);
        asked.done();
      },
      "taken");
}

HandSettings taken(const std::string& options) {
  DeviceOptions asked(options, "device x");
  return takeHandSettings(asked);
}

TEST(HandSettings, AreBoundedAndNoneIsNone) {
  EXPECT_FALSE(taken("").any());
  for (const char* good : {"scale=0.01", "scale=100", "offset=10/-10/0", "rotation=360/0/-360", "mirror=no", "mirror=x", "wall=yes",
                           "wall=no", "wall=10", "wall=0.001", "speed-limit=0.01", "speed-limit=20", "stylus-mass=0", "stylus-mass=2",
                           "passivity=observe", "passivity=control", "dead-man-button=1", "dead-man-button=32"})
    EXPECT_EQ(refusalOfSettings(good), "taken") << good;
  for (const char* bad :
       {"scale=0.009",        "scale=101",        "offset=10.1/0/0", "offset=0/0/-10.1", "offset=1/2/3/4",    "offset=1/2/3x",
        "offset=1/2",         "offset=1",         "offset=/1/2",     "offset=1,2,3",     "rotation=361/0/0",  "rotation=0/-361/0",
        "mirror=y",           "wall=0",           "wall=-1",         "wall=10.1",        "wall=1x",           "speed-limit=0.009",
        "speed-limit=21",     "stylus-mass=-0.1", "stylus-mass=2.1", "passivity=yes",    "dead-man-button=0", "dead-man-button=33",
        "dead-man-button=1.5"})
    EXPECT_NE(refusalOfSettings(bad), "taken") << bad;
  EXPECT_TRUE(holds(refusalOfSettings("offset=1/2"), "offset=1/2; allowed: X/Y/Z, each within 10"));
  EXPECT_TRUE(holds(refusalOfSettings("rotation=a/b/c"), "each within 360"));
  EXPECT_TRUE(holds(refusalOfSettings("wall=maybe"), "wall=maybe; allowed: yes, no or a radius up to 10 m"));
  EXPECT_TRUE(holds(refusalOfSettings("dead-man-button=1.5"), "dead-man-button=1.5; allowed: a button's number, 1 to 32"));
}

TEST(HandSettings, SayWhatWasAskedFor) {
  const HandSettings all =
      taken("scale=2,offset=0.1/-0.2/0.3,rotation=90/0/-180,mirror=x,wall=0.4,speed-limit=2.5,stylus-mass=0.3,dead-man-button=3");
  EXPECT_TRUE(all.mapped);
  EXPECT_EQ(all.mapping.scale, 2);
  EXPECT_EQ(all.mapping.offset, (Vec3{0.1, -0.2, 0.3}));
  EXPECT_LT(norm(all.mapping.rotation - std::numbers::pi * Vec3{0.5, 0, -1}), 1e-15);
  EXPECT_TRUE(all.mapping.mirrorX);
  EXPECT_EQ(all.wall, 0.4);
  EXPECT_EQ(all.speedLimit, 2.5);
  EXPECT_EQ(all.stylusMass, 0.3);
  EXPECT_FALSE(all.passivityControl);
  EXPECT_EQ(all.deadManButton, 3);
  for (const char* one : {"scale=2", "offset=1/0/0", "rotation=1/0/0", "mirror=x"}) EXPECT_TRUE(taken(one).mapped) << one;
  for (const char* one : {"wall=yes", "speed-limit=1", "stylus-mass=0", "passivity=control", "dead-man-button=1"}) {
    EXPECT_FALSE(taken(one).mapped) << one;
    EXPECT_TRUE(taken(one).any()) << one;
  }
  EXPECT_EQ(taken("wall=yes").wall, 0) << "the device's own";
  EXPECT_FALSE(taken("wall=no").wall);
  EXPECT_EQ(taken("stylus-mass=0").stylusMass, 0);
  EXPECT_FALSE(taken("mirror=no").mapping.mirrorX);
  const TemporaryFolder folder;
  const std::string mirrored = folder.write("mirrored.json", R"({"mirror_x": true})");
  EXPECT_TRUE(taken("mapping=" + mirrored).mapping.mirrorX);
  EXPECT_FALSE(taken("mapping=" + mirrored + ",mirror=no").mapping.mirrorX) << "said last";
}

// A SpaceMouse puts the hand at the start before each trial. A mapping turns its motion and leaves the start.
TEST(HandSettings, AHandThatIsSteeredKeepsItsStart) {
  auto owned = std::make_unique<SetDevice>();
  SetDevice& inner = *owned;
  inner.about.steered = true;
  inner.sample.position = inner.about.workspaceCentre = {-0.1, 0.2, 0.3};
  const auto device = guardDevice(std::move(owned), mapped({2, {}, {}, true}));
  EXPECT_EQ(device->read().position, (Vec3{-0.1, 0.2, 0.3}));
  inner.sample.position += Vec3{0.01, 0.01, 0};
  EXPECT_LT(norm(device->read().position - Vec3{-0.12, 0.22, 0.3}), 1e-15);
}

TEST(HandSettings, AWallNeedsAWorkspaceOrARadius) {
  bool rendersForce = true;
  const auto refusal = [&](const HandSettings& options) {
    auto device = std::make_unique<SetDevice>(Vec3{}, "unknown");
    device->about.rendersForce = rendersForce;
    return refusalOf([&] { (void)guardDevice(std::move(device), options); }, "made");
  };
  EXPECT_TRUE(holds(refusal({.wall = 0}), "wall=yes: the workspace of unknown is not known; allowed: wall=RADIUS_M"));
  EXPECT_EQ(refusal({.wall = 0.1}), "made");
  EXPECT_EQ(refusal({}), "made");
  rendersForce = false;
  for (const auto& [key, asked] : {std::pair{"wall", HandSettings{.wall = 0.1}},
                                   {"speed-limit", {.speedLimit = 1.0}},
                                   {"stylus-mass", {.stylusMass = 0.1}},
                                   {"passivity", {.passivityControl = true}},
                                   {"dead-man-button", {.deadManButton = 1}}})
    EXPECT_TRUE(holds(refusal(asked), std::string(key) + ": unknown renders no force")) << "it would change nothing";
  auto own = std::make_unique<SetDevice>();
  const haptics::HapticDevice* const inner = own.get();
  EXPECT_EQ(guardDevice(std::move(own), {}).get(), inner) << "nothing asked for: itself";
}

/// A dataset of its own.
class KeptMappings : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return data + "/sourcedata/mappings/sub-07_" + name + ".json"; }
  std::string with(const std::string& device) {
    files.clear();
    return withKeptMappings(device, data, "07", files);
  }
  const TemporaryFolder folder;
  const std::string data = folder.path();
  std::vector<std::string> files;
};

TEST_F(KeptMappings, AreTakenUpWhereNoneIsAskedFor) {
  EXPECT_EQ(keepMappings("phantom,scale=2", data, "07"), std::vector<std::string>{file("phantom")});
  EXPECT_EQ(readMapping(file("phantom")).scale, 2);
  EXPECT_TRUE(keepMappings("phantom:Left", data, "07").empty());
  EXPECT_TRUE(keepMappings("phantom,wall=0.1", data, "07").empty()) << "a wall is no mapping";
  const std::string mapping = "scale=2";
  EXPECT_EQ(with("phantom"), "phantom," + mapping);
  EXPECT_EQ(files, std::vector<std::string>{file("phantom")});
  EXPECT_EQ(with("phantom:"), "phantom," + mapping);
  for (const char* other : {"phantom:Right", "virtual:omni"}) EXPECT_EQ(with(other), other) << "another device";
  saveMapping({}, file("virtual-omni"));
  EXPECT_EQ(with("virtual:omni,noise=0"), "virtual:omni,noise=0,scale=1");
  EXPECT_EQ(with("virtual:premium15"), "virtual:premium15");
  EXPECT_EQ(with("phantom,wall=0.2"), "phantom,wall=0.2," + mapping);
  EXPECT_EQ(with("phantom,scale=3"), "phantom,scale=3") << "what is asked for goes first";
  EXPECT_EQ(with("phantom:Left,mirror=x,scale=2,rotation=0/0/15,wall=0.2"), "phantom:Left,wall=0.2,scale=2,rotation=0/0/15,mirror=x")
      << "one text for one device, as resuming compares them";
  EXPECT_TRUE(files.empty());
  saveMapping({}, file("replay"));
  EXPECT_EQ(with("replay:x"), "replay:x") << "a recording has no mapping";
}

// `reach list devices` and the window name it "tablet:/dev/input/event1".
TEST_F(KeptMappings, TheOnlyDeviceOfItsKindIsTheSameByItsKindAndByItsName) {
  const TabletNode pen{.path = "/dev/input/event1", .name = "Pen", .x = {}, .y = {}, .whyNot = {}};
  test::fakeInputs().listed = {pen};
  (void)keepMappings("tablet,scale=2", data, "07");
  EXPECT_EQ(with("tablet:/dev/input/event1"), "tablet:/dev/input/event1,scale=2");
  EXPECT_EQ(with("tablet:/dev/input/event2"), "tablet:/dev/input/event2") << "it is not here";
  TabletNode other = pen;
  other.path = "/dev/input/event2";
  test::fakeInputs().listed = {pen, other};
  EXPECT_EQ(with("tablet:/dev/input/event2"), "tablet:/dev/input/event2") << "it may be the one or the other";
  (void)keepMappings("tablet:/dev/input/event2,scale=3", data, "07");
  std::filesystem::remove(file("tablet"));
  EXPECT_EQ(with("tablet"), "tablet");
  test::fakeInputs().listed = {other};
  EXPECT_EQ(with("tablet"), "tablet,scale=3");
  test::fakeInputs().listed.reset();
}

TEST_F(KeptMappings, OfSeveralHandsEachHasItsOwn) {
  const auto kept = keepMappings("phantom:Le-ft!,scale=2 + phantom:Right,mirror=x + hid,scale=3", data, "07");
  EXPECT_EQ(kept, (std::vector<std::string>{file("phantom-Le%2Dft%21"), file("phantom-Right"), file("hid")}));
  EXPECT_TRUE(readMapping(kept[1]).mirrorX);
  EXPECT_EQ(with("phantom:Right + hid + phantom:Left"), "phantom:Right,mirror=x + hid,scale=3 + phantom:Left");
  EXPECT_EQ(files.size(), 2u);
}

}  // namespace
}  // namespace reachlab::devices
