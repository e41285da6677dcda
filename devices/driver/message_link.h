#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace reachlab::devices {

/// Whole text messages to and from a device: those of a service, or the lines of a serial line. One thread at a time.
class MessageLink {
 public:
  virtual ~MessageLink() = default;
  /// False: the other side is gone, or takes nothing any more.
  virtual bool send(std::string_view message) noexcept = 0;
  enum class Got : std::uint8_t { Message, Nothing, Gone };
  /// The next message, waiting at most this long for it.
  virtual Got receive(std::string& message, int milliseconds) noexcept = 0;
  /// Why it is gone, in the system's words.
  virtual std::string fault() const = 0;
};

}  // namespace reachlab::devices
