#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "devices/driver/message_link.h"

namespace reachlab::devices {

/// A websocket client's link to `ws://host:port/`. Throws ResourceError in the system's words when nobody answers as a websocket there
/// within two seconds.
std::unique_ptr<MessageLink> openWebSocket(const std::string& host, std::uint16_t port);

}  // namespace reachlab::devices
