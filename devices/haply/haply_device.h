#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "devices/driver/message_link.h"
#include "devices/haply/haply_message.h"
#include "devices/io/polled_device.h"

namespace reachlab::devices {

/// A Haply Inverse3 through its service on this machine: one force out, one state back, strictly in turn, at 2 kHz at most. Verified
/// against the published protocol, not on a device.
class HaplyInverse3 final : public Transport {
 public:
  struct Options {
    std::string id;               // empty: the first device of the service
    std::string grip;             // name of the VerseGrip that is held with it; empty: the only grip
    double maxForce = 0;          // [N] 0: the value of the data sheet
    bool deviceVelocity = false;  // use the service's velocity instead of our estimator's
  };
  using OpenLink = std::function<std::unique_ptr<MessageLink>()>;

  /// Throws ResourceError when there is no service (message of `open`), no such device, or a service of another version.
  HaplyInverse3(const Options& options, OpenLink open);

  haptics::DeviceInfo info() const override { return info_; }
  Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) override;
  std::int64_t period() const override { return 500'000; }
  bool tellZero() noexcept override;
  bool reopen() override;
  void close() noexcept override;
  std::string lossText() const override { return loss_; }
  /// Every Inverse3 that the service listed at the latest connection.
  const std::vector<std::string>& there() const { return there_; }

 private:
  void connect();
  Exchange lose(std::string why);
  Exchange take(const std::string& message, haptics::DeviceSample& sample);

  Options options_;
  OpenLink open_;
  std::unique_ptr<MessageLink> link_;
  haptics::DeviceInfo info_;
  HaplyState state_;
  std::string loss_;
  std::vector<std::string> there_;
  bool awaiting_ = false;  // an answer to the sent command is missing
  int garbled_ = 0;        // unreadable messages in a row
  std::int64_t sentNs_ = 0;
};

}  // namespace reachlab::devices
