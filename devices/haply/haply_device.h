#pragma once
#include <cstdint>
#include <string>

#include "devices/haply/haply_message.h"
#include "devices/io/asked_device.h"

namespace reachlab::devices {

/// A Haply Inverse3 through its service on this machine: one force out, one state back, strictly in turn, at 2 kHz at most. Verified
/// against the published protocol, not on a device.
class HaplyInverse3 final : public AskedDevice {
 public:
  struct Options {
    std::string id;               // empty: the first device of the service
    std::string grip;             // name of the VerseGrip that is held with it; empty: the only grip
    double maxForce = 0;          // [N] 0: the value of the data sheet
    bool deviceVelocity = false;  // use the service's velocity instead of our estimator's
  };

  /// Throws ResourceError when there is no service (message of `open`), no such device, or a service of another version.
  HaplyInverse3(const Options& options, OpenLink open);

  haptics::DeviceInfo info() const override { return info_; }
  std::int64_t period() const override { return 500'000; }
  /// Every Inverse3 that the service listed at the latest connection.
  const std::vector<std::string>& there() const { return there_; }

 private:
  void greet(MessageLink& link) override;
  std::string commandOf(const Vec3& force) const override;
  Exchange take(const std::string* message, haptics::DeviceSample& sample) override;

  Options options_;
  haptics::DeviceInfo info_;
  HaplyState state_;
  std::vector<std::string> there_;
  int garbled_ = 0;  // unreadable messages in a row
};

}  // namespace reachlab::devices
