#pragma once
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

#include "base/math/minimum_jerk.h"
#include "base/system/os.h"
#include "devices/hid/arm_report.h"
#include "devices/hid/open_serial_arm.h"
#include "tests/devices/arm_poses.h"

namespace reachlab::devices {

using namespace std::chrono_literals;

/// A device keeps its time however busy the computer is; without the right to it, it is as late as the rest.
inline void requestFirmwareTime() {
  constexpr int kBeforeTheProgram = 85;
  os::requestRealTime(kBeforeTheProgram);
  os::requestExactSleep();
}

/// The arm's firmware: report, answer, report, strictly in turn; motors off when no answer came for half a second. Its handle is moved by
/// a hand of its own along the world's x, 20 cm in 1.35 s by a minimum-jerk law, back and forth with rests.
class ArmFirmware {
 public:
  /// `turned`: its first joint has been turned round once since it was switched on, so that its encoder wraps in the middle of each way.
  explicit ArmFirmware(int wire, bool turned = false)
      : turned_(turned), thread_([this, wire](const std::stop_token& stop) { run(stop, wire); }) {}

  std::atomic<int> most{0};  // [mA] largest current so far
  std::atomic<int> last{0};  // [mA] largest of the last command
  std::atomic<int> answers{0}, silences{0};
  std::atomic<int> wraps{0};        // of its encoders past the ends of 16 bits
  std::atomic<bool> middle{false};  // of its way
  std::atomic<bool> moves{true};
  std::atomic<bool> garbles{false}, shortens{false}, replays{false};  // bytes at random; 10 of 64; what it said at the start

 private:
  void run(const std::stop_token& stop, int wire) {
    const ArmModel& model = *findArmModel("woodenhaptics_v2015");
    requestFirmwareTime();
    const auto begin = std::chrono::steady_clock::now();
    auto next = begin;
    while (!stop.stop_requested()) {
      std::this_thread::sleep_until(next = std::max(next + 1ms, std::chrono::steady_clock::now()));
      const double t = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      auto counts = encoderCounts(model, anglesAt(model, {0, place(t), 0}));
      if (turned_) counts[0] += countsPerTurn(model);
      std::vector<std::uint8_t> report = armReport(counts);
      const auto raw = static_cast<std::int16_t>(report[0] | report[1] << 8);
      if (std::abs(raw - before_) > 30000) ++wraps;
      before_ = raw;
      if (first_.empty()) first_ = report;
      if (replays) report = first_;
      if (garbles)
        for (std::uint8_t& byte : report) byte = static_cast<std::uint8_t>(random_());
      const std::size_t size = shortens ? 10 : report.size();
      if (::write(wire, report.data(), size) != static_cast<ssize_t>(size)) return;
      if (!take(stop, wire)) ++silences;
    }
  }
  double place(double t) {
    const double within = std::fmod(t, 6.0), s = std::clamp((within - 2.5) / 1.35, 0.0, 1.0);
    if (!moves) return -0.1;
    const double back = std::clamp((within - 5.0) / 0.9, 0.0, 1.0);
    middle = s > 0.5 && s < 0.8;
    return -0.1 + 0.2 * (minimumJerk(s) - minimumJerk(back));
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
    last = largestCurrent(answer);
    if (last > most) most = last.load();
    return true;
  }
  static double countsPerTurn(const ArmModel& model) { return encoderCounts(model, {2 * std::numbers::pi, 0, 0})[0]; }

  bool turned_;
  int before_ = 0;
  std::vector<std::uint8_t> first_;
  std::mt19937 random_{1};
  std::jthread thread_;
};

}  // namespace reachlab::devices
