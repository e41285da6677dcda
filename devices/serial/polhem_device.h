#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "devices/driver/message_link.h"
#include "devices/io/polled_device.h"

namespace reachlab::devices {

/// A Polhem v3 over its serial line: one force out, one position back. Verified against the published host code, not on a device.
class PolhemSerial final : public Transport {
 public:
  using OpenPort = std::function<std::unique_ptr<MessageLink>()>;
  /// `open` throws ResourceError. It is called again after the device was lost.
  PolhemSerial(std::string name, OpenPort open);

  haptics::DeviceInfo info() const override;
  Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) override;
  bool tellZero() noexcept override;
  bool reopen() override;
  void close() noexcept override;
  std::string lossText() const override { return "its serial line is gone or does not answer"; }

 private:
  std::string name_;
  OpenPort open_;
  std::unique_ptr<MessageLink> port_;
  bool awaiting_ = false;
  int unanswered_ = 0;  // exchanges in a row without an answer of the right form
  std::int64_t sentNs_ = 0;
};

}  // namespace reachlab::devices
