#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <future>
#include <random>
#include <thread>

#include "devices/hid/arm_report.h"
#include "devices/hid/open_serial_arm.h"
#include "devices/hot_plug.h"
#include "devices/make_device.h"
#include "devices/registry.h"
#include "tests/cli/program.h"
#include "tests/hidraw/hidraw_bed.h"
#include "tests/until.h"

/// The unmodified program and the real hidapi on devices that umockdev shows: run under umockdev-wrapper. Waits are for events.
namespace reachlab::devices {
namespace {

using reachlab::test::until;
using namespace std::chrono_literals;

/// The arm's firmware: report, answer, report, strictly in turn; motors off when no answer came for half a second. Its handle is moved by
/// a hand of its own along the world's x, 20 cm in 1.35 s by a minimum-jerk law, back and forth with rests.
class Firmware {
 public:
  explicit Firmware(int wire) : thread_([this, wire](const std::stop_token& stop) { run(stop, wire); }) {}

  std::atomic<int> most{0};  // [mA] largest current so far
  std::atomic<int> last{0};  // [mA] largest of the last command
  std::atomic<int> answers{0}, silences{0};
  std::atomic<bool> middle{false};  // of its way
  std::atomic<bool> moves{true};
  std::atomic<bool> garbles{false}, shortens{false}, replays{false};  // bytes at random; 10 of 64; what it said at the start

 private:
  void run(const std::stop_token& stop, int wire) {
    const ArmModel& model = *findArmModel("woodenhaptics_v2015");
    const auto begin = std::chrono::steady_clock::now();
    auto next = begin;
    while (!stop.stop_requested()) {
      std::this_thread::sleep_until(next = std::max(next + 1ms, std::chrono::steady_clock::now()));
      const double t = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      const auto counts = encoderCounts(model, anglesAt(model, {0, place(t), 0}));
      std::uint8_t report[64] = {};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto raw = static_cast<std::uint16_t>(static_cast<std::int64_t>(std::llround(counts[i])));
        report[2 * i] = static_cast<std::uint8_t>(raw & 0xFF);
        report[2 * i + 1] = static_cast<std::uint8_t>(raw >> 8);
      }
      if (first_.empty()) first_.assign(report, report + sizeof report);
      if (replays) std::copy(first_.begin(), first_.end(), report);
      if (garbles)
        for (std::uint8_t& byte : report) byte = static_cast<std::uint8_t>(random_());
      const std::size_t size = shortens ? 10 : sizeof report;
      if (::write(wire, report, size) != static_cast<ssize_t>(size)) return;
      if (!take(stop, wire)) ++silences;
    }
  }
  double place(double t) {
    const double within = std::fmod(t, 6.0), s = std::clamp((within - 2.5) / 1.35, 0.0, 1.0);
    if (!moves) return -0.1;
    const double back = std::clamp((within - 5.0) / 0.9, 0.0, 1.0);
    middle = s > 0.5 && s < 0.8;
    const auto law = [](double x) { return x * x * x * (10 + x * (6 * x - 15)); };
    return -0.1 + 0.2 * (law(s) - law(back));
  }
  // False when half a second went by without an answer: the firmware's own watchdog.
  bool take(const std::stop_token& stop, int wire) {
    std::uint8_t answer[65];
    std::size_t got = 0;
    for (int waited = 0; waited < 100 && got < sizeof answer && !stop.stop_requested(); ++waited) {
      pollfd at{wire, POLLIN, 0};
      if (::poll(&at, 1, 5) <= 0 || (at.revents & POLLIN) == 0) continue;
      const ssize_t n = ::read(wire, answer + got, sizeof answer - got);
      if (n <= 0) return false;
      got += static_cast<std::size_t>(n);
    }
    if (got < sizeof answer) {
      last = 0;
      return false;
    }
    ++answers;
    int largest = 0;
    for (const int at : {1, 3, 5}) largest = std::max(largest, std::abs(static_cast<std::int16_t>(answer[at] | answer[at + 1] << 8)));
    last = largest;
    if (largest > most) most = largest;
    return true;
  }
  std::vector<std::uint8_t> first_;
  std::mt19937 random_{1};
  std::jthread thread_;
};

// chain-slow, whatever time the machine loses: how well it keeps time is not judged here.
std::string patientChain(const test::Folder& folder) {
  experiment::Experiment lenient = experiment::readExperiment("chain-slow");
  lenient.timing = experiment::kNoTimingLimits;
  return folder.write("slow.json", toJson(lenient));
}

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
  EXPECT_NE(listed.out.find("hid:SN0001"), std::string::npos);
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

TEST_F(ArmOverHidraw, GivesItsPlaceAndGetsItsForce) {
  Firmware firmware(bed.wire());
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

TEST_F(ArmOverHidraw, UnpluggedItIsLostAndPluggedInAgainItComesBack) {
  auto firmware = std::make_unique<Firmware>(bed.wire());
  const auto device = makeDevice("hid:SN0001", experiment, 1);
  ASSERT_TRUE(until([&] { return device->read().reports > 10; }));
  firmware.reset();
  bed.unplug();
  ASSERT_TRUE(until([&] { return !device->read().valid; }));
  EXPECT_EQ(device->health(), haptics::DeviceHealth::Lost);
  bed.plug();
  firmware = std::make_unique<Firmware>(bed.wire());
  EXPECT_TRUE(until([&] { return device->read().valid; }));
}

TEST_F(ArmOverHidraw, TheProgramReachesWithIt) {
  Firmware firmware(bed.wire());
  const test::Folder folder;
  const test::Ended run =
      test::reach("run " + patientChain(folder) + " --device hid:SN0001 --trials 1 --seed 1 --timing-check 0 --data " + folder.string(),
                  "timeout -s INT 60");  // the run waits for a hand as long as it takes
  // The device may be lost to a machine that is too busy, but then in words.
  if (run.exitCode != 0) {
    EXPECT_EQ(run.exitCode, 3) << run.err;
    EXPECT_NE(run.err.find("device "), std::string::npos) << run.err;
  }
  EXPECT_EQ(test::trialLines(run.out).size(), run.exitCode == 0 ? 1u : test::trialLines(run.out).size()) << run.out << run.err;
  EXPECT_GT(firmware.answers, 100);
  EXPECT_GT(firmware.most, 0) << "the object was felt";
  EXPECT_LE(firmware.most, 2000);
  EXPECT_TRUE(until([&] { return firmware.last == 0; })) << "and the last word was zero";
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
  std::string pidFile() const { return (folder_ / "pid").string(); }

 private:
  test::Folder folder_;
  std::future<test::Ended> ended_;
};

TEST_F(ArmOverHidraw, UnpluggedInMidTrialTheTrialIsInterruptedAndTheRunTakenUpAgain) {
  auto firmware = std::make_unique<Firmware>(bed.wire());
  const test::Folder folder;
  const std::string run =
      "run " + patientChain(folder) + " --timing-check 0 --device hid:SN0001 --trials 2 --seed 1 --data " + folder.string();
  Running program(run);
  ASSERT_TRUE(until([&] { return firmware->most > 0; })) << "the object is felt";
  firmware.reset();
  bed.unplug();
  const test::Ended lost = program.end();
  EXPECT_EQ(lost.exitCode, 3) << lost.out << lost.err;
  EXPECT_NE(lost.out.find("outcome=interrupted reason=device_lost"), std::string::npos) << lost.out << lost.err;
  EXPECT_TRUE(lost.err.find("is lost") != std::string::npos || lost.err.find("gave no new report") != std::string::npos) << lost.err;
  bed.plug();
  firmware = std::make_unique<Firmware>(bed.wire());
  const test::Ended resumed = test::reach(run + " --resume", "timeout -s INT 90");
  if (resumed.exitCode != 0) {
    EXPECT_EQ(resumed.exitCode, 3) << resumed.err;
    EXPECT_NE(resumed.err.find("device "), std::string::npos) << resumed.err;
  }
  EXPECT_GE(test::trialLines(resumed.out).size(), resumed.exitCode == 0 ? 1u : 0u) << "what was not begun is done" << resumed.out;
}

TEST_F(ArmOverHidraw, ReportsFromThePastAreAJumpAndLatchTheForceOff) {
  Firmware firmware(bed.wire());
  const test::Folder folder;
  Running program("run " + patientChain(folder) + " --timing-check 0 --device hid:SN0001 --trials 1 --seed 1 --data " + folder.string());
  // In the middle of its way the arm begins to say what it said at the start.
  ASSERT_TRUE(until([&] { return firmware.most > 0 && firmware.middle; }));
  firmware.replays = true;
  const test::Ended ended = program.end();
  EXPECT_EQ(ended.exitCode, 3) << ended.out << ended.err;
  EXPECT_NE(ended.err.find("fault: "), std::string::npos) << ended.err;
  EXPECT_TRUE(until([&] { return firmware.last == 0; }));
}

TEST_F(ArmOverHidraw, GarbageAndShortReportsAreNotBelieved) {
  Firmware firmware(bed.wire());
  firmware.moves = false;
  const auto device = makeDevice("hid:SN0001", experiment, 1);
  haptics::DeviceSample sample;
  ASSERT_TRUE(until([&] { return (sample = device->read()).reports > 10; }));
  firmware.shortens = true;
  // The line has no report boundaries: short ones run together, and what is read is either no whole report or a shifted one, which the watch
  // judges by the place that it gives. Nothing hangs, and no current is beyond the limit.
  const int answers = firmware.answers;
  ASSERT_TRUE(until([&] {
    device->write({1, 0, 0});
    return firmware.answers > answers + 20;
  }));
  firmware.shortens = false;
  firmware.garbles = true;
  ASSERT_TRUE(until([&] {
    device->write({1, 0, 0});
    return firmware.answers > answers + 200;
  }));
  EXPECT_LE(firmware.most, 2000);
}

TEST_F(ArmOverHidraw, AStoppedProgramsMotorsAreSwitchedOffByTheFirmware) {
  Firmware firmware(bed.wire());
  const test::Folder folder;
  Running program("run " + patientChain(folder) + " --timing-check 0 --device hid:SN0001 --trials 1 --seed 1 --data " + folder.string());
  ASSERT_TRUE(until([&] { return firmware.most > 0; }));
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

/// A SpaceMouse: pushed to the right by a minimum-jerk profile again and again, a report each 8 ms, three of zero and then none at rest.
class SpaceMouseFirmware {
 public:
  explicit SpaceMouseFirmware(int wire) : thread_([this, wire](const std::stop_token& stop) { run(stop, wire); }) {}
  std::atomic<int> reports{0};

 private:
  void run(const std::stop_token& stop, int wire) {
    constexpr double kDuration = 2.26, kRest = 2, kGain = 0.5, kDeadZone = 0.05;
    const auto begin = std::chrono::steady_clock::now();
    auto next = begin;
    int zeros = 0;
    while (!stop.stop_requested()) {
      std::this_thread::sleep_until(next += 8ms);
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
  SpaceMouseFirmware firmware(bed.wire());
  const test::Folder folder;
  const test::Ended run = test::reach(
      "run " + patientChain(folder) + " --timing-check 0 --device spacemouse --trials 3 --seed 1 --every-tick --data " + folder.string(),
      "timeout -s INT 90");
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  const auto lines = test::trialLines(run.out);
  ASSERT_EQ(lines.size(), 3u) << run.out << run.err;
  int lostToTime = 0, moved = 0;
  for (const auto& line : lines) {
    if (line.contains("reason") && line.at("reason") == "timing") ++lostToTime;
    if (line.contains("time_s")) ++moved;
  }
  EXPECT_GT(moved + lostToTime, 0) << run.out;
  RecordProperty("trials_lost_to_time", lostToTime);
  EXPECT_GT(firmware.reports, 100);
  EXPECT_NE(run.err.find("ticks/s"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace reachlab::devices
