#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace reachlab::devices {

/// Whole text messages to and from a device: the messages of a service, or the lines of a serial line. One thread at a time.
class MessageLink {
 public:
  virtual ~MessageLink() = default;
  /// False when the other side is gone or takes no more messages.
  virtual bool send(std::string_view message) noexcept = 0;
  enum class Got : std::uint8_t { Message, Nothing, Gone };
  /// Returns the next message. Waits for it at most this long.
  virtual Got receive(std::string& message, int milliseconds) noexcept = 0;
  /// The reason why the other side is gone, as the system tells it.
  virtual std::string fault() const = 0;
};

}  // namespace reachlab::devices
