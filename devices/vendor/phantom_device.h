#pragma once
#include <string>

#include "devices/vendor/open_haptics_api.h"
#include "devices/vendor/phantom_frames.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// A PHANToM or Touch by OpenHaptics, one of two ways. Its scheduler is the clock: it calls at 1 kHz, and one call is one frame with one
/// tick in it. Or it is a source that the tick samples: frames go on by themselves from the construction on, each gives the newest place
/// and takes the newest force. What goes wrong in a frame: phantom_frames.h. Force limits are the device's own (nominal peak and continuous).
class PhantomDevice final : public haptics::HapticDevice {
 public:
  struct Options {
    std::string name;             // of the configuration; empty: the default device
    bool deviceVelocity = false;  // the vendor's smoothed velocity instead of our estimator's
    bool deadMan = false;         // HD_CURRENT_SAFETY_SWITCH must be closed
    bool drivesClock = true;      // false: the tick samples it
  };
  /// Opens it; where its scheduler runs for another one, that is paused meanwhile. Throws ResourceError in the library's own words.
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
  PhantomFrames* frames_ = nullptr;  // kept for ever once it was scheduled
  unsigned long callback_ = 0;
  bool scheduled_ = false, everScheduled_ = false;
};

}  // namespace reachlab::devices
