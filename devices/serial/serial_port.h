#pragma once
#include <memory>
#include <string>

#include "devices/driver/message_link.h"

namespace reachlab::devices {

/// A terminal device, raw, 115200 baud: a message is a line without its end. What is longer than kLongestLine without an end is thrown
/// away. Receiving allocates nothing where the message has room for 2 * kLongestLine characters. Throws ResourceError in the system's words.
std::unique_ptr<MessageLink> openSerial(const std::string& path);
inline constexpr std::size_t kLongestLine = 256;

}  // namespace reachlab::devices
