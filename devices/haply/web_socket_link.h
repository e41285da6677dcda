#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "devices/driver/message_link.h"

namespace reachlab::devices {

/// The link of a websocket client to `ws://host:port/`. Throws ResourceError with the system's message when no websocket answers there
/// within two seconds.
std::unique_ptr<MessageLink> openWebSocket(const std::string& host, std::uint16_t port);

}  // namespace reachlab::devices
