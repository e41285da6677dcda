#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <thread>

#include "devices/driver/registry.h"
#include "devices/make_device.h"
#include "tests/devices/fakes/pid_firmware.h"
#include "tests/hidraw/arm_firmware.h"
#include "tests/hidraw/block.h"
#include "tests/hidraw/hidraw_bed.h"
#include "tests/until.h"

/// A force-feedback joystick of HID PID as umockdev shows it: its descriptor is read from sysfs, its effects are made by feature reports and
/// told by output reports, through the real hidapi.
namespace reachlab::devices {
namespace {

using reachlab::test::until;
using namespace std::chrono_literals;

/// The joystick's firmware: an input report when its place has changed, output reports as they come. Its handle is moved by a hand of its own:
/// 0.8 of its travel to the left, to the right in 1.35 s by a minimum-jerk law, and back, again and again.
class StickFirmware {
 public:
  explicit StickFirmware(int wire) : thread_([this, wire](const std::stop_token& stop) { run(stop, wire); }) {}

  std::atomic<bool> moves{true};
  std::pair<double, double> felt() const {
    const std::lock_guard lock(mutex_);
    return pid_.felt();
  }
  template <class Ask>
  auto ask(Ask&& question) const {
    const std::lock_guard lock(mutex_);
    return question(pid_);
  }
  std::atomic<double> most{0};  // [share] of its force so far

  /// Feature reports go past the wire.
  bool setFeature(const test::PidBytes& report) {
    const std::lock_guard lock(mutex_);
    return pid_.setFeature(report);
  }
  test::PidBytes getFeature(std::uint8_t number) const {
    const std::lock_guard lock(mutex_);
    return pid_.getFeature(number);
  }

 private:
  void run(const std::stop_token& stop, int wire) {
    requestFirmwareTime();
    const auto begin = std::chrono::steady_clock::now();
    auto next = begin;
    test::PidBytes before;
    while (!stop.stop_requested()) {
      std::this_thread::sleep_until(next = std::max(next + 4ms, std::chrono::steady_clock::now()));
      const double t = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      const auto x = static_cast<std::int16_t>(std::lround(32767 * share(t)));
      const test::PidBytes report = test::pidInput(x, 0);
      if (report != before && ::write(wire, report.data(), report.size()) != static_cast<ssize_t>(report.size())) return;
      before = report;
      if (!take(wire)) return;
    }
  }
  double share(double t) const {
    if (!moves) return -0.8;
    const double within = std::fmod(t, 6.0), s = std::clamp((within - 2.5) / 1.35, 0.0, 1.0),
                 back = std::clamp((within - 5) / 0.9, 0.0, 1.0);
    const auto law = [](double u) { return u * u * u * (10 + u * (6 * u - 15)); };
    return -0.8 + 1.6 * (law(s) - law(back));
  }
  // The wire has no report boundaries; each report's number tells its length.
  bool take(int wire) {
    pollfd at{wire, POLLIN, 0};
    std::uint8_t bytes[256];
    while (::poll(&at, 1, 0) > 0 && (at.revents & POLLIN) != 0) {
      const ssize_t got = ::read(wire, bytes, sizeof bytes);
      if (got <= 0) return false;
      waiting_.insert(waiting_.end(), bytes, bytes + got);
    }
    const std::map<std::uint8_t, std::size_t> lengths{{0x01, 14}, {0x05, 4}, {0x0A, 4}, {0x0C, 2}, {0x0D, 2}};
    const std::lock_guard lock(mutex_);
    while (!waiting_.empty()) {
      const auto length = lengths.find(waiting_.front());
      if (length == lengths.end()) {
        ++pid_.violations;
        waiting_.erase(waiting_.begin());
        continue;
      }
      if (waiting_.size() < length->second) break;
      pid_.write({waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(length->second)});
      waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(length->second));
    }
    const auto [x, y] = pid_.felt();
    most = std::max({most.load(), std::abs(x), std::abs(y)});
    return true;
  }

  mutable std::mutex mutex_;
  test::PidFirmware pid_;
  test::PidBytes waiting_;
  std::jthread thread_;
};

class StickOverHidraw : public ::testing::Test {
 protected:
  std::unique_ptr<StickFirmware> firmware;
  test::HidrawBed bed{0x045E,
                      0x001B,
                      "FFB2",
                      "Sidewinder",
                      test::pidDescriptor(),
                      {[this](const test::PidBytes& report) { return firmware && firmware->setFeature(report); },
                       [this](std::uint8_t number) { return firmware ? firmware->getFeature(number) : test::PidBytes{}; }}};
  experiment::Experiment experiment = experiment::readExperiment("chain-slow");
};

TEST_F(StickOverHidraw, IsListedByItsDescriptor) {
  const test::Ended listed = test::reach("list devices");
  EXPECT_EQ(listed.exitCode, 0);
  EXPECT_NE(listed.out.find("stick:FFB2"), std::string::npos) << listed.out;
}

TEST_F(StickOverHidraw, ItsEffectsAreMadeAndToldOverTheRealHidapi) {
  firmware = std::make_unique<StickFirmware>(bed.wire());
  firmware->moves = false;
  {
    const auto device = makeDevice("stick:FFB2,full-force=2,travel=0.125", experiment, 1);
    haptics::DeviceSample sample;
    ASSERT_TRUE(until([&] { return std::abs((sample = device->read()).position.x + 0.1) < 1e-3; })) << sample.position.x;
    ASSERT_TRUE(until([&] {
      device->write({1, 0, -0.5});
      return firmware->felt() == std::pair{0.5, -0.25};
    })) << firmware->felt().first;
    EXPECT_TRUE(until([&] { return firmware->felt() == std::pair{0.0, 0.0}; })) << "a force that is not renewed is taken back";
    EXPECT_EQ(firmware->ask([](const test::PidFirmware& pid) { return pid.effects.size(); }), 2u);
    EXPECT_EQ(firmware->ask([](const test::PidFirmware& pid) { return pid.gain; }), 255);
  }
  EXPECT_TRUE(until([&] { return firmware->ask([](const test::PidFirmware& pid) { return !pid.effects.at(1).started; }); }));
  EXPECT_EQ(firmware->ask([](const test::PidFirmware& pid) { return pid.violations; }), 0);
}

TEST_F(StickOverHidraw, TheProgramReachesWithItAndItIsFelt) {
  firmware = std::make_unique<StickFirmware>(bed.wire());
  const test::Ended run = blockWithin("--device stick:FFB2,full-force=2,travel=0.125 --trials 2 --seed 1");
  EXPECT_LE(firmware->most, 1);
  EXPECT_TRUE(until([&] { return firmware->felt() == std::pair{0.0, 0.0}; }));
  EXPECT_EQ(firmware->ask([](const test::PidFirmware& pid) { return pid.violations; }), 0);
  if (run.exitCode != 0) GTEST_SKIP() << "the computer stood still in each attempt: " << run.err;
  const Block block = judge(run);
  EXPECT_EQ(block.trials, 2) << run.out << run.err;
  EXPECT_EQ(block.successes + block.lostToTime, 2) << run.out << run.err;
  EXPECT_GT(firmware->most, 0.02) << "the object was felt";
}

}  // namespace
}  // namespace reachlab::devices
