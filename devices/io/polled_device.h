#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "base/system/triple_buffer.h"
#include "sim/haptics/device.h"
#include "sim/haptics/leavable_thread.h"

namespace reachlab::devices {

/// The outcome of one exchange with a device.
enum class Exchange : std::uint8_t {
  Report,   // the device gave a new sample
  Nothing,  // no new sample: the device sent nothing in time, or the same sample again; not yet an error
  Lost,     // the device is gone (unplugged, closed, refused)
};

/// The newest force from the tick, taken as late as possible: each millisecond of delay costs stability.
class ForceSource {
 public:
  /// [N] in the world frame. Zero when the tick hangs or the device was lost or stopped. I/O thread, wait-free.
  virtual Vec3 newest() noexcept = 0;
  /// [ns] the I/O thread's clock.
  virtual std::int64_t now() const noexcept = 0;

 protected:
  ~ForceSource() = default;
};

/// A device whose transport may wait: USB, serial lines, sockets, vendors' calls. Only one I/O thread uses it, except for info and
/// stopForce.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual haptics::DeviceInfo info() const = 0;
  /// Takes the device's newest sample (world frame: position, velocity, buttons, released) and sends it the newest force. May
  /// wait, at most some 10 ms. A force is never older than that.
  virtual Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) = 0;
  /// [ns] least time between the beginnings of two exchanges. 0: the exchange itself sets the pace.
  virtual std::int64_t period() const { return 0; }
  /// Called every millisecond after Lost, until it returns true. Sends zero force if the device still takes commands, without waiting for
  /// an answer. A device that was lost after one refused report may still apply its last force.
  virtual bool tellZero() noexcept { return true; }
  /// Called after Lost, at most every 200 ms. Tries to open the device again. False or ResourceError: it is not there yet.
  virtual bool reopen() { return false; }
  /// The reason for a loss or a missing report, as the device or the system tells it. Empty when no reason is known. I/O thread.
  virtual std::string lossText() const { return {}; }
  /// Called by a separate thread when `exchange` has hung for kStaleNs. Takes the force off without that call. False when the transport has
  /// no second way to do so. This call may hang, too.
  virtual bool stopForce() noexcept { return false; }
  /// The last call of the I/O thread. Sets zero force and switches off.
  virtual void close() noexcept {}
  virtual std::string calibrationHint() const { return {}; }
  /// Called by the I/O thread at the experimenter's request. Empty when done, otherwise the reason for the failure.
  virtual std::string calibrate() { return {}; }
};

/// A transport behind a separate thread. The tick takes the newest sample and leaves its force. Neither thread waits for the other. The I/O
/// thread sends zero force when the tick's force is older than kStaleNs, because the tick then hangs. `stopForce` uses this, too. When an
/// exchange hangs for kStaleNs, a guard thread takes the force off by the transport's second way. The destructor leaves a hanging exchange
/// behind.
class PolledDevice final : public haptics::HapticDevice {
 public:
  static constexpr std::int64_t kStaleNs = 20'000'000;
  static constexpr std::int64_t kReopenNs = 200'000'000;
  /// Says that the I/O thread sends zero force after kStaleNs. `DeviceInfo::secondPath` of a transport begins with this sentence.
  static std::string describeStale();

  /// Waits at most `patienceMs` for the first report. Throws ResourceError when no report comes.
  explicit PolledDevice(std::shared_ptr<Transport> transport, int patienceMs = 2000);
  /// For simulated time, without a thread. The caller of `step` acts as the I/O thread, and `now` is its clock [ns]. No call waits.
  PolledDevice(std::shared_ptr<Transport> transport, std::int64_t (*now)());
  ~PolledDevice() override;

  /// One exchange, or one attempt to open a lost device again.
  void step();

  haptics::DeviceInfo info() const override { return info_; }
  haptics::DeviceSample read() noexcept override;
  void write(const Vec3& force) noexcept override;
  haptics::DeviceHealth health() const noexcept override;
  std::string healthText() const override;
  bool stopForce() noexcept override;
  std::string calibrationHint() const override;
  void calibrate() override;

 private:
  struct Shared;
  haptics::DeviceInfo info_;
  std::shared_ptr<Shared> shared_;  // shared with the I/O thread, which may hang for ever
  haptics::DeviceSample last_;
  haptics::LeavableThread thread_, guard_;
};

}  // namespace reachlab::devices
