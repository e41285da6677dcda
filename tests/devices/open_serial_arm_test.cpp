#include "devices/hid/open_serial_arm.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "devices/hid/arm_report.h"
#include "devices/hid/space_mouse_report.h"
#include "tests/devices/arm_poses.h"

namespace reachlab::devices {
namespace {

// Places of the workspace: a ball of 8 cm about its origin.
class Places {
 public:
  Vec3 next() {
    std::uniform_real_distribution<double> within(-0.045, 0.045);
    return {within(random_), within(random_), within(random_)};
  }

 private:
  std::mt19937 random_{1};
};

TEST(OpenSerialArm, KnowsTheHomePoseOfThePublishedModel) {
  const ArmModel& model = *findArmModel("woodenhaptics_v2015");
  const auto angles = jointAngles(model, {0, 0, 6000});
  EXPECT_NEAR(angles[2], std::numbers::pi / 2, 1e-12) << "6000 counts of 2000 a turn through 12:1";
  const Vec3 home = handlePlace(model, angles);
  EXPECT_NEAR(home.x, 0.025, 1e-12);
  EXPECT_NEAR(home.y, 0, 1e-12);
  EXPECT_NEAR(home.z, 0.205, 1e-12);
}

TEST(OpenSerialArm, EveryJointIsCalibratedAtARightAngleOfIts) {
  for (const ArmModel& model : armModels()) {
    const auto& counts = model.calibrationCounts;
    for (const double angle : jointAngles(model, {double(counts[0]), double(counts[1]), double(counts[2])})) {
      const double quarters = angle / (std::numbers::pi / 2);
      EXPECT_NEAR(quarters, std::round(quarters), 1e-12) << model.name;
    }
  }
}

TEST(OpenSerialArm, PlaceAndAnglesAreEachOthersInverse) {
  for (const ArmModel& model : armModels()) {
    Places places;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 place = places.next();
      EXPECT_LT(norm(handlePlace(model, anglesAt(model, place)) - place), 1e-12) << model.name;
      const auto angles = anglesAt(model, place), again = jointAngles(model, encoderCounts(model, angles));
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(again[j], angles[j], 1e-12);
    }
  }
}

TEST(OpenSerialArm, TheJacobianIsTheDifferenceOfPlaces) {
  constexpr double kStep = 1e-6;  // central difference: error step^2 |r'''|/6 < 1e-12, rounding 1e-16/1e-6 = 1e-10
  for (const ArmModel& model : armModels()) {
    Places places;
    for (int i = 0; i < 100; ++i) {
      const auto angles = anglesAt(model, places.next());
      const auto rows = jacobianRows(model, angles);
      for (int j = 0; j < 3; ++j) {
        auto more = angles, less = angles;
        more[j] += kStep, less[j] -= kStep;
        const Vec3 column = (handlePlace(model, more) - handlePlace(model, less)) / (2 * kStep);
        const double parts[3] = {column.x, column.y, column.z};
        for (int row = 0; row < 3; ++row) {
          const double entry = j == 0 ? rows[row].x : j == 1 ? rows[row].y : rows[row].z;
          EXPECT_NEAR(entry, parts[row], 1e-9) << model.name;
        }
      }
    }
  }
}

TEST(OpenSerialArm, TheMotorsDoTheWorkOfTheForce) {
  for (const ArmModel& model : armModels()) {
    Places places;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < 200; ++i) {
      const auto angles = anglesAt(model, places.next());
      const Vec3 force{any(random), any(random), any(random)};
      const auto rows = jacobianRows(model, angles);
      const auto torque = jointTorques(model, angles, force);
      const Vec3 rates{any(random), any(random), any(random)};
      const Vec3 velocity{dot(rows[0], rates), dot(rows[1], rates), dot(rows[2], rates)};
      EXPECT_NEAR(torque[0] * rates.x + torque[1] * rates.y + torque[2] * rates.z, dot(force, velocity), 1e-14) << "tau theta' = F v";
    }
  }
}

// Published numbers of the force at the workspace's origin that 2 A give along each axis.
TEST(OpenSerialArm, ReachesThePublishedForces) {
  const auto largest = [](const char* name, const Vec3& direction) {
    const ArmModel& model = *findArmModel(name);
    const auto angles = anglesAt(model, {});
    const auto current = motorCurrents(model, angles, direction, 1e9);
    return 2 / std::max({std::abs(current[0]), std::abs(current[1]), std::abs(current[2])});
  };
  EXPECT_NEAR(largest("woodenhaptics_v2015", {1, 0, 0}), 3.2, 0.05);
  EXPECT_NEAR(largest("woodenhaptics_v2015", {0, 1, 0}), 3.8, 0.05);
  EXPECT_NEAR(largest("woodenhaptics_v2015", {0, 0, 1}), 4.1, 0.05);
  EXPECT_NEAR(largest("polhem_v1", {1, 0, 0}), 6.8, 0.05);
  EXPECT_NEAR(largest("polhem_v1", {0, 1, 0}), 13.8, 0.05);
  EXPECT_NEAR(largest("polhem_v1", {0, 0, 1}), 14.5, 0.05);
}

TEST(OpenSerialArm, CurrentsBeyondTheLimitKeepTheForcesDirection) {
  const ArmModel& model = *findArmModel("woodenhaptics_v2015");
  const auto angles = anglesAt(model, {0.02, -0.03, 0.01});
  const auto free = motorCurrents(model, angles, {30, -20, 10}, 1e9), held = motorCurrents(model, angles, {30, -20, 10}, 2);
  double most = 0;
  for (const double i : held) most = std::max(most, std::abs(i));
  EXPECT_NEAR(most, 2, 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(held[i] / free[i], held[0] / free[0], 1e-12);
}

TEST(OpenSerialArm, WhatIsNoNumberIsNoCurrent) {
  const ArmModel& model = armModels()[0];
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double i : motorCurrents(model, anglesAt(model, {}), {nan, 0, 0}, 2)) EXPECT_EQ(i, 0);
  for (const double i : motorCurrents(model, {nan, 0, 0}, {1, 0, 0}, 2)) EXPECT_EQ(i, 0);
}

TEST(ArmReport, EveryEncoderHasItsPlaceAndTheButtonBeginsBeyondHalfItsOffset) {
  const auto reportOf = [](const std::array<int, 7>& fields) {
    std::vector<std::uint8_t> bytes;
    for (const int value : fields)
      bytes.push_back(static_cast<std::uint8_t>(value & 0xFF)), bytes.push_back(static_cast<std::uint8_t>(value >> 8 & 0xFF));
    return decodeArmReport(bytes).value();
  };
  const ArmReport plain = reportOf({-1, 258, -32768, 5000, 32767, -300, 2});
  EXPECT_EQ(plain.encoders, (std::array<std::int16_t, 6>{-1, 258, -32768, 5000, 32767, -300}));
  EXPECT_FALSE(plain.button);
  EXPECT_FALSE(plain.calibrationButton) << "another bit";
  const ArmReport pressed = reportOf({0, 0, 0, 5001, 0, 0, 3});
  EXPECT_TRUE(pressed.button);
  EXPECT_EQ(pressed.encoders[3], -4999);
  EXPECT_TRUE(pressed.calibrationButton);
}

TEST(ArmReport, ACommandOfMilliamperesFitsIntoFifteenBytesAndIsNoneInFewer) {
  ArmCommand command;
  command.currents = {0.0004, -0.0006, -1000};
  command.encoders = {1, 2, 3, 4, 5, 6};
  std::vector<std::uint8_t> enough(15, 0xAA), fewer(14, 0xAA);
  encodeArmCommand(command, enough);
  EXPECT_EQ(enough, (std::vector<std::uint8_t>{0, 0, 0, 0xFF, 0xFF, 0x01, 0x80, 0, 0, 0, 0, 0, 0, 0, 0}))
      << "rounded to 0 and -1 mA, held to -32767; currents carry no encoders";
  command.currents = {1.5, std::numeric_limits<double>::quiet_NaN(), 1000};
  encodeArmCommand(command, enough);
  EXPECT_EQ(enough, (std::vector<std::uint8_t>{0, 0xDC, 0x05, 0, 0, 0xFF, 0x7F, 0, 0, 0, 0, 0, 0, 0, 0}))
      << "1000 A does not turn round to a negative current";
  encodeArmCommand(command, fewer);
  EXPECT_EQ(fewer, std::vector<std::uint8_t>(14, 0));
}

TEST(ArmReport, SettingEncodersCarriesThemInTheCommandsAttributes) {
  std::uint8_t bytes[15];
  ArmCommand command;
  command.kind = ArmCommand::SetEncoders;
  command.encoders = {1, 2, -5000, 7, 8, 9};
  encodeArmCommand(command, bytes);
  const auto field = [&](int at) { return static_cast<std::int16_t>(bytes[at] | bytes[at + 1] << 8); };
  EXPECT_EQ(field(7), 1);
  EXPECT_EQ(field(9), 1);
  EXPECT_EQ(field(11), 2);
  EXPECT_EQ(field(13), -5000);
  EXPECT_EQ(field(1), 7);
  EXPECT_EQ(field(3), 8);
  EXPECT_EQ(field(5), 9);
}

TEST(UnwrappedCount, GoesOnPastTheEndsOfSixteenBits) {
  UnwrappedCount count;
  std::int32_t truth = 0;
  for (int i = 0; i < 1000; ++i, truth += 997) EXPECT_EQ(count.take(static_cast<std::int16_t>(truth)), truth);
  for (int i = 0; i < 3000; ++i, truth -= 1009) EXPECT_EQ(count.take(static_cast<std::int16_t>(truth)), truth);
}

TEST(SpaceMouseReport, EveryAxisHasItsPlace) {
  SpaceMouseState state;
  // 35, 70, 105 of 350: sensor x, y, z; then -35, -70, -105.
  const std::uint8_t push[7] = {1, 35, 0, 70, 0, 105, 0}, twist[7] = {2, 221, 255, 186, 255, 151, 255};
  ASSERT_TRUE(takeSpaceMouseReport(push, state));
  EXPECT_EQ(state.push, (Vec3{0.1, -0.3, 0.2}));
  ASSERT_TRUE(takeSpaceMouseReport(twist, state));
  EXPECT_EQ(state.push, (Vec3{0.1, -0.3, 0.2}));
  SpaceMouseState both;
  const std::uint8_t six[13] = {1, 35, 0, 70, 0, 105, 0, 221, 255, 186, 255, 151, 255};
  ASSERT_TRUE(takeSpaceMouseReport(six, both));
  EXPECT_EQ(both.push, state.push);
  std::vector<std::uint8_t> two(six, six + 13);
  two.insert(two.end(), six, six + 13);
  two[14] = 70;
  ASSERT_TRUE(takeSpaceMouseReport(two, both));
  EXPECT_EQ(both.push.x, 0.2) << "two of them joined: the second";
}

TEST(SpaceMouseReport, ButtonsAreOneToFourBytes) {
  const auto buttonsOf = [](const std::vector<std::uint8_t>& report) {
    SpaceMouseState state;
    state.buttons = 7;
    return std::pair{takeSpaceMouseReport(report, state), state.buttons};
  };
  EXPECT_EQ(buttonsOf({3}), (std::pair{false, 7u}));
  EXPECT_EQ(buttonsOf({3, 0x81}), (std::pair{true, 0x81u}));
  EXPECT_EQ(buttonsOf({3, 1, 2, 3, 0x84}), (std::pair{true, 0x84030201u}));
  EXPECT_EQ(buttonsOf({3, 1, 2, 3, 4, 5}), (std::pair{false, 7u}));
}

TEST(SpaceMouseReport, JoinedReportsAreTakenApartAndGarbageIsNone) {
  SpaceMouseState state;
  const std::uint8_t joined[14] = {1, 0xAF, 0, 0, 0, 0, 0, 2, 0, 0, 0x5E, 1, 0, 0};
  ASSERT_TRUE(takeSpaceMouseReport(joined, state));
  EXPECT_EQ(state.push.x, 0.5);
  const std::uint8_t wild[7] = {1, 0xFF, 0x7F, 0, 0x80, 0, 0};
  ASSERT_TRUE(takeSpaceMouseReport(wild, state));
  EXPECT_EQ(state.push.x, 1) << "held to the range";
  for (const std::size_t length : {0u, 1u, 5u, 8u, 12u}) EXPECT_FALSE(takeSpaceMouseReport(std::span(joined, length), state)) << length;
  const std::uint8_t other[7] = {23, 80, 0, 0, 0, 0, 0};
  EXPECT_FALSE(takeSpaceMouseReport(other, state));
}

}  // namespace
}  // namespace reachlab::devices
