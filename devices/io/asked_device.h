#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "devices/driver/message_link.h"
#include "devices/io/polled_device.h"

namespace reachlab::devices {

/// A device behind a link of messages that gives one state for each command, strictly in turn. A command without an answer is sent again.
class AskedDevice : public Transport {
 public:
  using OpenLink = std::function<std::unique_ptr<MessageLink>()>;

  Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) final;
  bool tellZero() noexcept final;
  bool reopen() final;
  void close() noexcept final;
  std::string lossText() const override { return loss_; }

 protected:
  /// `open` throws ResourceError. It is called again after the device was lost. `askAgainNs`: an answer that did not come by then will not.
  AskedDevice(OpenLink open, std::int64_t askAgainNs) : open_(std::move(open)), askAgainNs_(askAgainNs) {}
  /// Opens the link. The constructor of a device calls it. Throws ResourceError.
  void connect();
  /// Looks at a link that was just opened. Throws ResourceError when the device is not behind it.
  virtual void greet(MessageLink& link) = 0;
  /// The command that tells the device this force [N, world frame].
  virtual std::string commandOf(const Vec3& force) const = 0;
  /// Takes the newest message. Null: no message came in time.
  virtual Exchange take(const std::string* message, haptics::DeviceSample& sample) = 0;
  /// The command was answered: the next exchange sends the next command.
  void noteAnswer() { awaiting_ = false; }
  Exchange lose(std::string why);

 private:
  OpenLink open_;
  std::unique_ptr<MessageLink> link_;
  std::string loss_;
  std::int64_t askAgainNs_, sentNs_ = 0;
  bool awaiting_ = false;  // an answer to the sent command is missing
};

}  // namespace reachlab::devices
