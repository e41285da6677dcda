#pragma once
#include <array>
#include <atomic>
#include <string>

#include "devices/vendor/open_haptics_api.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// A PHANToM or Touch by OpenHaptics. Its scheduler is the clock: it calls at 1 kHz, and one call is one frame with one tick in it
/// (position read at its begin, force in effect at its end). Force limits are the device's own (nominal peak and continuous).
///   errors of a frame: communication or device fault -> lost for good; force, impulse, velocity or any other -> failed (its own
///   software has taken the force off): latched; warm motors -> the force is held to the continuous one while it lasts.
class PhantomDevice final : public haptics::HapticDevice {
 public:
  struct Options {
    std::string name;             // of the configuration; empty: the default device
    bool deviceVelocity = false;  // the vendor's smoothed velocity instead of our estimator's
    bool deadMan = false;         // HD_CURRENT_SAFETY_SWITCH must be closed
  };
  /// Opens it. Throws ResourceError in the library's own words.
  explicit PhantomDevice(const Options& options);
  ~PhantomDevice() override;

  haptics::DeviceInfo info() const override { return info_; }
  haptics::DeviceSample read() noexcept override { return sample_; }
  void write(const Vec3& force) noexcept override { force_ = force; }
  haptics::DeviceHealth health() const noexcept override { return health_.load(std::memory_order_acquire); }
  std::string healthText() const override;
  std::string calibrationHint() const override;
  void calibrate() override;
  bool stopForce() noexcept override;
  void startClock(ClockTick tick, void* context) override;
  void stopClock() noexcept override;

 private:
  std::uint32_t frame() noexcept;
  void readFrame() noexcept;
  void writeFrame() noexcept;
  void takeFrameErrors() noexcept;
  [[noreturn]] void refuse(const std::string& what);
  void readDescription();
  void updateCalibration();

  const hd::Api& hd_;
  Options options_;
  std::string words_;  // "device phantom"
  hd::Handle handle_ = hd::kNoHandle;
  haptics::DeviceInfo info_;
  haptics::DeviceSample sample_;
  Vec3 force_;
  ClockTick tick_ = nullptr;
  void* context_ = nullptr;
  unsigned long callback_ = 0;
  bool scheduled_ = false;
  bool readsTransform_ = true;
  int goodFrames_ = 0;  // in a row, since the motors were last told to be warm
  std::atomic<haptics::DeviceHealth> health_{haptics::DeviceHealth::Ready};
  std::atomic<std::uint32_t> lastError_{0};
  std::atomic<bool> stopping_{false}, forceOff_{false};
  std::atomic<int> zeroFrames_{0};
};

}  // namespace reachlab::devices
