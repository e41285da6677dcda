#include "devices/hid/stick_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "base/error.h"
#include "base/fault.h"

namespace reachlab::devices {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A joystick of HID PID, as open firmwares (JoyFFB, OpenFFBoard) describe themselves: X and Y of 16 bits and 8 buttons in report 1, then the
// reports of an effect. `maskControl`: Device Control as bits instead of a list.
Bytes pidDescriptor(bool maskControl = false) {
  Bytes d{0x05, 0x01, 0x09, 0x04, 0xA1, 0x01,                                                                    // joystick
          0x85, 0x01, 0x09, 0x30, 0x09, 0x31, 0x16, 0x01, 0x80, 0x26, 0xFF, 0x7F,                                // X, Y: -32767 … 32767
          0x75, 0x10, 0x95, 0x02, 0x81, 0x02,                                                                    //
          0x05, 0x09, 0x19, 0x01, 0x29, 0x08, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x08, 0x81, 0x02,        // eight buttons
          0x05, 0x0F,                                                                                            // physical interface
          0x09, 0x21, 0xA1, 0x02, 0x85, 0x01,                                                                    // Set Effect
          0x09, 0x22, 0x15, 0x01, 0x25, 0x28, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02,                                //   block index
          0x09, 0x25, 0xA1, 0x02, 0x09, 0x26, 0x09, 0x27, 0x15, 0x01, 0x25, 0x02, 0x91, 0x00, 0xC0,              //   type
          0x09, 0x50, 0x09, 0x54, 0x09, 0x51, 0x15, 0x00, 0x26, 0xFF, 0x7F, 0x75, 0x10, 0x95, 0x03, 0x91, 0x02,  // durations
          0x09, 0x52, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02,                                      //   gain
          0x09, 0x53, 0x15, 0x01, 0x26, 0xFF, 0x00, 0x91, 0x02,                                                  //   trigger button
          0x09, 0x55, 0xA1, 0x02, 0x05, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95,
          0x02, 0x91, 0x02, 0xC0, 0x05, 0x0F, 0x09, 0x56, 0x95, 0x01, 0x91, 0x02, 0x95, 0x05, 0x91, 0x03,  //   direction enable, padding
          0x09, 0x57, 0xA1, 0x02, 0x05, 0x0A, 0x09, 0x01, 0x09, 0x02, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x02,
          0x91, 0x02, 0xC0, 0x05, 0x0F, 0xC0,  //
          0x09, 0x73, 0xA1, 0x02, 0x85, 0x05, 0x09, 0x22, 0x15, 0x01, 0x25, 0x28, 0x75, 0x08, 0x95, 0x01, 0x91,
          0x02, 0x09, 0x70, 0x16, 0xF0, 0xD8, 0x26, 0x10, 0x27, 0x75, 0x10, 0x91, 0x02, 0xC0,  // Set Constant Force: -10000 … 10000
          0x09, 0x77, 0xA1, 0x02, 0x85, 0x0A, 0x09, 0x22, 0x15, 0x01, 0x25, 0x28, 0x75, 0x08, 0x91, 0x02, 0x09,
          0x78, 0xA1, 0x02, 0x09, 0x79, 0x09, 0x7A, 0x09, 0x7B, 0x15, 0x01, 0x25, 0x03, 0x91, 0x00, 0xC0, 0x09,
          0x7C, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x91, 0x02, 0xC0};  // Effect Operation
  const Bytes list{0x09, 0x96, 0xA1, 0x02, 0x85, 0x0C, 0x09, 0x97, 0x09, 0x98, 0x09, 0x99, 0x09,
                   0x9A, 0x15, 0x01, 0x25, 0x04, 0x75, 0x08, 0x95, 0x01, 0x91, 0x00, 0xC0};
  const Bytes mask{0x09, 0x96, 0xA1, 0x02, 0x85, 0x0C, 0x09, 0x97, 0x09, 0x98, 0x09, 0x99, 0x09, 0x9A, 0x15,
                   0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x04, 0x91, 0x02, 0x95, 0x04, 0x91, 0x03, 0xC0};
  const Bytes& control = maskControl ? mask : list;
  d.insert(d.end(), control.begin(), control.end());
  const Bytes rest{0x09, 0x7D, 0xA1, 0x02, 0x85, 0x0D, 0x09, 0x7E, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02,
                   0xC0, 0x09, 0xAB, 0xA1, 0x02, 0x85, 0x01, 0x09, 0x25, 0xA1, 0x02, 0x09, 0x26, 0x09, 0x27, 0x15, 0x01, 0x25, 0x02,
                   0xB1, 0x00, 0xC0, 0x05, 0x01, 0x09, 0x3B, 0x15, 0x00, 0x26, 0xFF, 0x01, 0x75, 0x10, 0xB1, 0x02, 0xC0, 0x05, 0x0F,
                   0x09, 0x89, 0xA1, 0x02, 0x85, 0x02, 0x09, 0x22, 0x15, 0x01, 0x25, 0x28, 0x75, 0x08, 0xB1, 0x02, 0x09, 0x8B, 0xA1,
                   0x02, 0x09, 0x8C, 0x09, 0x8D, 0x09, 0x8E, 0x15, 0x01, 0x25, 0x03, 0xB1, 0x00, 0xC0, 0xC0, 0xC0};
  d.insert(d.end(), rest.begin(), rest.end());
  return d;
}

/// What a firmware of HID PID does with these reports; counts what breaks its rules.
struct Firmware {
  struct Effect {
    bool started = false;
    int axes = 0, direction = -1, magnitude = 0;
  };
  bool actuators = false, full = false, refusesCreate = false, gone = false, mask = false;
  int gain = 0, violations = 0, waiting = 0, next = 1, magnitudes = 0;
  std::map<int, Effect> effects;
  std::vector<Bytes> inputs;

  bool write(const Bytes& r) {
    if (gone) return false;
    switch (r[0]) {
      case 0x0C:
        if (r[1] == 1) actuators = true;
        else if (r[1] == (mask ? 4 : 3))
          for (auto& [index, effect] : effects) effect.started = false;
        else ++violations;
        break;
      case 0x0D: gain = r[1]; break;
      case 0x01: {
        if (r.size() != 14 || !effects.contains(r[1]) || r[2] != 1) ++violations;
        effects[r[1]].axes = r[11] & 3;
        effects[r[1]].direction = r[12];
        if ((r[11] & 4) == 0 || (r[3] | r[4] << 8) != 0x7FFF || r[9] != 255) ++violations;
        break;
      }
      case 0x05:
        if (r.size() != 4 || !effects.contains(r[1])) ++violations;
        effects[r[1]].magnitude = static_cast<std::int16_t>(r[2] | r[3] << 8);
        ++magnitudes;
        break;
      case 0x0A:
        if (r.size() != 4 || !effects.contains(r[1])) ++violations;
        effects[r[1]].started = r[2] == 1;
        break;
      default: ++violations;
    }
    return true;
  }
  // [shares] x, y as a motor would feel it: only with actuators on, and effects that run.
  std::pair<double, double> felt() const {
    double x = 0, y = 0;
    for (const auto& [index, effect] : effects)
      if (actuators && effect.started) (effect.axes == 1 ? x : y) += effect.magnitude / 10000.0;
    return {x, y};
  }
};

class FirmwarePort final : public HidPort {
 public:
  explicit FirmwarePort(std::shared_ptr<Firmware> firmware) : firmware_(std::move(firmware)) {}
  int read(std::span<std::uint8_t> bytes, int) noexcept override {
    if (firmware_->gone) return -1;
    if (firmware_->inputs.empty()) return 0;
    const Bytes report = firmware_->inputs.front();
    firmware_->inputs.erase(firmware_->inputs.begin());
    std::copy(report.begin(), report.end(), bytes.begin());
    return static_cast<int>(report.size());
  }
  bool write(std::span<const std::uint8_t> bytes) noexcept override { return firmware_->write({bytes.begin(), bytes.end()}); }
  bool sendFeature(std::span<const std::uint8_t> bytes) noexcept override {
    if (firmware_->refusesCreate || bytes[0] != 1 || bytes[1] != 1) return false;
    firmware_->waiting = firmware_->next++;
    if (!firmware_->full) firmware_->effects[firmware_->waiting] = {};
    return true;
  }
  int getFeature(std::span<std::uint8_t> bytes) noexcept override {
    if (bytes[0] != 2 || firmware_->waiting == 0) return -1;
    bytes[1] = static_cast<std::uint8_t>(firmware_->waiting);
    bytes[2] = firmware_->full ? 2 : 1;
    return 3;
  }

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
  static Bytes at(std::int16_t x, std::int16_t y, std::uint8_t buttons = 0) {
    const auto low = [](std::int16_t v) { return static_cast<std::uint8_t>(v & 0xFF); };
    const auto high = [](std::int16_t v) { return static_cast<std::uint8_t>(v >> 8 & 0xFF); };
    return {1, low(x), high(x), low(y), high(y), buttons};
  }
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
    EXPECT_NE(firmware->effects[1].direction, firmware->effects[2].direction);
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
