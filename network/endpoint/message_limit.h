#pragma once
#include <cstdint>
#include <optional>
#include <utility>

namespace reachlab::network {

/// Decides which of many messages are printed: ten per minute, so that a sender of rubbish cannot fill the disk. Any clock, in seconds. One
/// thread at a time.
class MessageLimit {
 public:
  /// If the message is to be printed: the number of messages held back before it. nullopt: this message is held back too.
  std::optional<std::uint64_t> admit(double now) {
    if (printed_ == 0 || now - since_ >= kMinute) since_ = now, printed_ = 0;
    if (printed_ == kMost) return ++held_, std::nullopt;
    ++printed_;
    return takeHeld();
  }
  /// The number of held-back messages that no answer has reported yet.
  std::uint64_t takeHeld() { return std::exchange(held_, 0); }

 private:
  static constexpr double kMinute = 60;
  static constexpr int kMost = 10;
  double since_ = 0;
  int printed_ = 0;
  std::uint64_t held_ = 0;
};

}  // namespace reachlab::network
