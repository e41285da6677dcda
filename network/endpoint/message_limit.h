#pragma once
#include <cstdint>
#include <optional>
#include <utility>

namespace reachlab::network {

/// Which of many messages are printed: ten a minute, so that who sends rubbish fills no disk. Any clock, in seconds; one thread at a time.
class MessageLimit {
 public:
  /// How many before this one were held back, where it is to be printed; nullopt: it is held back too.
  std::optional<std::uint64_t> admit(double now) {
    if (printed_ == 0 || now - since_ >= kMinute) since_ = now, printed_ = 0;
    if (printed_ == kMost) return ++held_, std::nullopt;
    ++printed_;
    return takeHeld();
  }
  /// Those held back that no answer has told of yet.
  std::uint64_t takeHeld() { return std::exchange(held_, 0); }

 private:
  static constexpr double kMinute = 60;
  static constexpr int kMost = 10;
  double since_ = 0;
  int printed_ = 0;
  std::uint64_t held_ = 0;
};

}  // namespace reachlab::network
