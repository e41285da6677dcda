#include "devices/hid/open_arm_device.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/devices/arm_poses.h"
#include "tests/devices/fakes/fake_hidapi.h"
#include "tests/devices/fakes/fake_message_line.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

using Report = std::vector<std::uint8_t>;

class OpenArmOverAPort : public ::testing::Test {
 protected:
  OpenArmOverAPort() {
    options.model = findArmModel("woodenhaptics_v2015");
    open();
  }
  ~OpenArmOverAPort() override {
    arm.reset();
    test::resetFakeHids();
  }
  void open() {
    arm = std::make_unique<OpenArm>(options, "1", [this] { return std::make_unique<HidPort>(HidInterface{.path = hid.path}); });
  }
  static Report reportAt(const std::array<double, 3>& counts, std::uint8_t info = 0) {
    Report report = armReport(counts);
    report[12] = info;
    return report;
  }
  Report reportOf(const Vec3& inArm) const { return reportAt(encoderCounts(*options.model, anglesAt(*options.model, inArm))); }
  // A turn with nothing to read, or with this report behind those that wait.
  Exchange turn() { return arm->exchange(wish, sample); }
  Exchange turn(const Report& report) {
    hid.reports.push_back(report);
    return turn();
  }

  OpenArm::Options options;
  test::FakeHid& hid = test::resetToOneFakeHid();
  std::unique_ptr<OpenArm> arm;
  test::StandingForce wish;
  haptics::DeviceSample sample;
};

TEST_F(OpenArmOverAPort, GivesThePlaceInTheWorldsAxesToACount) {
  const Vec3 inArm{0.02, -0.03, 0.04};
  ASSERT_EQ(turn(reportOf(inArm)), Exchange::Report);
  EXPECT_LT(norm(sample.position - Vec3{-0.03, 0.04, 0.02}), 2e-4) << "a count on every axis is 0.1 mm";
}

TEST_F(OpenArmOverAPort, AnswersEveryReportOnceWithTheForcesCurrents) {
  wish.force = {1, 0, 0};  // the arm's y: to the right
  turn(reportOf({}));
  ASSERT_EQ(hid.written.size(), 1u);
  EXPECT_EQ(hid.written[0].size(), 65u);
  EXPECT_EQ(fieldOf(hid.written[0], 7), 0);
  // tau_A = cos(thA) R F = 0.22 N m at the origin; through 16:1 and 0.0259 Nm/A: 531 mA.
  EXPECT_NEAR(fieldOf(hid.written[0], 1), 531, 2);
  EXPECT_EQ(fieldOf(hid.written[0], 3), 0);
}

TEST_F(OpenArmOverAPort, ALostReportIsAskedForAgainWithoutForce) {
  wish.force = {1, 1, 1};
  EXPECT_EQ(turn(), Exchange::Nothing);
  ASSERT_EQ(hid.written.size(), 1u);
  for (const std::uint8_t byte : hid.written[0]) EXPECT_EQ(byte, 0);
}

TEST_F(OpenArmOverAPort, WhatIsNotAWholeReportIsNotBelieved) {
  hid.reports.push_back(Report(10, 0x7F));
  EXPECT_EQ(turn(Report(63, 0x7F)), Exchange::Nothing);
}

TEST_F(OpenArmOverAPort, CountsGoOnPastTheEndOfSixteenBits) {
  const auto placeAt = [&](double counts) {
    EXPECT_EQ(turn(reportAt({counts, 3000, 6000})), Exchange::Report);
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
  EXPECT_EQ(turn(reportAt({11, 22, 33}, 1)), Exchange::Nothing);
  ASSERT_EQ(hid.written.size(), 1u);
  EXPECT_EQ(fieldOf(hid.written[0], 7), 1);
  EXPECT_EQ(fieldOf(hid.written[0], 13), 6000);
  ASSERT_EQ(turn(reportAt({0, 0, 6000})), Exchange::Report);
  EXPECT_LT(norm(sample.position - Vec3{0, 0.205, 0.025}), 1e-12) << "the published home";
}

TEST_F(OpenArmOverAPort, AGoneDeviceIsLostAndComesBack) {
  hid.gone = true;
  EXPECT_EQ(turn(), Exchange::Lost);
  EXPECT_THROW(arm->reopen(), ResourceError);
  EXPECT_EQ(turn(), Exchange::Lost);
  hid.gone = false;
  EXPECT_TRUE(arm->reopen());
  EXPECT_EQ(turn(reportOf({})), Exchange::Report);
  hid.deaf = true;
  EXPECT_EQ(turn(reportOf({})), Exchange::Lost) << "a force that cannot be told is a loss";
}

TEST_F(OpenArmOverAPort, TheLastWordIsZero) {
  wish.force = {2, 0, 0};
  turn(reportOf({}));
  arm->close();
  for (const std::uint8_t byte : hid.written.back()) EXPECT_EQ(byte, 0);
}

TEST_F(OpenArmOverAPort, WaitsForItsTurnOnceAndTakesWhatHasPiledUpWithoutWaiting) {
  hid.reports = {reportOf({}), reportOf({})};
  turn();
  EXPECT_EQ(hid.waits, (std::vector<int>{10, 0, 0}));
  EXPECT_EQ(hid.room, 64u);
  hid.waits.clear();
  hid.reports = {Report(3, 0), reportOf({})};
  turn();
  EXPECT_EQ(hid.waits[1], 10) << "garbage is not its turn";
}

TEST_F(OpenArmOverAPort, OneThatNeverStopsSendingIsAnsweredAfterSixtyFour) {
  for (int i = 0; i < 70; ++i) hid.reports.push_back(reportOf({0.0005 * i, 0, 0}));
  ASSERT_EQ(turn(), Exchange::Report);
  EXPECT_EQ(hid.reports.size(), 6u);
  EXPECT_NEAR(sample.position.z, 0.0005 * 63, 2e-4);
}

TEST_F(OpenArmOverAPort, ItsButtonIsTheFirst) {
  Report pressed = reportAt({0, 0, 6000});
  pressed[6] = 0x10, pressed[7] = 0x27;  // 10000 in encoder d
  turn(pressed);
  EXPECT_EQ(sample.buttons, 1u);
  EXPECT_FALSE(sample.hasVelocity);
  turn(reportAt({0, 0, 6000}));
  EXPECT_EQ(sample.buttons, 0u);
}

TEST_F(OpenArmOverAPort, AtItsStartItIsCalibratedOnlyWhereItIsAskedFor) {
  EXPECT_TRUE(hid.written.empty());
  options.calibrateAtStart = true;
  open();
  ASSERT_EQ(hid.written.size(), 1u);
  EXPECT_EQ(fieldOf(hid.written[0], 7), 1);
  EXPECT_EQ(fieldOf(hid.written[0], 13), 6000);
}

TEST_F(OpenArmOverAPort, OlderFirmwaresHaveReportsOfFourteenBytes) {
  options.commandBytes = 15, options.reportBytes = 14;
  open();
  Report report = reportAt({0, 0, 6000});
  report.resize(14);
  ASSERT_EQ(turn(report), Exchange::Report);
  EXPECT_LT(norm(sample.position - Vec3{0, 0.205, 0.025}), 1e-12);
  EXPECT_EQ(hid.written.at(0).size(), 15u);
  EXPECT_EQ(hid.room, 14u);
  options.commandBytes = options.reportBytes = 1000;
  open();
  EXPECT_EQ(turn(Report(64, 0)), Exchange::Report) << "no more than a report of USB has";
  EXPECT_EQ(hid.written.back().size(), 65u);
}

TEST_F(OpenArmOverAPort, AfterTheCalibrationAndAfterAnUnpluggingItsCountsBeginAnew) {
  const auto place = [&](double counts) {
    EXPECT_EQ(turn(reportAt({counts, 0, 6000})), Exchange::Report);
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
  hid.deaf = true;
  EXPECT_EQ(arm->calibrate(), "it does not take the calibration");
  EXPECT_EQ(turn(reportAt({0, 0, 0}, 1)), Exchange::Lost) << "its own button";
  arm->close();
  EXPECT_EQ(arm->calibrate(), "it is not connected");
}

TEST_F(OpenArmOverAPort, ZeroIsToldWithoutBeingAskedFor) {
  EXPECT_TRUE(arm->tellZero());
  ASSERT_EQ(hid.written.size(), 1u);
  EXPECT_EQ(hid.written[0], Report(65, 0));
  hid.deaf = true;
  EXPECT_FALSE(arm->tellZero());
  EXPECT_EQ(turn(), Exchange::Lost) << "nothing was read, and nothing can be told";
  arm->close();
  EXPECT_TRUE(arm->tellZero()) << "there is nobody to tell";
}

TEST_F(OpenArmOverAPort, ReportsOfAnOldFirmwareAreNotBelievedAndSaidToBeOld) {
  EXPECT_EQ(turn(Report(8, 1)), Exchange::Nothing);
  EXPECT_TRUE(holds(arm->lossText(), "too old: it sends reports of 8 bytes, and 14 are needed"));
  EXPECT_EQ(turn(reportAt({0, 0, 6000})), Exchange::Report);
  EXPECT_EQ(arm->lossText(), "") << "a short one among whole ones is a fault of the line";
}

}  // namespace
}  // namespace reachlab::devices
