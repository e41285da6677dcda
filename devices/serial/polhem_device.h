#pragma once
#include <string>

#include "devices/io/asked_device.h"

namespace reachlab::devices {

/// A Polhem v3 over its serial line: one force out, one position back. Verified against the published host code, not on a device.
class PolhemSerial final : public AskedDevice {
 public:
  PolhemSerial(std::string name, OpenLink open);

  haptics::DeviceInfo info() const override;
  std::string lossText() const override { return "its serial line is gone or does not answer"; }

 private:
  void greet(MessageLink&) override { unanswered_ = 0; }
  std::string commandOf(const Vec3& force) const override;
  Exchange take(const std::string* message, haptics::DeviceSample& sample) override;

  std::string name_;
  int unanswered_ = 0;  // exchanges in a row without an answer of the right form
};

}  // namespace reachlab::devices
