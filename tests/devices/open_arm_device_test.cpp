#include "devices/hid/open_arm_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "base/error.h"
#include "tests/devices/arm_poses.h"
#include "tests/devices/fakes/fake_message_line.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

using Report = std::vector<std::uint8_t>;

// What a port is asked to give, and what it was sent.
struct Line {
  std::deque<Report> waiting;
  std::vector<Report> sent;
  bool gone = false, refuses = false;
  std::vector<std::pair<std::size_t, int>> readings;  // room [bytes] and wait [ms]
};
class FakePort final : public HidPort {
 public:
  explicit FakePort(std::shared_ptr<Line> line) : line_(std::move(line)) {}
  int read(std::span<std::uint8_t> bytes, int milliseconds) noexcept override {
    line_->readings.emplace_back(bytes.size(), milliseconds);
    if (line_->gone) return -1;
    if (line_->waiting.empty()) return 0;
    const Report report = line_->waiting.front();
    line_->waiting.pop_front();
    std::copy_n(report.begin(), std::min(report.size(), bytes.size()), bytes.begin());
    return static_cast<int>(report.size());
  }
  bool write(std::span<const std::uint8_t> bytes) noexcept override {
    if (line_->refuses) return false;
    line_->sent.emplace_back(bytes.begin(), bytes.end());
    return true;
  }

 private:
  std::shared_ptr<Line> line_;
};

class OpenArmOverAPort : public ::testing::Test {
 protected:
  OpenArmOverAPort() {
    options.model = findArmModel("woodenhaptics_v2015");
    open();
  }
  void open(const std::string& serial = "1") {
    arm = std::make_unique<OpenArm>(options, serial, [this]() -> std::unique_ptr<HidPort> {
      if (line->gone) throw ResourceError("gone");
      return std::make_unique<FakePort>(line);
    });
  }
  static Report reportAt(const std::array<double, 3>& counts, std::int16_t info = 0) {
    Report report(64, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto raw = static_cast<std::uint16_t>(static_cast<std::int64_t>(std::llround(counts[i])));
      report[2 * i] = static_cast<std::uint8_t>(raw & 0xFF);
      report[2 * i + 1] = static_cast<std::uint8_t>(raw >> 8);
    }
    report[12] = static_cast<std::uint8_t>(info);
    return report;
  }
  Report reportOf(const Vec3& inArm) const { return reportAt(encoderCounts(*options.model, anglesAt(*options.model, inArm))); }
  static std::int16_t field(const Report& report, std::size_t at) { return static_cast<std::int16_t>(report[at] | report[at + 1] << 8); }

  OpenArm::Options options;
  std::shared_ptr<Line> line = std::make_shared<Line>();
  std::unique_ptr<OpenArm> arm;
  test::StandingForce wish;
  haptics::DeviceSample sample;
};

TEST_F(OpenArmOverAPort, GivesThePlaceInTheWorldsAxesToACount) {
  const Vec3 inArm{0.02, -0.03, 0.04};
  line->waiting.push_back(reportOf(inArm));
  ASSERT_EQ(arm->exchange(wish, sample), Exchange::Report);
  EXPECT_LT(norm(sample.position - Vec3{-0.03, 0.04, 0.02}), 2e-4) << "a count on every axis is 0.1 mm";
}

TEST_F(OpenArmOverAPort, AnswersEveryReportOnceWithTheForcesCurrents) {
  line->waiting.push_back(reportOf({}));
  wish.force = {1, 0, 0};  // the arm's y: to the right
  arm->exchange(wish, sample);
  ASSERT_EQ(line->sent.size(), 1u);
  EXPECT_EQ(line->sent[0].size(), 65u);
  EXPECT_EQ(field(line->sent[0], 7), 0);
  // tau_A = cos(thA) R F = 0.22 N m at the origin; through 16:1 and 0.0259 Nm/A: 531 mA.
  EXPECT_NEAR(field(line->sent[0], 1), 531, 2);
  EXPECT_EQ(field(line->sent[0], 3), 0);
}

TEST_F(OpenArmOverAPort, ALostReportIsAskedForAgainWithoutForce) {
  wish.force = {1, 1, 1};
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Nothing);
  ASSERT_EQ(line->sent.size(), 1u);
  for (const std::uint8_t byte : line->sent[0]) EXPECT_EQ(byte, 0);
}

TEST_F(OpenArmOverAPort, WhatIsNotAWholeReportIsNotBelieved) {
  line->waiting.push_back(Report(10, 0x7F));
  line->waiting.push_back(Report(63, 0x7F));
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Nothing);
}

TEST_F(OpenArmOverAPort, CountsGoOnPastTheEndOfSixteenBits) {
  const auto placeAt = [&](double counts) {
    line->waiting.push_back(reportAt(std::array<double, 3>{counts, 3000, 6000}));
    EXPECT_EQ(arm->exchange(wish, sample), Exchange::Report);
    return sample.position;
  };
  Vec3 last = placeAt(32'000);
  for (double counts = 32'050; counts < 34'000; counts += 50) {
    const Vec3 place = placeAt(counts);
    ASSERT_LT(norm(place - last), 0.006) << counts;
    last = place;
  }
}

TEST_F(OpenArmOverAPort, TheCalibrationButtonSetsTheEncoders) {
  line->waiting.push_back(reportAt(std::array<double, 3>{11, 22, 33}, 1));
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Nothing);
  ASSERT_EQ(line->sent.size(), 1u);
  EXPECT_EQ(field(line->sent[0], 7), 1);
  EXPECT_EQ(field(line->sent[0], 13), 6000);
  line->waiting.push_back(reportAt(std::array<double, 3>{0, 0, 6000}));
  ASSERT_EQ(arm->exchange(wish, sample), Exchange::Report);
  EXPECT_LT(norm(sample.position - Vec3{0, 0.205, 0.025}), 1e-12) << "the published home";
}

TEST_F(OpenArmOverAPort, AGoneDeviceIsLostAndComesBack) {
  line->gone = true;
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Lost);
  EXPECT_THROW(arm->reopen(), ResourceError);
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Lost);
  line->gone = false;
  EXPECT_TRUE(arm->reopen());
  line->waiting.push_back(reportOf({}));
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Report);
  line->refuses = true;
  line->waiting.push_back(reportOf({}));
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Lost) << "a force that cannot be told is a loss";
}

TEST_F(OpenArmOverAPort, TheLastWordIsZero) {
  wish.force = {2, 0, 0};
  line->waiting.push_back(reportOf({}));
  arm->exchange(wish, sample);
  arm->close();
  for (const std::uint8_t byte : line->sent.back()) EXPECT_EQ(byte, 0);
}

TEST_F(OpenArmOverAPort, WaitsForItsTurnOnceAndTakesWhatHasPiledUpWithoutWaiting) {
  line->waiting = {reportOf({}), reportOf({})};
  arm->exchange(wish, sample);
  EXPECT_EQ(line->readings, (std::vector<std::pair<std::size_t, int>>{{64, 10}, {64, 0}, {64, 0}}));
  line->readings.clear();
  line->waiting = {Report(3, 0), reportOf({})};
  arm->exchange(wish, sample);
  EXPECT_EQ(line->readings[1].second, 10) << "garbage is not its turn";
}

TEST_F(OpenArmOverAPort, OneThatNeverStopsSendingIsAnsweredAfterSixtyFour) {
  for (int i = 0; i < 70; ++i) line->waiting.push_back(reportOf({0.0005 * i, 0, 0}));
  ASSERT_EQ(arm->exchange(wish, sample), Exchange::Report);
  EXPECT_EQ(line->waiting.size(), 6u);
  EXPECT_NEAR(sample.position.z, 0.0005 * 63, 2e-4);
}

TEST_F(OpenArmOverAPort, ItsButtonIsTheFirst) {
  Report pressed = reportAt({0, 0, 6000});
  pressed[6] = 0x10, pressed[7] = 0x27;  // 10000 in encoder d
  line->waiting.push_back(pressed);
  arm->exchange(wish, sample);
  EXPECT_EQ(sample.buttons, 1u);
  EXPECT_FALSE(sample.hasVelocity);
  line->waiting.push_back(reportAt({0, 0, 6000}));
  arm->exchange(wish, sample);
  EXPECT_EQ(sample.buttons, 0u);
}

TEST_F(OpenArmOverAPort, AtItsStartItIsCalibratedOnlyWhereItIsAskedFor) {
  EXPECT_TRUE(line->sent.empty());
  options.calibrateAtStart = true;
  open();
  ASSERT_EQ(line->sent.size(), 1u);
  EXPECT_EQ(field(line->sent[0], 7), 1);
  EXPECT_EQ(field(line->sent[0], 13), 6000);
}

TEST_F(OpenArmOverAPort, OlderFirmwaresHaveReportsOfFourteenBytes) {
  options.commandBytes = 15, options.reportBytes = 14;
  open();
  Report report = reportAt({0, 0, 6000});
  report.resize(14);
  line->waiting.push_back(report);
  ASSERT_EQ(arm->exchange(wish, sample), Exchange::Report);
  EXPECT_LT(norm(sample.position - Vec3{0, 0.205, 0.025}), 1e-12);
  EXPECT_EQ(line->sent.at(0).size(), 15u);
  EXPECT_EQ(line->readings.at(0).first, 14u);
  options.commandBytes = options.reportBytes = 1000;
  open();
  line->waiting.push_back(Report(64, 0));
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Report) << "no more than a report of USB has";
  EXPECT_EQ(line->sent.back().size(), 65u);
}

TEST_F(OpenArmOverAPort, AfterTheCalibrationAndAfterAnUnpluggingItsCountsBeginAnew) {
  const auto place = [&](double counts) {
    line->waiting.push_back(reportAt({counts, 0, 6000}));
    EXPECT_EQ(arm->exchange(wish, sample), Exchange::Report);
    return sample.position;
  };
  const Vec3 fresh = place(30'000);
  const auto goOnPastTheEnd = [&] {
    ASSERT_TRUE(arm->reopen());
    place(-30'000);
    EXPECT_GT(norm(place(30'000) - fresh), 1e-3) << "the shorter way there is on to the left";
  };
  goOnPastTheEnd();
  EXPECT_EQ(arm->calibrate(), "");
  EXPECT_LT(norm(place(30'000) - fresh), 1e-12);
  goOnPastTheEnd();
  ASSERT_TRUE(arm->reopen());
  EXPECT_LT(norm(place(30'000) - fresh), 1e-12);
}

TEST_F(OpenArmOverAPort, SaysHowItIsCalibratedAndWhyItIsNot) {
  options.model = findArmModel("polhem_v1");
  open();
  EXPECT_EQ(arm->calibrationHint(), "hold the arm in its calibration pose (encoders 0, 0, -5000)");
  line->refuses = true;
  EXPECT_EQ(arm->calibrate(), "it does not take the calibration");
  line->waiting.push_back(reportAt({0, 0, 0}, 1));
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Lost) << "its own button";
  arm->close();
  EXPECT_EQ(arm->calibrate(), "it is not connected");
}

TEST_F(OpenArmOverAPort, ZeroIsToldWithoutBeingAskedFor) {
  EXPECT_TRUE(arm->tellZero());
  ASSERT_EQ(line->sent.size(), 1u);
  EXPECT_EQ(line->sent[0], Report(65, 0));
  line->refuses = true;
  EXPECT_FALSE(arm->tellZero());
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Lost) << "nothing was read, and nothing can be told";
  arm->close();
  EXPECT_TRUE(arm->tellZero()) << "there is nobody to tell";
}

TEST_F(OpenArmOverAPort, ReportsOfAnOldFirmwareAreNotBelievedAndSaidToBeOld) {
  line->waiting.push_back(Report(8, 1));
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Nothing);
  EXPECT_TRUE(holds(arm->lossText(), "too old: it sends reports of 8 bytes, and 14 are needed"));
  line->waiting.push_back(reportAt({0, 0, 6000}));
  EXPECT_EQ(arm->exchange(wish, sample), Exchange::Report);
  EXPECT_EQ(arm->lossText(), "") << "a short one among whole ones is a fault of the line";
}

}  // namespace
}  // namespace reachlab::devices
