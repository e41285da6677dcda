#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <future>
#include <thread>
#include <utility>

#include "devices/driver/registry.h"
#include "devices/hid/hid_port.h"
#include "devices/hot_plug.h"
#include "devices/make_device.h"
#include "tests/cli/patient.h"
#include "tests/cli/program.h"
#include "tests/hidraw/arm_firmware.h"
#include "tests/hidraw/block.h"
#include "tests/hidraw/hidraw_bed.h"
#include "tests/until.h"
#include "tests/refusal.h"

/// The unmodified program and the real hidapi on devices that umockdev shows: run under umockdev-wrapper. Waits are for events.
namespace reachlab::devices {
namespace {

using reachlab::test::until;
using namespace std::chrono_literals;

class ArmOverHidraw : public ::testing::Test {
 protected:
  test::HidrawBed bed{0x16C0, 0x0486, "SN0001", "Arm"};
  experiment::Experiment experiment = experiment::readExperiment("chain-slow");
};

TEST_F(ArmOverHidraw, IsListedByTheNameThatOpensIt) {
  const auto rows = findDriver("hid")->find(*findDriver("hid"));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].name, "hid:SN0001");
  EXPECT_TRUE(rows[0].present) << rows[0].whyNot;
  const test::Ended listed = test::reach("list devices --json");
  EXPECT_EQ(listed.exitCode, 0);
  EXPECT_TRUE(holds(listed.out, "hid:SN0001"));
}

// Reports of 8 bytes: the protocol before that of 14.
TEST(OldArmOverHidraw, IsListedWithWhatToDoAndRefusedBeforeItIsOpened) {
  test::HidrawBed bed(0x16C0, 0x0486, "SN0000", "Old arm", 8);
  const test::Ended listed = test::reach("list devices");
  EXPECT_EQ(listed.exitCode, 0) << listed.err;
  const std::size_t row = listed.out.find("hid:SN0000");
  ASSERT_NE(row, std::string::npos) << listed.out;
  const std::string line = listed.out.substr(row, listed.out.find('\n', row) - row);
  EXPECT_TRUE(holds(line, "not there: its firmware is too old: it sends reports of 8 bytes, and 14 are needed; put a newer one on it"));
  const TemporaryFolder folder;
  const test::Ended run = test::reach("run chain-slow --device hid:SN0000 --data " + folder.path());
  EXPECT_EQ(run.exitCode, 3) << run.out;
  EXPECT_TRUE(holds(run.err, "its firmware is too old"));
  EXPECT_EQ(bed.opened(), 0);
}

TEST_F(ArmOverHidraw, PluggedOutAndInIsNoticed) {
  const std::uint64_t before = pluggedFingerprint();
  ASSERT_EQ(findPlugged().size(), 1u);
  bed.unplug();
  EXPECT_TRUE(findPlugged().empty());
  EXPECT_NE(pluggedFingerprint(), before);
  bed.plug();
  ASSERT_EQ(findPlugged().size(), 1u);
  EXPECT_EQ(findPlugged()[0].name, "hid:SN0001");
}

// An omega: a USB device that the vendor's library drives, and no HID.
TEST(HotPlug, WhatOnlyAVendorsLibraryDrivesIsNoticedToo) {
  UMockdevTestbed* bed = umockdev_testbed_new();
  const std::uint64_t before = pluggedFingerprint();
  umockdev_testbed_add_from_string(bed,
                                   "P: /devices/usb1/1-2\nN: bus/usb/001/009\nE: DEVNAME=/dev/bus/usb/001/009\nE: DEVTYPE=usb_device\n"
                                   "E: SUBSYSTEM=usb\nA: idVendor=1451\\n\nA: idProduct=0402\\n\n\n",
                                   nullptr);
  const std::uint64_t plugged = pluggedFingerprint();
  EXPECT_NE(plugged, before);
  EXPECT_EQ(pluggedFingerprint(), plugged) << "looking changes nothing";
  umockdev_testbed_clear(bed);
  EXPECT_EQ(pluggedFingerprint(), before);
  g_object_unref(bed);
}

TEST_F(ArmOverHidraw, GivesItsPlaceAndGetsItsForce) {
  ArmFirmware firmware(bed.wire());
  firmware.moves = false;
  const auto device = makeDevice("hid:SN0001", experiment, 1);
  haptics::DeviceSample sample;
  ASSERT_TRUE(until([&] { return (sample = device->read()).reports > 10; }));
  EXPECT_NEAR(sample.position.x, -0.1, 2e-4);
  ASSERT_TRUE(until([&] {
    device->write({1, 0, 0});
    return firmware.last > 100;
  }));
  EXPECT_TRUE(until([&] { return firmware.last == 0; })) << "a force that is not renewed is taken back";
  EXPECT_LE(firmware.most, 2000);
}

// Its serial number and its path are two names of one arm.
TEST_F(ArmOverHidraw, IsHeldByOneHandAloneWhateverItIsCalled) {
  ArmFirmware firmware(bed.wire());
  const auto one = makeDevice("hid:SN0001", experiment, 1);
  EXPECT_TRUE(holds(refusalOf([&] { makeDevice("hid:" + findHid().at(0).path, experiment, 1); }), "is already in use"));
}

TEST_F(ArmOverHidraw, ABlockOfReachesWhoseEncoderWrapsInEachOfThem) {
  ArmFirmware firmware(bed.wire(), true);
  const test::Ended run = blockWithin("--device hid:SN0001 --trials 3 --seed 1");
  EXPECT_LE(firmware.most, 2000);
  EXPECT_TRUE(until([&] { return firmware.last == 0; })) << "the last word was zero";
  if (run.exitCode != 0) GTEST_SKIP() << "the computer stood still in each attempt: " << run.err;
  const Block block = judge(run);
  EXPECT_EQ(block.trials, 3) << run.out << run.err;
  EXPECT_EQ(block.successes + block.lostToTime, 3) << run.out << run.err;
  EXPECT_GE(firmware.wraps, 3);
  EXPECT_GT(firmware.answers, 1000);
  EXPECT_GT(firmware.most, 0) << "the object was felt";
}

/// The program in the background; its process is known, so that it can be stopped and let go on.
class Running {
 public:
  explicit Running(const std::string& arguments)
      : ended_(std::async(std::launch::async, [this, arguments] {
          return test::shell("\"$REACH\" " + arguments + " & p=$!\necho $p > \"" + (folder_ / "pid").string() +
                             "\"\n(sleep 90; kill -INT $p 2> /dev/null) & w=$!\nwait $p; code=$?; kill $w; exit $code");
        })) {}
  test::Ended end() { return ended_.get(); }
  bool hasEnded() const { return ended_.wait_for(0s) == std::future_status::ready; }
  std::string pidFile() const { return (folder_ / "pid").string(); }

 private:
  TemporaryFolder folder_;
  std::future<test::Ended> ended_;
};

// In the recording, sampled at every tick: force before, and none from the 20th tick without the device on.
void expectNoForceOnceItIsLost(const TemporaryFolder& folder) {
  const TemporaryFolder tables;
  ASSERT_EQ(test::reach("export " + folder.path() + " --format csv --out " + tables.path()).exitCode, 0);
  std::string name;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(tables.path()))
    if (entry.path().string().ends_with("_samples.csv")) name = entry.path().string();
  const test::Table samples = test::parseCsv(test::contentOf(name));
  constexpr int kMostTicks = 20;
  int invalid = 0, felt = 0;
  for (std::size_t row = 0; row < samples.rows.size(); ++row) {
    invalid = samples.at(row, "valid") != 0 ? 0 : invalid + 1;
    double size = 0;
    for (const char* column : {"device_force_x_n", "device_force_y_n", "device_force_z_n"}) size += std::abs(samples.at(row, column));
    if (size > 0) ++felt;
    if (invalid > kMostTicks) {
      ASSERT_EQ(size, 0) << "row " << row;
    }
  }
  EXPECT_GT(felt, 0);
  EXPECT_GT(invalid, kMostTicks) << "it was lost to the end";
}

TEST_F(ArmOverHidraw, UnpluggedInMidTrialTheTrialIsInterruptedAndTheRunTakenUpAgain) {
  auto firmware = std::make_unique<ArmFirmware>(bed.wire());
  const TemporaryFolder folder;
  const std::string run = "run " + test::patient(folder, "chain-slow") +
                          " --timing-check 0 --every-tick --device hid:SN0001 --trials 2 --seed 1 --data " + folder.path();
  Running program(run);
  ASSERT_TRUE(until([&] { return firmware->most > 0 || program.hasEnded(); })) << "the object is felt";
  if (firmware->most == 0) {
    const test::Ended ended = program.end();
    expectGivenUp(ended);
    GTEST_SKIP() << "the computer stood still: " << ended.err;
  }
  firmware.reset();
  bed.unplug();
  const test::Ended lost = program.end();
  EXPECT_EQ(lost.exitCode, 3) << lost.out << lost.err;
  EXPECT_TRUE(holds(lost.out, "outcome=interrupted reason=device_lost")) << lost.out << lost.err;
  EXPECT_TRUE(lost.err.find("is lost") != std::string::npos || lost.err.find("gave no new report") != std::string::npos) << lost.err;
  expectNoForceOnceItIsLost(folder);
  bed.plug();
  firmware = std::make_unique<ArmFirmware>(bed.wire());
  const test::Ended resumed = test::reach(run + " --resume", "timeout -s INT 90");
  if (resumed.exitCode != 0) expectGivenUp(resumed);
  const auto lines = test::trialLines(resumed.out);
  EXPECT_GE(lines.size(), resumed.exitCode == 0 ? 2u : 0u) << "the lost trial, and what was not begun: " << resumed.out;
  if (!lines.empty()) {
    EXPECT_EQ(lines.front().at("trial"), "1") << resumed.out;
  }
}

TEST_F(ArmOverHidraw, AStoppedProgramsMotorsAreSwitchedOffByTheFirmware) {
  ArmFirmware firmware(bed.wire());
  const TemporaryFolder folder;
  Running program("run " + test::patient(folder, "chain-slow") + " --timing-check 0 --device hid:SN0001 --trials 1 --seed 1 --data " +
                  folder.path());
  ASSERT_TRUE(until([&] { return firmware.most > 0 || program.hasEnded(); }));
  if (program.hasEnded()) {
    const test::Ended ended = program.end();
    expectGivenUp(ended);
    GTEST_SKIP() << "the computer stood still: " << ended.err;
  }
  pid_t pid = 0;
  std::ifstream(program.pidFile()) >> pid;
  ASSERT_GT(pid, 0);
  const int silences = firmware.silences;
  ::kill(pid, SIGSTOP);
  EXPECT_TRUE(until([&] { return firmware.silences > silences && firmware.last == 0; }));
  ::kill(pid, SIGCONT);
  const test::Ended ended = program.end();  // a gap of half a second: the trial may be lost to it, but in words
  EXPECT_TRUE(ended.exitCode == 0 || ended.exitCode == 3) << ended.out << ended.err;
}

/// A SpaceMouse: from when it is opened on, pushed to the right by a minimum-jerk profile again and again, a report each 8 ms, three of zero and then none at rest.
class SpaceMouseFirmware {
 public:
  explicit SpaceMouseFirmware(const test::HidrawBed& bed)
      : thread_([this, &bed](const std::stop_token& stop) { run(stop, bed.wire(), bed.opened()); }) {}
  std::atomic<int> reports{0};

 private:
  void run(const std::stop_token& stop, int wire, const std::atomic<int>& opened) {
    requestFirmwareTime();
    constexpr double kDuration = 2.26, kRest = 2, kGain = 0.5, kDeadZone = 0.05;
    auto begin = std::chrono::steady_clock::now();
    auto next = begin;
    int zeros = 0, before = 0;
    while (!stop.stop_requested()) {
      std::this_thread::sleep_until(next += 8ms);
      if (std::exchange(before, opened.load()) != opened) begin = std::chrono::steady_clock::now();
      if (before == 0) continue;
      const double t =
          std::fmod(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), kDuration + kRest) - kRest;
      const double s = t / kDuration, speed = s <= 0 || s >= 1 ? 0 : 0.2 / kDuration * 30 * s * s * (1 - s) * (1 - s);
      const double push = speed > 0 ? kDeadZone + (1 - kDeadZone) * speed / kGain : 0;
      zeros = push > 0 ? 0 : zeros + 1;
      if (zeros > 3) continue;
      const auto raw = static_cast<std::int16_t>(std::lround(350 * push));
      const std::uint8_t report[7] = {1, static_cast<std::uint8_t>(raw & 0xFF), static_cast<std::uint8_t>(raw >> 8), 0, 0, 0, 0};
      if (::write(wire, report, sizeof report) != sizeof report) return;
      ++reports;
    }
  }
  std::jthread thread_;
};

TEST(SpaceMouseOverHidraw, ABlockOfReachesAtItsOwnRateWithTheLoopAtOneKilohertz) {
  test::HidrawBed bed(0x256F, 0xC635, "SM1", "SpaceMouse");
  SpaceMouseFirmware firmware(bed);
  const TemporaryFolder folder;
  const test::Ended run = test::reach("run " + test::patient(folder, "chain-slow") +
                                          " --device spacemouse --trials 3 --seed 1 --timing-check 0 --every-tick --data " + folder.path(),
                                      "timeout -s INT 60");
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  const Block block = judge(run);
  EXPECT_EQ(block.trials, 3) << run.out << run.err;
  EXPECT_GT(firmware.reports, 100);
  EXPECT_TRUE(holds(run.err, "ticks/s"));
}

}  // namespace
}  // namespace reachlab::devices
