#include "devices/io/asked_device.h"

#include <utility>

namespace reachlab::devices {

void AskedDevice::connect() {
  std::unique_ptr<MessageLink> link = open_();
  greet(*link);
  awaiting_ = false;
  link_ = std::move(link);
}

Exchange AskedDevice::lose(std::string why) {
  loss_ = std::move(why);
  return Exchange::Lost;
}

Exchange AskedDevice::exchange(ForceSource& source, haptics::DeviceSample& sample) {
  constexpr int kAnswerMs = 10, kMostDrained = 64;
  if (!link_) return Exchange::Lost;
  if (!awaiting_ || source.now() - sentNs_ > askAgainNs_) {
    if (!link_->send(commandOf(source.newest()))) return lose(link_->fault());
    sentNs_ = source.now();
    awaiting_ = true;
  }
  std::string message, newer;
  switch (link_->receive(message, kAnswerMs)) {
    case MessageLink::Got::Gone: return lose(link_->fault());
    case MessageLink::Got::Nothing: return take(nullptr, sample);
    case MessageLink::Got::Message: break;
  }
  for (int i = 0; i < kMostDrained && link_->receive(newer, 0) == MessageLink::Got::Message; ++i) message.swap(newer);
  return take(&message, sample);
}

bool AskedDevice::reopen() {
  link_.reset();
  connect();
  return true;
}

bool AskedDevice::tellZero() noexcept {
  try {
    return !link_ || link_->send(commandOf({}));
  } catch (const std::exception&) {  // no memory for a message: closing, or the device's own watchdog, takes the force as well
    return false;
  }
}

void AskedDevice::close() noexcept {
  tellZero();
  link_.reset();
}

}  // namespace reachlab::devices
