#pragma once
#include <array>
#include <functional>
#include <memory>
#include <string>

#include "devices/hid/arm_report.h"
#include "devices/hid/hid_port.h"
#include "devices/hid/open_serial_arm.h"
#include "devices/io/polled_device.h"

namespace reachlab::devices {

/// An open WoodenHaptics or Polhem arm over HID: one report in, one report out, strictly in turn. When no report comes within 10 ms, the
/// program asks again with zero currents. A report that is not whole is ignored. Verified against the published firmware, not on a device.
class OpenArm final : public Transport {
 public:
  struct Options {
    const ArmModel* model = nullptr;
    double maxCurrent = 2;          // [A] of a motor
    bool calibrateAtStart = false;  // the arm is in its calibration pose when it is opened
    std::size_t commandBytes = 65;  // with the leading report ID
    std::size_t reportBytes = 64;
  };
  using OpenPort = std::function<std::unique_ptr<HidPort>()>;

  /// `open` throws ResourceError. It is called again after the device was lost.
  OpenArm(const Options& options, const std::string& serial, OpenPort open);

  haptics::DeviceInfo info() const override;
  Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) override;
  bool tellZero() noexcept override { return !port_ || send({}); }
  bool reopen() override;
  void close() noexcept override;
  std::string calibrationHint() const override;
  std::string calibrate() override;
  std::string lossText() const override;

 private:
  int readNewest();
  bool send(const ArmCommand& command);
  bool setEncoders();

  Options options_;
  std::string serial_;
  OpenPort open_;
  std::unique_ptr<HidPort> port_;
  std::array<UnwrappedCount, 3> counts_;
  std::array<std::uint8_t, 64> bytes_{};
  std::array<double, 3> angles_{};
  std::size_t shortReport_ = 0;  // [bytes] of the latest short report
  bool whole_ = false;           // a whole report has come
};

/// The reason why an arm that sends reports of this many bytes cannot be driven, with the remedy. Empty when it can.
std::string firmwareFault(std::size_t reportBytes);

}  // namespace reachlab::devices
