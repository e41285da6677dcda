#pragma once
#include <cmath>
#include <memory>
#include <vector>

#include "sim/haptics/device.h"
#include "sim/haptics/run_sink.h"

namespace reachlab::haptics::test {

/// A hand along x from `from` to `to` by a minimum-jerk law of `ticks` ticks after the go signal; keeps what was written to it.
class ScriptedDevice final : public HapticDevice {
 public:
  ScriptedDevice(double from, double to, int ticks) : from_(from), to_(to), ticks_(ticks) {
    about.name = "scripted";
    about.virtualHand = true;
    written.reserve(100'000);
  }
  DeviceInfo info() const override { return about; }
  void cue(Cue cue) noexcept override {
    going_ = cue == Cue::Go;
    at_ = 0;
    if (other) other->cue(cue);
  }
  std::vector<HapticDevice*> hands() override {
    return other ? std::vector<HapticDevice*>{this, other.get()} : std::vector<HapticDevice*>{this};
  }
  DeviceSample read() noexcept override {
    if (going_ && at_ < ticks_) ++at_;
    const double x = static_cast<double>(at_) / ticks_;
    DeviceSample sample;
    sample.position = beside;
    sample.position.x = from_ + (to_ - from_) * x * x * x * (10 + x * (6 * x - 15));
    return sample;
  }
  void write(const Vec3& force) noexcept override {
    if (written.size() < written.capacity()) written.push_back(force);
  }

  DeviceInfo about;
  std::unique_ptr<ScriptedDevice> other;  // which is together with this one
  std::vector<Vec3> written;
  Vec3 beside;  // [m] y and z of the hand

 private:
  double from_, to_;
  int ticks_, at_ = 0;
  bool going_ = false;
};

/// What a recorder would need of a tick.
struct SeenTick {
  TickState state;
  trial::Command command;
  std::uint32_t missed;
};

/// Keeps every tick; room is made beforehand, because the haptic thread may not allocate.
class MemorySink final : public RunSink {
 public:
  explicit MemorySink(std::size_t most) { ticks.reserve(most); }
  bool onTick(const TickState& state, trial::Command command, std::uint32_t missed) noexcept override {
    if (ticks.size() == ticks.capacity()) return false;
    ticks.push_back({state, command, missed});
    return true;
  }
  void announce(std::int32_t trial, const trial::PlannedTrial&) override { announced.push_back(trial); }
  void awaitTrial(std::int32_t trial) override { awaited.push_back(trial); }
  void close() override { closed = true; }

  std::vector<SeenTick> ticks;
  std::vector<std::int32_t> announced, awaited;
  bool closed = false;
};

}  // namespace reachlab::haptics::test
