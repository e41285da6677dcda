#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/fault.h"
#include "devices/hid/stick_force.h"
#include "tests/devices/fakes/pid_firmware.h"

namespace reachlab::devices {
namespace {

using Bytes = test::PidBytes;

/// Keeps what it is told, and answers as it is asked to.
struct Diary final : HidPort {
  std::vector<Bytes> written, features;
  std::function<bool(const Bytes&)> takes = [](const Bytes&) { return true; };
  bool takesFeatures = true;
  Bytes load{2, 7, 1};  // Block Load: effect 7, success
  int loads = 0;
  int read(std::span<std::uint8_t>, int) noexcept override { return 0; }
  bool write(std::span<const std::uint8_t> bytes) noexcept override {
    const Bytes report(bytes.begin(), bytes.end());
    if (!takes(report)) return false;
    written.push_back(report);
    return true;
  }
  bool sendFeature(std::span<const std::uint8_t> bytes) noexcept override {
    features.emplace_back(bytes.begin(), bytes.end());
    return takesFeatures;
  }
  int getFeature(std::span<std::uint8_t> bytes) noexcept override {
    Bytes answer = load;
    if (loads++ > 0 && answer.size() > 1) answer[1] = static_cast<std::uint8_t>(answer[1] + 1);  // the next effect
    std::copy_n(answer.begin(), std::min(answer.size(), bytes.size()), bytes.begin());
    return static_cast<int>(answer.size());
  }
};

// `from` becomes `to` at its first place behind `behind`.
Bytes patched(Bytes descriptor, const Bytes& behind, const Bytes& from, const Bytes& to) {
  const auto begin = std::search(descriptor.begin(), descriptor.end(), behind.begin(), behind.end());
  const auto at = std::search(begin, descriptor.end(), from.begin(), from.end());
  if (begin == descriptor.end() || at == descriptor.end()) throw std::runtime_error("no such bytes");
  std::copy(to.begin(), to.end(), at);
  return descriptor;
}

std::unique_ptr<StickForce> forceOf(const Bytes& descriptor) { return makePidForce(parseReportDescriptor(descriptor)); }

std::string refusalOf(const Bytes& descriptor) {
  try {
    (void)forceOf(descriptor);
  } catch (const FaultError& error) {
    return error.faults.at(0).what;
  }
  return "taken";
}

bool begins(const Bytes& report, std::uint8_t number) { return report.at(0) == number; }

// Byte for byte by the descriptor: actuators on, the device's gain, then for each axis Set Effect (constant force, for ever, no trigger, its
// axis by a direction of its own), no magnitude, start.
TEST(PidForce, IsMadeReadyByTheReportsThatTheDescriptorAsksFor) {
  for (const bool mask : {false, true}) {
    Diary port;
    const auto force = forceOf(test::pidDescriptor(mask));
    ASSERT_EQ(force->start(port), "");
    EXPECT_EQ(force->axes(), 2);
    EXPECT_EQ(port.features, (std::vector<Bytes>{{1, 1, 0, 0}, {1, 1, 0, 0}})) << "a new effect of constant force";
    EXPECT_EQ(port.written, (std::vector<Bytes>{{0x0C, 1},
                                                {0x0D, 255},
                                                {1, 7, 1, 0xFF, 0x7F, 0, 0, 0, 0, 255, 255, 1 | 4, 63, 0},
                                                {5, 7, 0, 0},
                                                {0x0A, 7, 1, 1},
                                                {1, 8, 1, 0xFF, 0x7F, 0, 0, 0, 0, 255, 255, 2 | 4, 0, 0},
                                                {5, 8, 0, 0},
                                                {0x0A, 8, 1, 1}}));
    port.written.clear();
    EXPECT_TRUE(force->tell(port, 0.5, -0.25));
    EXPECT_EQ(port.written, (std::vector<Bytes>{{5, 7, 0x88, 0x13}, {5, 8, 0x3C, 0xF6}})) << "5000 and -2500 of 10000";
    port.written.clear();
    force->stop(port);
    EXPECT_EQ(port.written,
              (std::vector<Bytes>{
                  {5, 7, 0, 0}, {0x0A, 7, 3, 1}, {5, 8, 0, 0}, {0x0A, 8, 3, 1}, {0x0C, static_cast<std::uint8_t>(mask ? 4 : 3)}}));
  }
}

TEST(PidForce, EachAxisIsToldWhenItChangesAndHeldToFull) {
  Diary port;
  const auto force = forceOf(test::pidDescriptor());
  ASSERT_EQ(force->start(port), "");
  const auto told = [&](double x, double y) {
    port.written.clear();
    EXPECT_TRUE(force->tell(port, x, y));
    return port.written;
  };
  using Told = std::vector<Bytes>;
  EXPECT_EQ(told(0, 0), Told{}) << "as it was started";
  EXPECT_EQ(told(0, 3), (Told{{5, 8, 0x10, 0x27}}));
  EXPECT_EQ(told(-3, 1), (Told{{5, 7, 0xF0, 0xD8}}));
  EXPECT_EQ(told(-1, 0.99999), Told{}) << "less than half a step";
  ASSERT_EQ(force->start(port), "");
  EXPECT_EQ(told(0, 0), Told{}) << "started again there is none";
}

TEST(PidForce, ARefusedMagnitudeIsALossAndTheOtherAxisIsToldAllTheSame) {
  for (const int refused : {7, 8}) {
    Diary port;
    const auto force = forceOf(test::pidDescriptor());
    ASSERT_EQ(force->start(port), "");
    port.written.clear();
    port.takes = [=](const Bytes& report) { return report[1] != refused; };
    EXPECT_FALSE(force->tell(port, 1, 1));
    ASSERT_EQ(port.written.size(), 1u);
    EXPECT_EQ(port.written[0][1], refused == 7 ? 8 : 7);
  }
}

TEST(PidForce, WhyItCannotBeMadeReadyIsSaid) {
  const auto saidBy = [](const std::function<void(Diary&)>& change) {
    Diary port;
    change(port);
    return forceOf(test::pidDescriptor())->start(port);
  };
  EXPECT_EQ(saidBy([](Diary& port) { port.takesFeatures = false; }), "it makes no new effect (Create New Effect is refused)");
  EXPECT_EQ(saidBy([](Diary& port) { port.load = {2}; }), "it does not tell of its new effect (Block Load)");
  EXPECT_EQ(saidBy([](Diary& port) { port.load = {2, 7, 2}; }), "it has no room for an effect (Block Load Status 2)");
  EXPECT_EQ(saidBy([](Diary& port) { port.load = {2, 0, 1}; }), "it gives its new effect no number (Block Load)");
  EXPECT_EQ(saidBy([](Diary& port) { port.load = {2, 1, 1}; }), "");
  EXPECT_EQ(saidBy([](Diary& port) { port.load = {9, 7, 1}; }), "it has no room for an effect (Block Load Status -1)") << "another report";
  const auto refusing = [](std::uint8_t number) {
    return [=](Diary& port) { port.takes = [=](const Bytes& report) { return !begins(report, number); }; };
  };
  EXPECT_EQ(saidBy(refusing(1)), "it does not take Set Effect");
  EXPECT_EQ(saidBy(refusing(5)), "its effect does not start");
  EXPECT_EQ(saidBy(refusing(0x0A)), "its effect does not start");
  EXPECT_EQ(saidBy(refusing(0x0D)), "") << "its gain is what it is";
}

TEST(PidForce, WhatTheDescriptorLacksIsNamed) {
  const Bytes whole = test::pidDescriptor();
  EXPECT_EQ(refusalOf(whole), "taken");
  EXPECT_EQ(refusalOf(patched(whole, {0x09, 0xAB}, {0x09, 0x26}, {0x09, 0x28})), "has no constant force among Create New Effect (HID PID)");
  EXPECT_EQ(refusalOf(patched(whole, {0x09, 0x89}, {0x09, 0x22}, {0x09, 0x28})), "has no Block Load with an Effect Block Index (HID PID)");
  EXPECT_EQ(refusalOf(patched(whole, {0x09, 0x21}, {0x09, 0x22}, {0x09, 0x28})), "has no Set Effect with an Effect Block Index (HID PID)");
  EXPECT_EQ(refusalOf(patched(whole, {0x09, 0x73}, {0x09, 0x70}, {0x09, 0x71})), "has no Set Constant Force with a Magnitude (HID PID)");
  EXPECT_EQ(refusalOf(patched(whole, {0x09, 0x77}, {0x09, 0x79}, {0x09, 0x7D})), "has no Effect Operation with Start (HID PID)");
  EXPECT_EQ(refusalOf(patched(whole, {0x09, 0x73}, {0x26, 0x10, 0x27}, {0x26, 0x00, 0x00})), "gives Magnitude no range (HID PID)");
  EXPECT_EQ(refusalOf(patched(whole, {0x09, 0x73}, {0x26, 0x10, 0x27}, {0x26, 0x01, 0x00})), "taken");
}

TEST(PidForce, WithoutASecondAxisThereIsOneEffect) {
  Diary port;
  const auto force = forceOf(patched(test::pidDescriptor(), {0x09, 0x55}, {0x09, 0x31}, {0x09, 0x32}));
  EXPECT_EQ(force->axes(), 1);
  ASSERT_EQ(force->start(port), "");
  EXPECT_EQ(port.features.size(), 1u);
  port.written.clear();
  EXPECT_TRUE(force->tell(port, 1, 1));
  EXPECT_EQ(port.written.size(), 1u);
}

TEST(PidForce, WhatIsOptionalMayBeMissing) {
  Bytes bare = test::pidDescriptor();
  bare = patched(bare, {0x09, 0x7D}, {0x09, 0x7E}, {0x09, 0x7F});  // Device Gain
  bare = patched(bare, {0x09, 0x8B}, {0x09, 0x8C}, {0x09, 0x8A});  // Load Success
  bare = patched(bare, {0x09, 0x77}, {0x09, 0x7B}, {0x09, 0x7D});  // Stop
  bare = patched(bare, {0x09, 0x96}, {0x09, 0x97}, {0x09, 0x9B});  // Enable Actuators
  bare = patched(bare, {0x09, 0x21}, {0x09, 0x52}, {0x09, 0x5F});  // gain of an effect
  bare = patched(bare, {0x05, 0x0A}, {0x09, 0x01}, {0x09, 0x03});  // first ordinal
  Diary port;
  port.load = {2, 7, 2};  // a status that it does not have
  const auto force = forceOf(bare);
  ASSERT_EQ(force->start(port), "");
  ASSERT_EQ(port.written.size(), 6u) << "neither control nor gain";
  EXPECT_EQ(port.written[0], (Bytes{1, 7, 1, 0xFF, 0x7F, 0, 0, 0, 0, 0, 255, 1 | 4, 0, 0}));
  port.written.clear();
  force->stop(port);
  EXPECT_EQ(port.written, (std::vector<Bytes>{{5, 7, 0, 0}, {5, 8, 0, 0}, {0x0C, 3}}));
}

// Feature: type, then the index that Block Load tells. Output: index, magnitude, operation.
TEST(PidForce, ADeviceWithoutReportNumbersIsToldByZero) {
  const Bytes plain{0x05, 0x0F, 0x75, 0x08, 0x95, 0x01, 0x15, 0x01, 0x25, 0x28,  // eight bits each, 1 to 40
                    0x09, 0xAB, 0xA1, 0x02, 0x09, 0x26, 0xB1, 0x00, 0xC0, 0x09, 0x89, 0xA1, 0x02, 0x09, 0x22, 0xB1, 0x02, 0xC0, 0x09,
                    0x21, 0xA1, 0x02, 0x09, 0x22, 0x91, 0x02, 0xC0, 0x15, 0x9C, 0x25, 0x64, 0x09, 0x73, 0xA1, 0x02, 0x09, 0x70, 0x91,
                    0x02, 0xC0, 0x15, 0x01, 0x25, 0x02, 0x09, 0x77, 0xA1, 0x02, 0x09, 0x78, 0x09, 0x79, 0x91, 0x00, 0xC0};
  Diary port;
  port.load = {0, 1, 9};
  const auto force = forceOf(plain);
  ASSERT_EQ(force->start(port), "");
  EXPECT_EQ(port.features, (std::vector<Bytes>{{0, 1, 0}}));
  EXPECT_EQ(port.written, (std::vector<Bytes>{{0, 9, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 2}}));
  EXPECT_TRUE(force->tell(port, -0.5, 0));
  EXPECT_EQ(port.written.back(), (Bytes{0, 0, static_cast<std::uint8_t>(-50), 0}));
}

TEST(LogitechForce, OneThatTakesNoReportIsNotStarted) {
  Diary port;
  port.takes = [](const Bytes&) { return false; };
  EXPECT_EQ(makeG940Force()->start(port), "it takes no force report");
  EXPECT_EQ(makeWheelForce()->start(port), "it takes no force report");
  EXPECT_FALSE(makeWheelForce()->tell(port, 1, 0));
  EXPECT_FALSE(makeG940Force()->tell(port, 1, 0));
}

TEST(LogitechForce, AWheelHasOneAxisAndIsHeldToAByte) {
  Diary port;
  const auto wheel = makeWheelForce();
  EXPECT_EQ(wheel->axes(), 1);
  EXPECT_EQ(wheel->start(port), "");
  for (const auto& [share, level] : {std::pair{0.0, 128}, {1.0, 255}, {-1.0, 1}, {5.0, 255}, {-5.0, 0}, {0.25, 160}, {-0.25, 96}}) {
    ASSERT_TRUE(wheel->tell(port, share, 1));
    EXPECT_EQ(port.written.back(), (Bytes{0, 0x11, 0x08, static_cast<std::uint8_t>(level), 0x80, 0, 0, 0})) << share;
  }
  port.written.clear();
  wheel->stop(port);
  EXPECT_EQ(port.written, (std::vector<Bytes>{{0, 0x11, 0x08, 0x80, 0x80, 0, 0, 0}, {0, 0x13, 0, 0, 0, 0, 0, 0}}));
}

TEST(LogitechForce, TheG940HasTwoAxesAndIsHeldToAByteOfEach) {
  Diary port;
  const auto stick = makeG940Force();
  EXPECT_EQ(stick->axes(), 2);
  EXPECT_EQ(stick->start(port), "");
  const auto told = [&](double x, double y) {
    EXPECT_TRUE(stick->tell(port, x, y));
    return std::pair{static_cast<int>(static_cast<std::int8_t>(port.written.back()[2])),
                     static_cast<int>(static_cast<std::int8_t>(port.written.back()[32]))};
  };
  EXPECT_EQ(told(0.5, -0.25), (std::pair{-64, 32}));
  EXPECT_EQ(told(9, -9), (std::pair{-127, 127}));
  stick->stop(port);
  Bytes none(64, 0);
  none[1] = 0x51;
  EXPECT_EQ(port.written.back(), none);
}

}  // namespace
}  // namespace reachlab::devices
