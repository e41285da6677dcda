#include "devices/hid/stick_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "base/fault.h"
#include "tests/devices/fakes/pid_firmware.h"

namespace reachlab::devices {
namespace {

using test::pidDescriptor;
using Bytes = test::PidBytes;
using Firmware = test::PidFirmware;

class FirmwarePort final : public HidPort {
 public:
  explicit FirmwarePort(std::shared_ptr<Firmware> firmware) : firmware_(std::move(firmware)) {}
  int read(std::span<std::uint8_t> bytes, int milliseconds) noexcept override {
    waits.push_back(milliseconds);
    if (firmware_->gone) return -1;
    if (firmware_->inputs.empty()) return 0;
    const Bytes report = firmware_->inputs.front();
    firmware_->inputs.erase(firmware_->inputs.begin());
    std::copy(report.begin(), report.end(), bytes.begin());
    return static_cast<int>(report.size());
  }
  bool write(std::span<const std::uint8_t> bytes) noexcept override { return firmware_->write({bytes.begin(), bytes.end()}); }
  bool sendFeature(std::span<const std::uint8_t> bytes) noexcept override { return firmware_->setFeature({bytes.begin(), bytes.end()}); }
  int getFeature(std::span<std::uint8_t> bytes) noexcept override {
    const Bytes answer = firmware_->getFeature(bytes[0]);
    if (answer.empty()) return -1;
    std::copy(answer.begin(), answer.end(), bytes.begin());
    return static_cast<int>(answer.size());
  }

  static inline std::vector<int> waits;  // [ms] of each reading

 private:
  std::shared_ptr<Firmware> firmware_;
};

struct Wish final : ForceSource {
  Vec3 force;
  Vec3 newest() noexcept override { return force; }
  std::int64_t now() const noexcept override { return 0; }
};

class PidStick : public ::testing::Test {
 protected:
  StickDevice make(bool mask = false) {
    firmware->mask = mask;
    const HidLayout layout = parseReportDescriptor(pidDescriptor(mask));
    return {{0.05, 2.0, false}, "stick", layout, makePidForce(layout), [this]() -> std::unique_ptr<HidPort> {
              if (firmware->gone) throw ResourceError("gone");
              return std::make_unique<FirmwarePort>(firmware);
            }};
  }
  static Bytes at(std::int16_t x, std::int16_t y, std::uint8_t buttons = 0) { return test::pidInput(x, y, buttons); }
  std::shared_ptr<Firmware> firmware = std::make_shared<Firmware>();
  Wish wish;
  haptics::DeviceSample sample;
};

TEST_F(PidStick, TwoEffectsAreMadeStartedAndTurnedByTheDescriptor) {
  for (const bool mask : {false, true}) {
    firmware = std::make_shared<Firmware>();
    StickDevice stick = make(mask);
    ASSERT_EQ(firmware->effects.size(), 2u);
    EXPECT_TRUE(firmware->actuators);
    EXPECT_EQ(firmware->gain, 255);
    EXPECT_EQ(firmware->effects[1].axes, 1);
    EXPECT_EQ(firmware->effects[2].axes, 2);
    EXPECT_EQ(firmware->effects[1].direction, 63) << "a quarter of a turn, of which the field has 255 parts: along x";
    EXPECT_EQ(firmware->effects[2].direction, 0) << "along y";
    wish.force = {1, 5, -0.5};  // up is not its business
    ASSERT_EQ(stick.exchange(wish, sample), Exchange::Report);
    EXPECT_EQ(firmware->felt(), (std::pair{0.5, -0.25})) << "of 2 N at full magnitude";
    wish.force = {100, 0, -100};
    stick.exchange(wish, sample);
    EXPECT_EQ(firmware->felt(), (std::pair{1.0, -1.0}));
    stick.close();
    EXPECT_EQ(firmware->felt(), (std::pair{0.0, 0.0}));
    EXPECT_FALSE(firmware->effects[1].started);
    EXPECT_EQ(firmware->violations, 0);
  }
}

TEST_F(PidStick, OnlyAForceThatChangedIsSent) {
  StickDevice stick = make();
  wish.force = {1, 0, 0};
  for (int i = 0; i < 100; ++i) stick.exchange(wish, sample);
  EXPECT_EQ(firmware->magnitudes, 3) << "two at the start, one change";
}

TEST_F(PidStick, PlacesAreSharesOfItsTravelInThePlane) {
  StickDevice stick = make();
  firmware->inputs.push_back(at(0, 0));
  firmware->inputs.push_back(at(32767, -32767, 0b101));
  ASSERT_EQ(stick.exchange(wish, sample), Exchange::Report);
  EXPECT_NEAR(sample.position.x, 0.05, 1e-12);
  EXPECT_NEAR(sample.position.z, -0.05, 1e-12) << "away from the user";
  EXPECT_EQ(sample.position.y, 0);
  EXPECT_EQ(sample.buttons, 0b101u);
}

TEST_F(PidStick, ShortAndForeignReportsChangeNothing) {
  StickDevice stick = make();
  firmware->inputs.push_back(at(16384, 0));
  stick.exchange(wish, sample);
  const Vec3 before = sample.position;
  for (const Bytes& report : {Bytes{1}, Bytes{1, 0}, Bytes{9, 1, 2, 3, 4, 5, 6}, Bytes{}}) {
    firmware->inputs.push_back(report);
    stick.exchange(wish, sample);
    EXPECT_EQ(sample.position, before);
  }
}

TEST_F(PidStick, UnpluggedItIsLostAndComesBackWithNewEffects) {
  StickDevice stick = make();
  wish.force = {1, 0, 0};
  firmware->gone = true;
  EXPECT_EQ(stick.exchange(wish, sample), Exchange::Lost);
  EXPECT_FALSE(stick.reopen());
  firmware = std::make_shared<Firmware>();
  EXPECT_TRUE(stick.reopen());
  EXPECT_EQ(stick.exchange(wish, sample), Exchange::Report);
  EXPECT_EQ(firmware->felt().first, 0.5);
}

TEST_F(PidStick, NoRoomForAnEffectIsSaid) {
  firmware->full = true;
  EXPECT_THROW(make(), ResourceError);
  firmware = std::make_shared<Firmware>();
  firmware->refusesCreate = true;
  EXPECT_THROW(make(), ResourceError);
}

TEST_F(PidStick, WithoutAMeasuredForceItRendersNone) {
  const HidLayout layout = parseReportDescriptor(pidDescriptor());
  StickDevice stick({0.05, 0, false}, "stick", layout, makePidForce(layout), [this] { return std::make_unique<FirmwarePort>(firmware); });
  wish.force = {1, 0, 0};
  EXPECT_EQ(stick.exchange(wish, sample), Exchange::Report);
  EXPECT_TRUE(firmware->effects.empty());
  EXPECT_FALSE(stick.info().rendersForce);
}

TEST_F(PidStick, TellsWhatItIs) {
  StickDevice stick = make();
  const haptics::DeviceInfo info = stick.info();
  EXPECT_EQ(info.name, "stick");
  EXPECT_EQ(info.version, "HID");
  EXPECT_EQ(info.maxForce, 2);
  EXPECT_TRUE(info.rendersForce);
  EXPECT_EQ(info.degreesOfFreedom, 2);
  EXPECT_EQ(info.workspaceRadius, 0.05);
  EXPECT_NEAR(info.resolution, 0.1 / 65534, 1e-18) << "a step of its axis";
  EXPECT_NE(info.secondPath.find("20 ms"), std::string::npos);
}

TEST_F(PidStick, WhatWaitsIsTakenAtOnceUpToSixtyFour) {
  StickDevice stick = make();
  FirmwarePort::waits.clear();
  for (int i = 1; i <= 70; ++i) firmware->inputs.push_back(at(static_cast<std::int16_t>(100 * i), 0));
  ASSERT_EQ(stick.exchange(wish, sample), Exchange::Report);
  EXPECT_NEAR(sample.position.x, 0.05 * 6400 / 32767, 1e-12);
  EXPECT_EQ(firmware->inputs.size(), 6u) << "one that never stops is told its force all the same";
  EXPECT_EQ(FirmwarePort::waits.size(), 64u);
  EXPECT_EQ(FirmwarePort::waits[0], 1);
  EXPECT_EQ(FirmwarePort::waits[1], 0);
  stick.exchange(wish, sample);
  EXPECT_NEAR(sample.position.x, 0.05 * 7000 / 32767, 1e-12);
}

TEST_F(PidStick, TwentyReportsInARowThatAreNoneOfItsOwnAreALoss) {
  StickDevice stick = make();
  const auto garbage = [&](int count) { firmware->inputs.insert(firmware->inputs.end(), static_cast<std::size_t>(count), Bytes{9, 9}); };
  garbage(19);
  EXPECT_EQ(stick.exchange(wish, sample), Exchange::Report);
  firmware->inputs.push_back(at(5, 5));
  garbage(19);
  EXPECT_EQ(stick.exchange(wish, sample), Exchange::Report) << "one of its own begins the count anew";
  garbage(1);
  EXPECT_EQ(stick.exchange(wish, sample), Exchange::Lost);
  firmware->inputs.clear();
  EXPECT_TRUE(stick.reopen());
  garbage(19);
  EXPECT_EQ(stick.exchange(wish, sample), Exchange::Report) << "and so does opening it again";
}

TEST_F(PidStick, ZeroIsToldToOneThatRendersForce) {
  StickDevice stick = make();
  wish.force = {2, 0, 2};
  stick.exchange(wish, sample);
  EXPECT_TRUE(stick.tellZero());
  EXPECT_EQ(firmware->felt(), (std::pair{0.0, 0.0}));
  stick.exchange(wish, sample);
  firmware->gone = true;
  EXPECT_FALSE(stick.tellZero());
  EXPECT_FALSE(stick.reopen());
  firmware->gone = false;
  EXPECT_TRUE(stick.tellZero()) << "by the old connection";
  stick.close();
  EXPECT_TRUE(stick.tellZero());
  EXPECT_EQ(stick.exchange(wish, sample), Exchange::Lost) << "closed";
}

TEST_F(PidStick, AForceThatCannotBeToldIsALoss) {
  StickDevice stick = make();
  wish.force = {1, 0, 0};
  firmware->inputs.clear();
  struct Deaf final : HidPort {
    int read(std::span<std::uint8_t>, int) noexcept override { return 0; }
    bool write(std::span<const std::uint8_t>) noexcept override { return false; }
  };
  const HidLayout layout = parseReportDescriptor(pidDescriptor());
  const auto deaf = [] { return std::make_unique<Deaf>(); };
  StickDevice quiet({0.05, 0, false}, "stick", layout, makePidForce(layout), deaf);
  EXPECT_EQ(quiet.exchange(wish, sample), Exchange::Report) << "none is told to it";
  EXPECT_TRUE(quiet.tellZero());
  try {
    StickDevice loud({0.05, 2, false}, "stick", layout, makePidForce(layout), deaf);
    FAIL();
  } catch (const ResourceError& error) {
    EXPECT_STREQ(error.what(), "stick: it makes no new effect (Create New Effect is refused)");
  }
}

TEST_F(PidStick, OneThatCountsTheOtherWayIsToldTheOpposite) {
  const HidLayout layout = parseReportDescriptor(pidDescriptor());
  StickDevice stick({0.05, 2.0, true}, "stick", layout, makePidForce(layout), [this] { return std::make_unique<FirmwarePort>(firmware); });
  wish.force = {1, 0, -0.5};
  stick.exchange(wish, sample);
  EXPECT_EQ(firmware->felt(), (std::pair{-0.5, 0.25}));
}

// Axes of another range each, and a button of another page between those of the ninth: page 9 counts from 1, and 32 are kept.
class OddStick : public ::testing::Test {
 protected:
  static Bytes descriptorOf(const Bytes& axes) {
    Bytes d{0x05, 0x01, 0x09, 0x04, 0xA1, 0x01};
    d.insert(d.end(), axes.begin(), axes.end());
    d.push_back(0xC0);
    return d;
  }
  static StickDevice make(const Bytes& axes, const std::shared_ptr<Firmware>& firmware) {
    return {{0.1, 0, false}, "odd", parseReportDescriptor(descriptorOf(axes)), makeWheelForce(), [firmware] {
              return std::make_unique<FirmwarePort>(firmware);
            }};
  }
  std::shared_ptr<Firmware> firmware = std::make_shared<Firmware>();
  Wish wish;
  haptics::DeviceSample sample;
};

TEST_F(OddStick, EachAxisHasItsOwnMiddle) {
  StickDevice stick =
      make({0x15, 0x00, 0x75, 0x10, 0x95, 0x01, 0x26, 0xFF, 0x03, 0x09, 0x30, 0x81, 0x02, 0x15, 0x9C, 0x25, 0x32, 0x09, 0x31, 0x81, 0x02},
           firmware);  // X: 0 to 1023, Y: -100 to 50
  EXPECT_NEAR(stick.info().resolution, 0.2 / 1023, 1e-15);
  const auto placeOf = [&](int x, int y) {
    firmware->inputs.push_back({static_cast<std::uint8_t>(x & 0xFF), static_cast<std::uint8_t>(x >> 8), static_cast<std::uint8_t>(y & 0xFF),
                                static_cast<std::uint8_t>(y >> 8 & 0xFF)});
    EXPECT_EQ(stick.exchange(wish, sample), Exchange::Report);
    return sample.position;
  };
  EXPECT_LT(norm(placeOf(1023, 50) - Vec3{0.1, 0, 0.1}), 1e-15);
  EXPECT_LT(norm(placeOf(0, -100) - Vec3{-0.1, 0, -0.1}), 1e-15);
  EXPECT_LT(norm(placeOf(767, -10) - Vec3{0.1 * 255.5 / 511.5, 0, 0.1 * 15 / 75.0}), 1e-15);
  EXPECT_LT(norm(placeOf(2000, -300) - Vec3{0.1, 0, -0.1}), 1e-15) << "no further than its end";
}

TEST_F(OddStick, AWheelsSteeringIsItsOnlyAxis) {
  StickDevice stick = make({0x05, 0x02, 0x15, 0x9C, 0x25, 0x64, 0x75, 0x08, 0x95, 0x01, 0x09, 0xC8, 0x81, 0x02}, firmware);
  firmware->inputs.push_back({50});
  ASSERT_EQ(stick.exchange(wish, sample), Exchange::Report);
  EXPECT_NEAR(sample.position.x, 0.05, 1e-15);
  EXPECT_EQ(sample.position.z, 0);
}

TEST_F(OddStick, WithoutAnAxisItIsRefused) {
  const auto refusalOf = [&](const Bytes& axes) {
    try {
      make(axes, firmware);
      return std::string("made");
    } catch (const FaultError& error) {
      return error.faults.at(0).key + ": " + error.faults.at(0).what;
    }
  };
  const std::string none = "device: odd: its report descriptor has no axis X";
  EXPECT_EQ(refusalOf({0x15, 0x00, 0x25, 0x01, 0x75, 0x08, 0x95, 0x01, 0x09, 0x31, 0x81, 0x02}), none) << "Y alone";
  EXPECT_EQ(refusalOf({0x15, 0x05, 0x25, 0x05, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02}), none) << "without a range";
  EXPECT_EQ(refusalOf({0x15, 0x05, 0x25, 0x06, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x81, 0x00}), none) << "an array";
  EXPECT_EQ(refusalOf({0x15, 0x05, 0x25, 0x06, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x91, 0x02}), none) << "an output";
  EXPECT_EQ(refusalOf({0x15, 0x05, 0x25, 0x06, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02}), "made");
}

TEST_F(OddStick, ItsFirstThirtyTwoButtonsAreKept) {
  // X of 8 bits, buttons 0 to 39, and eight bits of another page.
  StickDevice stick =
      make({0x15, 0x9C, 0x25, 0x64, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02, 0x05, 0x09, 0x19, 0x00, 0x29, 0x27, 0x15,
            0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x28, 0x81, 0x02, 0x05, 0x0C, 0x19, 0x01, 0x29, 0x08, 0x95, 0x08, 0x81, 0x02},
           firmware);
  const auto buttons = [&](const Bytes& bits) {
    Bytes report{0};
    report.insert(report.end(), bits.begin(), bits.end());
    firmware->inputs.push_back(report);
    stick.exchange(wish, sample);
    return sample.buttons;
  };
  EXPECT_EQ(buttons({0x02, 0, 0, 0, 0, 0}), 1u) << "number 1";
  EXPECT_EQ(buttons({0x01, 0, 0, 0, 0, 0}), 0u) << "0 is none";
  EXPECT_EQ(buttons({0, 0, 0, 0, 0x01, 0}), 1u << 31) << "number 32";
  EXPECT_EQ(buttons({0, 0, 0, 0, 0x02, 0}), 0u) << "number 33";
  EXPECT_EQ(buttons({0x10, 0x01, 0, 0, 0, 0xFF}), (1u << 3) | (1u << 7)) << "numbers 4 and 8, and nothing of the other page";
}

// What Logitech's own reports look like, byte for byte as the kernel's drivers send them.
struct Sent final : HidPort {
  std::vector<Bytes> sent;
  int read(std::span<std::uint8_t>, int) noexcept override { return 0; }
  bool write(std::span<const std::uint8_t> bytes) noexcept override {
    sent.emplace_back(bytes.begin(), bytes.end());
    return true;
  }
};

TEST(LogitechForce, TheG940GetsBothAxesNegated) {
  Sent port;
  const auto force = makeG940Force();
  ASSERT_EQ(force->start(port), "");
  ASSERT_TRUE(force->tell(port, 1, -0.5));
  const Bytes& report = port.sent.back();
  ASSERT_EQ(report.size(), 64u);
  EXPECT_EQ(report[1], 0x51);
  EXPECT_EQ(static_cast<std::int8_t>(report[2]), -127);
  EXPECT_EQ(static_cast<std::int8_t>(report[32]), 64);
  for (const std::size_t at : {3, 4, 5, 33, 34, 35}) EXPECT_EQ(report[at], 0);
}

TEST(LogitechForce, AWheelGetsOneByteAboutItsMiddle) {
  Sent port;
  const auto force = makeWheelForce();
  force->tell(port, 0, 0);
  EXPECT_EQ(port.sent.back(), (Bytes{0, 0x11, 0x08, 0x80, 0x80, 0, 0, 0}));
  force->tell(port, 1, 0);
  EXPECT_EQ(port.sent.back()[3], 0xFF);
  force->tell(port, -1, 0);
  EXPECT_EQ(port.sent.back()[3], 0x01);
  force->stop(port);
  EXPECT_EQ(port.sent.back()[1], 0x13);
}

TEST(ReportDescriptor, RangesAndNumbersAreThoseOfTheBytes) {
  const HidLayout layout = parseReportDescriptor(pidDescriptor());
  const HidField* x = layout.find(HidReportKind::Input, hidUsage(1, 0x30));
  ASSERT_NE(x, nullptr);
  EXPECT_EQ(x->report, 1);
  EXPECT_EQ(x->least, -32767);
  EXPECT_EQ(x->most, 32767);
  EXPECT_EQ(layout.bytesOf(HidReportKind::Output, 1), 13u);
  EXPECT_EQ(layout.bytesOf(HidReportKind::Output, 5), 3u);
}

// Page 1, usage X: as many bits as are told, between -1 and 1.
TEST(ReportDescriptor, AFieldOfMoreBitsThanANumberHasIsPassedOver) {
  for (const int bits : {1, 16, 32, 33, 64}) {
    const Bytes one{0x05, 0x01, 0x09, 0x30, 0x15, 0xff, 0x25, 0x01, 0x75, static_cast<std::uint8_t>(bits), 0x95, 0x01, 0x81, 0x02};
    const HidLayout layout = parseReportDescriptor(one);
    EXPECT_EQ(layout.find(HidReportKind::Input, hidUsage(1, 0x30)) != nullptr, bits <= 32) << bits;
    EXPECT_EQ(layout.bytesOf(HidReportKind::Input, 0), static_cast<unsigned>((bits + 7) / 8)) << bits << ": its place is kept";
  }
}

TEST(ReportDescriptor, ABrokenOneIsRefusedAndNoneIsFatal) {
  const Bytes whole = pidDescriptor();
  std::mt19937_64 random(7);
  for (int i = 0; i < 20'000; ++i) {
    Bytes broken = whole;
    for (int k = static_cast<int>(random() % 8); k >= 0; --k) broken[random() % broken.size()] = static_cast<std::uint8_t>(random());
    if (i % 3 == 0) broken.resize(random() % broken.size());
    try {
      const HidLayout layout = parseReportDescriptor(broken);
      for (const HidField& field : layout.fields) {
        Bytes report(64, 0);
        writeField(field, 1, report);
        readField(layout, field, report);
      }
      makePidForce(layout);
    } catch (const FaultError&) {  // said in words
    }
  }
}

}  // namespace
}  // namespace reachlab::devices
