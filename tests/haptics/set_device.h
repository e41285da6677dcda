#pragma once
#include <functional>
#include <string>
#include <vector>

#include "sim/haptics/device.h"

namespace reachlab::haptics::test {

/// A device that gives what the test has set, and keeps what it was told.
class SetDevice final : public HapticDevice {
 public:
  explicit SetDevice(const Vec3& place = {}, const std::string& name = "set") {
    sample.position = place;
    about.name = name;
    written.reserve(20'000);
  }
  DeviceInfo info() const override { return about; }
  void prepareTrial(int index, int /*scene*/ = 0) override {
    prepared.push_back(index);
    calls += "prepare " + std::to_string(index) + "; ";
  }
  void cue(Cue cue) noexcept override {
    cues.push_back(cue);
    calls += cue == Cue::Go ? "go; " : "place; ";
  }
  DeviceSample read() noexcept override {
    ++reads;
    if (whileItIsRead) whileItIsRead();
    return sample;
  }
  void write(const Vec3& force) noexcept override {
    if (written.size() < written.capacity()) written.push_back(force);
    if (whileItIsTold) whileItIsTold();
  }
  void see(std::span<const dynamics::MassState> masses) noexcept override {
    seen = masses.size();
    calls += "see " + std::to_string(seen) + "; ";
  }
  std::vector<HapticDevice*> hands() override {
    std::vector<HapticDevice*> all{this};
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }
  DeviceHealth health() const noexcept override { return is; }
  std::string healthText() const override { return says; }
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

  DeviceInfo about;
  DeviceSample sample;
  DeviceHealth is = DeviceHealth::Ready;
  std::string says, hint;  // healthText, calibrationHint
  bool stops = true;
  std::vector<HapticDevice*> others;  // which are together with this one
  std::function<void()> whileItIsRead, whileItIsTold;

  std::vector<Vec3> written;
  std::vector<Cue> cues;
  std::vector<int> prepared;
  std::string calls;  // in their order, but for what is read and written
  int reads = 0;
  std::size_t seen = 0;
};

}  // namespace reachlab::haptics::test
