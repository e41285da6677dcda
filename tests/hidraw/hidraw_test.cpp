#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "devices/hid/arm_report.h"
#include "devices/hid/open_serial_arm.h"
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
  std::atomic<bool> moves{true};

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
      if (::write(wire, report, sizeof report) != sizeof report) return;
      if (!take(stop, wire)) ++silences;
    }
  }
  double place(double t) const {
    const double within = std::fmod(t, 6.0), s = std::clamp((within - 2.5) / 1.35, 0.0, 1.0);
    if (!moves) return -0.1;
    const double back = std::clamp((within - 5.0) / 0.9, 0.0, 1.0);
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
  std::jthread thread_;
};

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
  experiment::Experiment lenient = experiment::readExperiment("chain-slow");
  lenient.timing = experiment::kNoTimingLimits;  // how well the machine keeps time is not judged here
  const std::string file = (folder / "slow.json").string();
  std::ofstream(file) << toJson(lenient);
  const test::Ended run = test::reach("run " + file + " --device hid:SN0001 --trials 1 --seed 1 --timing-check 0 --data " + folder.string(),
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

}  // namespace
}  // namespace reachlab::devices
