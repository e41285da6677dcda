#pragma once
#include <string>

#include "devices/vendor/open_haptics_api.h"
#include "devices/vendor/phantom_frames.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// A PHANToM or Touch by OpenHaptics, in one of two modes. In the first mode its scheduler is the clock. It calls at 1 kHz, and each call
/// is one frame with one tick in it. In the second mode the tick samples the device. Frames then run from the construction on, and each
/// frame gives the newest position and takes the newest force. phantom_frames.h describes the errors of a frame. The force limits are the
/// device's nominal peak and continuous force.
class PhantomDevice final : public haptics::HapticDevice {
 public:
  struct Options {
    std::string name = {};        // name in the vendor's configuration; empty: the default device
    bool deviceVelocity = false;  // the vendor's smoothed velocity instead of our estimator's
    bool deadMan = false;         // HD_CURRENT_SAFETY_SWITCH must be closed
    bool drivesClock = true;      // false: the tick samples it
  };
  /// Opens the device. If its scheduler runs for another device, the scheduler is paused meanwhile. Throws ResourceError with the library's
  /// message.
  explicit PhantomDevice(const Options& options);
  ~PhantomDevice() override;

  haptics::DeviceInfo info() const override { return info_; }
  haptics::DeviceSample read() noexcept override { return frames_->read(); }
  void write(const Vec3& force) noexcept override { frames_->write(force); }
  haptics::DeviceHealth health() const noexcept override { return frames_->health(); }
  std::string healthText() const override;
  std::string calibrationHint() const override;
  void calibrate() override;
  bool stopForce() noexcept override;
  void startClock(ClockTick tick, void* context) override;
  void stopClock() noexcept override;

  const FrameTimes& times() const noexcept { return frames_->times(); }

 private:
  void open();
  void closeDevice() noexcept;
  void schedule(ClockTick tick, void* context);
  [[noreturn]] void refuse(const std::string& what);
  void readDescription();
  void updateCalibration();

  const hd::Api& hd_;
  Options options_;
  std::string words_;  // "device phantom"
  hd::Handle handle_ = hd::kNoHandle;
  haptics::DeviceInfo info_;
  PhantomFrames* frames_ = nullptr;  // never freed after it was scheduled
  unsigned long callback_ = 0;
  bool scheduled_ = false, everScheduled_ = false;
};

}  // namespace reachlab::devices
