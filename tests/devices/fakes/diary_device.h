#pragma once
#include <string>

#include "sim/haptics/device.h"

namespace reachlab::test {

/// A device that is where it was put, says what the test tells it to, and keeps what it was told.
struct DiaryDevice final : haptics::HapticDevice {
  explicit DiaryDevice(const std::string& name = "diary") { shown.name = name; }
  haptics::DeviceInfo info() const override { return shown; }
  haptics::DeviceSample read() noexcept override { return sample; }
  void write(const Vec3& f) noexcept override { force = f; }
  void prepareTrial(int index, int /*scene*/ = 0) override { calls += "prepare " + std::to_string(index) + "; "; }
  void cue(haptics::Cue cue) noexcept override { calls += cue == haptics::Cue::Go ? "go; " : "place; "; }
  void see(std::span<const dynamics::MassState> masses) noexcept override { calls += "see " + std::to_string(masses.size()) + "; "; }
  haptics::DeviceHealth health() const noexcept override { return state; }
  std::string healthText() const override { return said; }
  std::string calibrationHint() const override { return hint; }
  void calibrate() override { calls += "calibrate; "; }
  bool stopForce() noexcept override {
    calls += "stop; ";
    return stops;
  }
  void startClock(ClockTick tick, void* context) override {
    calls += "clock; ";
    if (tick != nullptr) tick(context);
  }
  void stopClock() noexcept override { calls += "no clock; "; }

  haptics::DeviceInfo shown;
  haptics::DeviceSample sample;
  haptics::DeviceHealth state = haptics::DeviceHealth::Ready;
  std::string said, hint;  // healthText, calibrationHint
  bool stops = true;
  Vec3 force;         // [N] last written
  std::string calls;  // in their order
};

}  // namespace reachlab::test
