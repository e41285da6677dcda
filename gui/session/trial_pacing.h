#pragma once
#include <chrono>
#include <optional>

namespace reachlab::gui::app {

/// When the next trial comes without a key: after the plan's own pause, or the experimenter's. Time is given, not asked for.
class TrialPacing {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void plan(Time now, double pauseSeconds) { at_ = now + std::chrono::microseconds(static_cast<std::int64_t>(1e6 * pauseSeconds)); }
  void cancel() { at_.reset(); }
  /// True once, when the pause is over.
  bool takeDue(Time now) {
    if (!at_ || now < *at_) return false;
    at_.reset();
    return true;
  }
  bool planned() const { return at_.has_value(); }

 private:
  std::optional<Time> at_;
};

}  // namespace reachlab::gui::app
