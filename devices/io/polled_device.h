#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "base/system/triple_buffer.h"
#include "sim/haptics/device.h"
#include "sim/haptics/leavable_thread.h"

namespace reachlab::devices {

/// How one exchange with a device ended.
enum class Exchange : std::uint8_t {
  Report,   // a new sample was given
  Nothing,  // no new sample: the device said nothing in time, or the same again; no fault yet
  Lost,     // it is gone (unplugged, closed, refused)
};

/// The force that the tick left last, taken as late as possible: each millisecond of delay costs stability.
class ForceSource {
 public:
  /// [N], world frame; zero when the tick hangs, the device was lost or stopped. I/O thread, wait-free.
  virtual Vec3 newest() noexcept = 0;
  /// [ns] the I/O thread's clock.
  virtual std::int64_t now() const noexcept = 0;

 protected:
  ~ForceSource() = default;
};

/// A device whose transport may wait: USB, serial lines, sockets, vendors' calls. Used by one I/O thread, but for info and stopForce.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual haptics::DeviceInfo info() const = 0;
  /// Takes the device's newest sample (world frame; position, velocity, buttons, orientation, released) and tells it the newest force.
  /// May wait, at most some 10 ms: a force is never older than that.
  virtual Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) = 0;
  /// [ns] between the beginnings of two exchanges, at the least; 0: the exchange itself keeps the pace.
  virtual std::int64_t period() const { return 0; }
  /// After Lost, every millisecond until true: zero force if the device can still be told, without waiting for an answer. What was lost to one
  /// refused report may still hold its last force.
  virtual bool tellZero() noexcept { return true; }
  /// After Lost: tries to have it again. Not called more often than every 200 ms.
  virtual bool reopen() { return false; }
  /// I/O thread, after Lost, or of a device that gave no report: why, in the device's or the system's words; empty: nothing is known.
  virtual std::string lossText() const { return {}; }
  /// A thread of its own, when `exchange` has hung for kStaleNs: takes the force off by a way that does not need that call. False: there is
  /// none. It may hang, too.
  virtual bool stopForce() noexcept { return false; }
  /// I/O thread, last: zero force, off.
  virtual void close() noexcept {}
  virtual std::string calibrationHint() const { return {}; }
  /// I/O thread, when the experimenter asked for it. Empty: done; else why not.
  virtual std::string calibrate() { return {}; }
};

/// A transport behind a thread of its own. The tick takes the newest sample and leaves its force; neither waits for the other. The I/O
/// thread tells the device zero when the force it was left is older than kStaleNs (the tick hangs), and that is also the second path of
/// `stopForce`. A guard thread takes the force off by the transport's own second path when an exchange hangs for kStaleNs. A hanging
/// exchange is left behind on destruction.
class PolledDevice final : public haptics::HapticDevice {
 public:
  static constexpr std::int64_t kStaleNs = 20'000'000;
  static constexpr std::int64_t kReopenNs = 200'000'000;

  /// Waits for the first report, at most `patienceMs`; throws ResourceError when none comes.
  explicit PolledDevice(std::shared_ptr<Transport> transport, int patienceMs = 2000);
  /// Without a thread, for simulated time: whoever calls `step` is the I/O thread, and `now` its clock [ns]. Nothing waits.
  PolledDevice(std::shared_ptr<Transport> transport, std::int64_t (*now)());
  ~PolledDevice() override;

  /// One exchange, or one attempt to have a lost device again.
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
  std::shared_ptr<Shared> shared_;  // with the I/O thread, which may hang for ever
  haptics::DeviceSample last_;
  haptics::LeavableThread thread_, guard_;
};

}  // namespace reachlab::devices
