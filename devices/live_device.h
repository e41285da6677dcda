#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/haptic_loop.h"

namespace reachlab::devices {

/// A device that is viewed and calibrated. The loop runs on it without an object. So the device renders only the forces of its guards
/// (wall, stylus). Controlling thread.
class LiveDevice {
 public:
  /// Opens the device and starts the loop. Throws as makeDevice does.
  LiveDevice(const std::string& spec, const experiment::CompiledExperiment& experiment);
  ~LiveDevice();
  LiveDevice(const LiveDevice&) = delete;
  LiveDevice& operator=(const LiveDevice&) = delete;

  static constexpr std::size_t kBins = 40;
  static constexpr double kBinSeconds = 0.25e-3;  // the last bin has all longer intervals
  struct View {
    Vec3 position;  // [m] world
    Vec3 force;     // [N] sent to the device
    std::uint32_t buttons = 0;
    bool valid = false;
    double speed = 0;                          // [m/s]
    double rate = 0;                           // [1/s] rate of the reports
    std::uint64_t reports = 0;                 // counted into the bins
    std::array<std::uint64_t, kBins> between;  // number of reports by the time since the report before
    std::string fault;                         // what is wrong, as a sentence; empty when the device is well
  };
  View look();

  haptics::DeviceInfo info() const { return device_->info(); }
  std::string calibrationHint() const { return device_->calibrationHint(); }
  /// Throws ResourceError with the device's message.
  void calibrate() { device_->calibrate(); }

 private:
  class Intervals;
  std::shared_ptr<haptics::HapticDevice> device_;
  std::unique_ptr<Intervals> intervals_;  // outlives the loop
  std::unique_ptr<haptics::HapticLoop> loop_;
  haptics::TickState newest_;
};

}  // namespace reachlab::devices
