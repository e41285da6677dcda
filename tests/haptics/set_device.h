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
  void prepareTrial(int index, int /*scene*/ = 0) override { prepared.push_back(index); }
  void cue(Cue cue) noexcept override { cues.push_back(cue); }
  DeviceSample read() noexcept override {
    ++reads;
    if (whileItIsRead) whileItIsRead();
    return sample;
  }
  void write(const Vec3& force) noexcept override {
    if (written.size() < written.capacity()) written.push_back(force);
    if (whileItIsTold) whileItIsTold();
  }
  void see(std::span<const dynamics::MassState> masses) noexcept override { seen = masses.size(); }
  std::vector<HapticDevice*> hands() override {
    std::vector<HapticDevice*> all{this};
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }
  DeviceHealth health() const noexcept override { return is; }
  std::string healthText() const override { return says; }
  bool stopForce() noexcept override {
    ++stops;
    return true;
  }

  DeviceInfo about;
  DeviceSample sample;
  DeviceHealth is = DeviceHealth::Ready;
  std::string says;
  std::vector<HapticDevice*> others;  // which are together with this one
  std::function<void()> whileItIsRead, whileItIsTold;

  std::vector<Vec3> written;
  std::vector<Cue> cues;
  std::vector<int> prepared;
  int reads = 0, stops = 0;
  std::size_t seen = 0;
};

}  // namespace reachlab::haptics::test
