#pragma once
#include <memory>
#include <string>

#include "devices/driver/message_link.h"

namespace reachlab::devices {

/// A terminal device, raw, at 115200 baud. A message is a line without its line end. Text longer than kLongestLine without a line end is
/// thrown away. Receiving allocates nothing where the message has room for 2 * kLongestLine characters. Throws ResourceError with the
/// system's message.
std::unique_ptr<MessageLink> openSerial(const std::string& path);
inline constexpr std::size_t kLongestLine = 256;

}  // namespace reachlab::devices
