#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace reachlab::devices {

/// Whole text messages to and from a service. One thread at a time.
class MessageLink {
 public:
  virtual ~MessageLink() = default;
  /// False: the other side is gone.
  virtual bool send(std::string_view message) noexcept = 0;
  enum class Got : std::uint8_t { Message, Nothing, Gone };
  /// The next message, waiting at most this long for it.
  virtual Got receive(std::string& message, int milliseconds) noexcept = 0;
  /// Why it is gone, in the system's words.
  virtual std::string fault() const = 0;
};

/// A websocket client's link to `ws://host:port/`. Throws ResourceError in the system's words when nobody answers as a websocket there
/// within two seconds.
std::unique_ptr<MessageLink> openWebSocket(const std::string& host, std::uint16_t port);

}  // namespace reachlab::devices
